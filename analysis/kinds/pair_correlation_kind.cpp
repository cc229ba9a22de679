// g(r), total and of pairs of species.

#include "analysis/grain_sizes.h"
#include "analysis/kinds/kinds.h"
#include "analysis/kinds/knob_specs.h"
#include "analysis/pair_correlation.h"
#include "sim/base/error.h"

#include <fmt/format.h>

#include <algorithm>

namespace sandglass::analysis {

namespace {

class PairCorrelationAnalysis : public Analysis {
public:
  PairCorrelationAnalysis(const Parameters& knobs, const AnalysisContext& context)
      : rMax_(knobs.number("r_max")) {
    options_.estimator = parseEstimator(knobs.text("estimator"));
    options_.bins = static_cast<int>(knobs.integer("bins"));
    options_.diameter = context.diameter;
    options_.region = context.limits;
    options_.region.up = context.facts.up;
    options_.region.gates = context.facts.gates;
    options_.pointsPerShell = knobs.integer("points_per_shell");
    options_.seed = context.seed;
    species_ = knobs.boolean("species");
  }

  void add(const Frame& frame) override {
    if (works_.empty()) begin(frame);
    for (auto& work : works_)
      work.add(frame);
  }

  Results results() const override {
    if (works_.empty()) throw InputError("g(r) needs at least one frame");
    Results results;
    for (const auto& work : works_) {
      auto [g, shells] = work.result();
      results.sentences.push_back(sentence(g));
      results.curves.push_back(std::move(g));
      results.curves.push_back(std::move(shells));
    }
    return results;
  }

private:
  void begin(const Frame& frame) {
    if (options_.diameter <= 0) options_.diameter = meanDiameter(frame);
    options_.rMax = rMax_ * options_.diameter;
    works_.emplace_back(options_);
    const int kinds = static_cast<int>(frame.speciesNames.size());
    if (!species_ || kinds < 2 || !frame.has(quantity::species)) return;
    for (int a = 0; a < kinds; ++a)
      for (int b = a; b < kinds; ++b) {
        options_.species = std::pair{a, b};
        works_.emplace_back(options_);
      }
  }

  std::string sentence(const Curve& g) const {
    const Series& s = g.series[0];
    const auto peak = std::max_element(s.y.begin(), s.y.end()) - s.y.begin();
    std::string text =
        fmt::format("{} ({}, {} frame{}, {:.0f} reference grains): highest {:.3g} +- {:.2g} at "
                    "{:.3g} d",
                    g.y.name, nameOf(options_.estimator), g.frames, g.frames == 1 ? "" : "s",
                    g.numbers.at("references"), s.y[peak], s.error[peak], s.x[peak]);
    if (g.numbers.contains("first_minimum"))
      text += fmt::format("; first minimum at {:.3g} d, {:.3g} neighbours within",
                          g.numbers.at("first_minimum"), g.numbers.at("coordination_first_shell"));
    else
      text += "; no first minimum";
    return text;
  }

  PairCorrelationOptions options_;
  double rMax_;
  bool species_ = true;
  std::vector<PairCorrelation> works_;
};

} // namespace

AnalysisKind pairCorrelationKind() {
  return {.name = "gr",
          .title = "Pair correlation",
          .description = "pair correlation g(r), right near walls and free surfaces; total and by species",
          .source = "Ripley 1977; Kopera & Retsch 2018",
          .needs = {.quantities = {quantity::radius}, .grains = 2},
          .knobs = {choiceKnob("estimator", "E3", {"E0", "E1", "E2", "E3", "E4"},
                               "E0 none, E1 guard zone, E2 translation, E3 local shell volume, E4 "
                               "inhomogeneous"),
                    numberKnob("r_max", 5, 0, 1000, "largest distance, in diameters", true),
                    integerKnob("bins", 200, 1, 1e6, "bins of equal width"),
                    switchKnob("species", true, "also the partial g(r) of each pair of species"),
                    integerKnob("points_per_shell", 200000, 100, 1e9,
                                "points per bin for the shells' volumes inside the region")},
          .make = [](const Parameters& knobs, const AnalysisContext& context) -> std::unique_ptr<Analysis> {
            return std::make_unique<PairCorrelationAnalysis>(knobs, context);
          }};
}

} // namespace sandglass::analysis
