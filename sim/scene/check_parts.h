#pragma once
// The checks behind checkScene(), one for each kind of table.

#include "sim/scene/fault_list.h"
#include "sim/scene/scene.h"

#include <string>

namespace sandglass {

void checkNames(const Scene& scene, FaultList& faults); ///< well formed, no two alike
void checkDomain(const Scene& scene, FaultList& faults);
void checkMaterials(const Scene& scene, FaultList& faults); ///< references of species and walls, densities
void checkContacts(const Scene& scene, FaultList& faults);
void checkWallsAndOutlets(const Scene& scene, FaultList& faults);
void checkStages(const Scene& scene, FaultList& faults);
void checkProbes(const Scene& scene, FaultList& faults);
void checkTimes(const Scene& scene, FaultList& faults); ///< step against collisions and intervals

/// "species.bead", or "species.2" for the second when it has no name.
std::string partPath(const char* section, const std::string& name, std::size_t index);

/// Reports KEY when its value is no direction (zero length).
void checkDirection(const std::string& key, const Vec3& value, FaultList& faults);

/// Reports BASE.lower / BASE.upper when the box is empty along an axis.
void checkBox(const std::string& base, const Vec3& lower, const Vec3& upper, FaultList& faults);

} // namespace sandglass
