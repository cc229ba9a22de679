#pragma once
// What restitution a contact really has: one head-on collision, integrated with the laws themselves.

#include "sim/contact/law_stack.h"

#include <string>
#include <vector>

namespace sandglass {

/// Restitution of a head-on collision under the normal laws of a stack: `type` as of LawStack::typeOf, masses
/// and radii reduced, speed of approach [m/s]. A two-thousandth of a collision a step. 0 when the grains stay
/// together (or creep apart for longer than a hundred collision times).
double headOnRestitution(const LawStack& laws, int type, double reducedMass, double effectiveRadius,
                         double speed);

/// One sentence for each two materials that can meet: the restitution of their mean grains at that speed, and
/// what it would be with the attraction of the dashpot cut off or left in, where the law has that option.
std::vector<std::string> restitutionReport(const Scene& scene, double speed);

} // namespace sandglass
