#include "sim/scene/scene_checks.h"

#include "sim/scene/check_fields.h"
#include "sim/scene/check_fills.h"
#include "sim/scene/check_flow.h"
#include "sim/scene/check_parts.h"
#include "sim/scene/check_wedge.h"

namespace sandglass {

void checkScene(const Scene& scene, FaultList& faults) {
  checkNames(scene, faults);
  checkDomain(scene, faults);
  checkWedge(scene, faults);
  checkMaterials(scene, faults);
  checkContacts(scene, faults);
  checkWallsAndOutlets(scene, faults);
  checkFields(scene, faults);
  checkStages(scene, faults);
  checkEvents(scene, faults);
  checkFills(scene, faults);
  checkProbes(scene, faults);
  checkTimes(scene, faults);
  // Sizes, space and amounts make sense only when all the rest does.
  if (faults.empty()) checkSizes(scene, faults);
  if (faults.empty()) checkRecycling(scene, faults);
  if (faults.empty()) checkAmounts(scene, faults);
  if (faults.empty()) checkEndings(scene, faults);
}

} // namespace sandglass
