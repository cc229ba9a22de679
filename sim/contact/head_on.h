#pragma once
// What restitution a contact really has: one head-on collision, integrated with the laws themselves.

#include "sim/contact/law_stack.h"

#include <string>
#include <utility>
#include <vector>

namespace sandglass {

/// Restitution of a head-on collision under the normal laws of a stack: `type` as of LawStack::typeOf, masses
/// and radii reduced, speed of approach [m/s]. A two-thousandth of a collision a step, or the step given [s];
/// the grains are `phase` (0 to 1) of a step away from their touch at the start. 0 when they stay together
/// (or creep apart for longer than a hundred collision times).
double headOnRestitution(const LawStack& laws, int type, double reducedMass, double effectiveRadius,
                         double speed, double step = 0.0, double phase = 0.0);

/// The least and the most that a run with this step [s] gives back, over the phases at which grains may meet.
std::pair<double, double> restitutionAtStep(const LawStack& laws, int type, double reducedMass,
                                            double effectiveRadius, double speed, double step);

/// One sentence for each two materials that can meet: the restitution of their mean grains at that speed, and
/// what it would be with the attraction of the dashpot cut off or left in, where the law has that option.
/// With a step [s] also what a run with that step makes of it.
std::vector<std::string> restitutionReport(const Scene& scene, double speed, double step = 0.0);

} // namespace sandglass
