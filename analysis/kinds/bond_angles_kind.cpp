// Bond angles, total and by species.

#include "analysis/bond_angles.h"
#include "analysis/grain_sizes.h"
#include "analysis/kinds/kinds.h"
#include "analysis/kinds/knob_specs.h"
#include "analysis/shell_cutoff.h"
#include "sim/base/error.h"

#include <fmt/format.h>

#include <algorithm>

namespace sandglass::analysis {

namespace {

class BondAngleAnalysis : public Analysis {
public:
  BondAngleAnalysis(const Parameters& knobs, const AnalysisContext& context)
      : knobs_(knobs), context_(context) {}

  void add(const Frame& frame) override {
    const double d = context_.diameter > 0 ? context_.diameter : meanDiameter(frame);
    if (!angles_) {
      context_.diameter = d;
      const ShellCutoff cutoff = shellCutoff(frame, knobs_.number("cutoff"), d, context_);
      angles_.emplace(BondAngleOptions{cutoff.distance, cutoff.text, static_cast<int>(knobs_.integer("bins")),
                                       knobs_.boolean("species")});
    }
    angles_->add(frame, Region(frame, grainRegion(context_, d)));
  }

  Results results() const override {
    if (!angles_) throw InputError("bond angles need at least one frame");
    Results results;
    results.curves = angles_->results();
    const Curve& c = results.curves.front();
    const auto& y = c.series[0].y;
    const auto peak = std::max_element(y.begin(), y.end()) - y.begin();
    results.sentences.push_back(fmt::format(
        "bond angles: {:.0f} angles, {:.3g} neighbours within {:.4g} d, most frequent {:.4g} degrees",
        c.numbers.at("angles"), c.numbers.at("neighbours"), c.numbers.at("cutoff") / context_.diameter,
        c.series[0].x[static_cast<std::size_t>(peak)]));
    return results;
  }

private:
  Parameters knobs_;
  AnalysisContext context_;
  std::optional<BondAngles> angles_;
};

} // namespace

AnalysisKind bondAngleKind() {
  return {.name = "bond_angles",
          .title = "Bond angles",
          .description = "angles between the bonds of a grain to its neighbours, also over sin and over cos",
          .source = "Rycroft, Bazant, Grest & Landry 2006",
          .needs = {.quantities = {quantity::radius}, .grains = 3},
          .knobs = {numberKnob("cutoff", 0, 0, 100,
                               "neighbours up to here, in diameters; 0: first minimum of g(r)"),
                    integerKnob("bins", 180, 1, 100000, "bins over 180 degrees"),
                    switchKnob("species", true, "also by species of the middle grain and of both ends")},
          .make = [](const Parameters& knobs, const AnalysisContext& context) -> std::unique_ptr<Analysis> {
            return std::make_unique<BondAngleAnalysis>(knobs, context);
          }};
}

} // namespace sandglass::analysis
