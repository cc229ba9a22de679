#pragma once
// How long a step of the soft-sphere method may be.

#include "sim/contact/law_stack.h"
#include "sim/scene/scene.h"
#include "sim/solvers/solver.h"

namespace sandglass {

/// The shortest collision of any two materials of the scene, between their smallest grains, divided by
/// steps_per_contact; or the scene's own time_step. The stable limit is a fifth of that collision: a grain
/// held by twelve linear contacts with normal and tangential springs (k_t = 2/7 k_n) swings with at most
/// 2.5 times the frequency pi / t_c of a pair, and velocity Verlet needs dt < 2 / omega = t_c / 3.9; a fifth
/// leaves a margin for friction and size spread.
StepChoice chooseStep(const Scene& scene, const LawStack& laws);

/// An estimate of the fastest impact [m/s], for laws whose collision time depends on it: free fall through
/// the height of the scene, or the fastest grain that a filling names.
double impactSpeed(const Scene& scene);

} // namespace sandglass
