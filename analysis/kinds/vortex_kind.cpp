// States of a bed in a vortex: unresolved, flat, fluid, pinned, spouts.

#include "analysis/kinds/kinds.h"
#include "analysis/vortex/vortex_knobs.h"
#include "analysis/vortex/vortex_results.h"
#include "sim/base/error.h"

namespace sandglass::analysis {

namespace {

class VortexAnalysis : public Analysis {
public:
  VortexAnalysis(const Parameters& knobs, const AnalysisContext& context)
      : rules_(rulesOf(knobs)),
        measures_(tankOf(knobs, context.facts), grainThresholdsOf(knobs), context.facts.grainDensity) {}

  void add(const Frame& frame) override { measures_.add(frame); }

  Results results() const override {
    if (measures_.samples().size() < 2) throw InputError("the states of a vortex need at least two frames");
    return vortexResults(measures_, rules_);
  }

private:
  VortexRules rules_;
  VortexMeasures measures_;
};

} // namespace

AnalysisKind vortexKind() {
  return {.name = "vortex_states",
          .title = "States in a vortex",
          .description =
              "unresolved, flat, fluid, pinned, small or large spout, with the evidence; rotation of "
              "the bed, empty core, surface",
          .source = "Rice 2012",
          .needs =
              {.quantities = {quantity::radius}, .persistentIds = true, .up = true, .grains = 2, .frames = 2},
          .knobs = vortexKnobs(),
          .make = [](const Parameters& knobs, const AnalysisContext& context) -> std::unique_ptr<Analysis> {
            return std::make_unique<VortexAnalysis>(knobs, context);
          }};
}

} // namespace sandglass::analysis
