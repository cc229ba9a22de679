#pragma once
// Walls beside grains from elsewhere: those of a scene, and triangles from STL (or VTP) files.

#include "sim/frame/frame.h"
#include "sim/io/import/import_settings.h"

#include <optional>
#include <string>
#include <vector>

namespace sandglass {

class ImportWalls {
public:
  /// Throws InputError when a file cannot be read, or when two scenes are named.
  explicit ImportWalls(const ImportSettings& settings);
  void addTo(Frame& frame) const;
  /// The scene's, for frames whose file says no box.
  const std::optional<Domain>& domain() const { return domain_; }
  /// The resolved scene; empty when there is none.
  const std::string& sceneText() const { return sceneText_; }

private:
  std::vector<FrameWall> walls_;
  std::string sceneText_;
  std::optional<Domain> domain_;
};

} // namespace sandglass
