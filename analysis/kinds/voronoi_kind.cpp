// Packing by Voronoi or radical cells.

#include "analysis/grain_sizes.h"
#include "analysis/kinds/kinds.h"
#include "analysis/kinds/knob_specs.h"
#include "analysis/local_packing.h"
#include "analysis/shell_cutoff.h"
#include "sim/base/error.h"

namespace sandglass::analysis {

namespace {

class VoronoiAnalysis : public Analysis {
public:
  VoronoiAnalysis(const Parameters& knobs, const AnalysisContext& context)
      : knobs_(knobs), context_(context) {}

  void add(const Frame& frame) override {
    if (!packing_) {
      if (context_.diameter <= 0) context_.diameter = meanDiameter(frame);
      LocalPackingOptions options;
      options.diameter = context_.diameter;
      options.radical = knobs_.text("cells") == "radical" && frame.has(quantity::radius);
      options.bins = static_cast<int>(knobs_.integer("bins"));
      options.slab = knobs_.number("slab");
      options.up = context_.facts.up.value_or(Vec3::UnitZ());
      options.gridSpacing = knobs_.number("grid");
      options.gridReach = knobs_.number("grid_reach");
      packing_.emplace(options);
      radical_ = options.radical;
    }
    VoronoiOptions options;
    options.radical = radical_;
    options.diameter = context_.diameter;
    options.up = context_.facts.up;
    packing_->add(frame, voronoiCells(frame, options),
                  Region(frame, grainRegion(context_, context_.diameter, knobs_.number("margin"))));
  }

  Results results() const override {
    if (!packing_) throw InputError("Voronoi packing needs at least one frame");
    return packing_->results();
  }

private:
  Parameters knobs_;
  AnalysisContext context_;
  std::optional<LocalPacking> packing_;
  bool radical_ = true;
};

} // namespace

AnalysisKind voronoiKind() {
  return {
      .name = "voronoi",
      .title = "Voronoi packing",
      .description =
          "packing fraction, free volume and faces of Voronoi or radical cells cut by walls; k-gamma law",
      .source = "Rycroft 2009; Aste & Di Matteo 2008",
      .needs = {.quantities = {quantity::radius}, .grains = 1},
      .knobs = {choiceKnob("cells", "radical", {"radical", "plain"}, "whether radii move the cells' faces"),
                integerKnob("bins", 60, 1, 100000, "bins of the distributions"),
                numberKnob("slab", 1, 0, 1000, "width of the profiles' slabs, in diameters", true),
                numberKnob("margin", 2, 0, 1000, "distance from the free surface, in diameters"),
                numberKnob("grid", 2, 0, 1000, "spacing of the field, in diameters; 0: none"),
                numberKnob("grid_reach", 2.2, 0, 1000, "grains about a node that count there, in diameters",
                           true)},
      .make = [](const Parameters& knobs, const AnalysisContext& context) -> std::unique_ptr<Analysis> {
        return std::make_unique<VoronoiAnalysis>(knobs, context);
      }};
}

} // namespace sandglass::analysis
