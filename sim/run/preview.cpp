#include "sim/run/preview.h"

#include "sim/base/error.h"
#include "sim/grains/seeding.h"
#include "sim/run/stage_control.h"
#include "sim/solvers/solver.h"

namespace sandglass {

FramePtr previewFrame(const Scene& scene, std::int64_t mostGrains) {
  if (auto refusals = solverRefusals(scene); !refusals.empty()) throw InputError(std::move(refusals));
  Scene asked = scene;
  asked.output.quantities = {quantity::velocity};
  asked.output.contacts = false;
  const auto solver = makeSolver(asked, SolverOptions{1, true});
  StageControl stages(asked, *solver, {});
  if (expectedGrains(asked) <= mostGrains) stages.begin();
  auto frame = std::make_shared<Frame>(*solver->frame());
  if (!asked.stages.empty()) frame->stage = asked.stages.front().name;
  if (!asked.title.empty()) frame->provenance["title"] = asked.title;
  return frame;
}

} // namespace sandglass
