#pragma once
// What bench_core measures: scenes with the state they start from.

#include "sim/grains/seeding.h"
#include "sim/scene/scene.h"
#include "sim/solvers/solver.h"

#include <cstdint>
#include <string>
#include <vector>

namespace sandglass::bench {

struct CoreCase {
  std::string name;
  Scene scene;
  std::vector<GrainSeed> grains; ///< empty when `state` is given
  Solver::State state;           ///< of a run that has come so far (walls removed, contacts with a past)
  std::int64_t steps = 0;
  std::string lammpsDeck, liggghtsDeck; ///< up to the `run` command; empty: they take no part
  std::string yadeScript;               ///< of lookStep steps: it is slow
  Scene clamped;                        ///< the scene with Yade's law, where it takes part
  std::string whyNoPeers;               ///< where no other program can run the same; empty otherwise
};

/// Step at which kinetic energies are compared.
inline constexpr std::int64_t lookStep = 300;

/// Names of all cases, in the order of the table.
std::vector<std::string> coreCaseNames();
/// Makes one: settling and flowing take a while. `quick`: few grains and steps.
CoreCase makeCoreCase(const std::string& name, bool quick);

} // namespace sandglass::bench
