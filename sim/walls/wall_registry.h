#pragma once
// The kinds of wall that a scene can name. To add one: one file beside this, one line in wall_registry.cpp.

#include "sim/scene/parameters.h"
#include "sim/walls/wall_shape.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace sandglass {

struct WallKind {
  std::string name;
  std::string description;
  std::vector<ParameterSpec> parameters;
  /// Throws InputError (a phrase without file and line) when the values contradict each other.
  std::function<std::shared_ptr<const WallShape>(const Parameters&)> make;
};

/// All kinds, in the order of the documentation.
const std::vector<WallKind>& wallKinds();

} // namespace sandglass
