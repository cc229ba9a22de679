#pragma once
// From a wanted coefficient of restitution to the damping that gives it.

namespace sandglass {

/// Damping ratio zeta = gamma / (2 sqrt(k m*)) of a linear spring-dashpot contact.
/// Free parting (attraction allowed until the overlap ends): e = exp(-pi zeta / sqrt(1 - zeta^2)).
double dampingRatio(double restitution);

/// The same when the total force is clamped at zero, so that grains part while still overlapping
/// (Schwager and Poeschel, Granular Matter 9, 465 (2007), eq. 21): solved by bisection. 0 < e <= 1.
double dampingRatioClamped(double restitution);

} // namespace sandglass
