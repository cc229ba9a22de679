// Mixing and segregation of species in space, against time.

#include "analysis/grain_sizes.h"
#include "analysis/kinds/kinds.h"
#include "analysis/kinds/knob_specs.h"
#include "analysis/mixing.h"
#include "analysis/shell_cutoff.h"
#include "sim/base/error.h"

#include <fmt/format.h>

#include <algorithm>

namespace sandglass::analysis {

namespace {

class MixingAnalysis : public Analysis {
public:
  MixingAnalysis(const Parameters& knobs, const AnalysisContext& context)
      : knobs_(knobs), context_(context) {}

  void add(const Frame& frame) override {
    if (context_.diameter <= 0) context_.diameter = meanDiameter(frame);
    if (name_.empty()) {
      name_ = knobs_.text("species");
      if (name_.empty() && !frame.speciesNames.empty()) name_ = frame.speciesNames.front();
      const auto it = std::find(frame.speciesNames.begin(), frame.speciesNames.end(), name_);
      if (it == frame.speciesNames.end())
        throw InputError(fmt::format("the frame has no species '{}'", name_));
      species_ = static_cast<int>(it - frame.speciesNames.begin());
    }
    RegionOptions options = grainRegion(context_, context_.diameter, 0);
    options.freeSurface = false;
    const Region region(frame, options);
    regionText_ = region.description();
    const auto& species = frame.scalar(quantity::species);
    const auto& radius = frame.scalar(quantity::radius);
    std::vector<Vec3> points;
    std::vector<char> marked;
    for (std::size_t i = 0; i < frame.size(); ++i)
      if (region.containsGrain(frame.position[i], radius[i])) {
        points.push_back(frame.position[i]);
        marked.push_back(static_cast<int>(species[i]) == species_);
      }
    const Mixing m = mixing(points, marked, knobs_.number("cell") * context_.diameter,
                            static_cast<int>(knobs_.integer("shuffles")), context_.seed);
    times_.push_back(frame.time);
    values_.push_back(m);
  }

  Results results() const override {
    if (values_.empty()) throw InputError("mixing needs at least one frame");
    Results results;
    const std::string definition =
        fmt::format("species {}; cells of {:.3g} d; SI = sum n_c |x_c / x - 1| / N, floor: the same of {} "
                    "shuffles; Lacey's M = (S0^2 - "
                    "S^2) / (S0^2 - Sr^2); grains in W: {}",
                    name_, knobs_.number("cell"), knobs_.integer("shuffles"), regionText_);
    Curve index;
    index.name = "segregation_index";
    index.title = "Segregation index and its floor";
    index.definition = definition;
    index.x = {"time", "s"};
    index.y = {"SI", ""};
    index.frames = values_.size();
    Curve lacey = index;
    lacey.name = "mixing_index";
    lacey.title = "Lacey's mixing index";
    lacey.y = {"M", ""};
    Series si{"SI", times_, {}, {}}, floor{"floor", times_, {}, {}}, m{"", times_, {}, {}};
    for (const auto& v : values_) {
      si.y.push_back(v.index);
      floor.y.push_back(v.floor);
      floor.error.push_back(v.floorDeviation);
      m.y.push_back(v.lacey);
    }
    const Mixing& last = values_.back();
    index.numbers = {{"share", last.share}, {"cells", static_cast<double>(last.cells)}};
    index.series = {std::move(si), std::move(floor)};
    lacey.series = {std::move(m)};
    results.curves = {std::move(index), std::move(lacey)};
    results.sentences.push_back(
        fmt::format("mixing of {} at {:.4g} s: SI {:.4g} (floor {:.4g} +- {:.1g}), Lacey's M {:.4g}", name_,
                    times_.back(), last.index, last.floor, last.floorDeviation, last.lacey));
    return results;
  }

private:
  Parameters knobs_;
  AnalysisContext context_;
  std::string name_, regionText_;
  int species_ = 0;
  std::vector<double> times_;
  std::vector<Mixing> values_;
};

} // namespace

AnalysisKind mixingKind() {
  return {.name = "mixing",
          .title = "Mixing and segregation",
          .description = "segregation index with its sampling floor and Lacey's mixing index, against time",
          .source = "Lacey 1954; Anand 2009",
          .needs = {.quantities = {quantity::radius, quantity::species}, .grains = 2},
          .knobs = {textKnob("species", "", "the one that is followed; none: the first"),
                    numberKnob("cell", 4, 0, 1000, "edge of the cells, in diameters", true),
                    integerKnob("shuffles", 50, 2, 100000, "of the species, for the floor")},
          .make = [](const Parameters& knobs, const AnalysisContext& context) -> std::unique_ptr<Analysis> {
            return std::make_unique<MixingAnalysis>(knobs, context);
          }};
}

} // namespace sandglass::analysis
