#pragma once
// The text behind writeScene() and sceneHash().

#include "sim/scene/scene.h"

#include <string>

namespace sandglass {

/// The resolved scene as TOML; without title and description when `withTexts` is false.
std::string sceneText(const Scene& scene, bool withTexts);

/// One value as a scene would write it.
std::string valueText(const ParameterValue& value, const std::string& unit);

} // namespace sandglass
