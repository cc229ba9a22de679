#pragma once
// Walls beside grains from elsewhere: those of a scene, and triangles from STL (or VTP) files.

#include "sim/frame/frame.h"
#include "sim/io/import/import_settings.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace sandglass {

class ImportWalls {
public:
  /// Throws InputError when a file cannot be read, or when two scenes are named.
  explicit ImportWalls(const ImportSettings& settings);
  /// A wall that a stage of the scene removes is there up to the time at which that stage begins, where the
  /// stages before it have durations; else always.
  void addTo(Frame& frame) const;
  /// What the user should know of them.
  const std::vector<std::string>& remarks() const { return remarks_; }
  /// The scene's, for frames whose file says no box.
  const std::optional<Domain>& domain() const { return domain_; }
  /// The resolved scene; empty when there is none.
  const std::string& sceneText() const { return sceneText_; }

private:
  std::vector<FrameWall> walls_;
  std::map<std::string, double> removedAt_; ///< [s]
  std::vector<std::string> remarks_;
  std::string sceneText_;
  std::optional<Domain> domain_;
};

} // namespace sandglass
