#pragma once
// Scene files, read table by table. What the tables say on their own is checked here; what they say about
// each other in scene_checks.h.

#include "sim/scene/document.h"
#include "sim/scene/fault_list.h"
#include "sim/scene/scene.h"

#include <string>

namespace sandglass {

/// Fills in a Scene from the tree of its file; faults go to the list. `baseFolder`: where CSV files are
/// looked for.
Scene readSceneDocument(const Value& root, const std::string& baseFolder, FaultList& faults);

} // namespace sandglass
