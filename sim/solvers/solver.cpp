#include "sim/solvers/solver.h"

#include "sim/base/error.h"
#include "sim/solvers/dem/dem_solver.h"
#include "sim/solvers/dem/step_rule.h"

#include <fmt/format.h>

namespace sandglass {

void Solver::setField(const std::string& name, double) {
  throw InputError(fmt::format("this solver has no fields, so none can be set ('{}')", name));
}

std::vector<std::string> solverRefusals(const Scene& scene) {
  std::vector<std::string> refusals;
  const auto attempt = [&](auto&& action) {
    try {
      action();
    } catch (const InputError& e) {
      for (const auto& s : e.sentences())
        refusals.push_back(s);
    }
  };
  attempt([&] {
    SolverOptions one;
    one.threads = 1;
    makeSolver(scene, one);
  });
  double largest = 0.0;
  for (const Species& s : scene.species)
    largest = std::max(largest, sizeRange(scene, s).largest);
  for (int k = 0; k < 3; ++k)
    if (scene.domain.periodic[k] && scene.domain.upper[k] - scene.domain.lower[k] <= largest)
      refusals.push_back(fmt::format(
          "the periodic box is {:.3g} m along {} and the largest grain {:.3g} m, so it would touch itself; "
          "make the box wider than a grain",
          scene.domain.upper[k] - scene.domain.lower[k], "xyz"[k], largest));
  return refusals;
}

std::unique_ptr<Solver> makeSolver(const Scene& scene, const SolverOptions& options) {
  if (scene.solver != "dem")
    throw InputError(fmt::format("there is no solver '{}'; there is: dem", scene.solver));
  return std::make_unique<DemSolver>(scene, options);
}

} // namespace sandglass
