// The state map: mechanical state and order of each grain, shares against time.

#include "analysis/grain_sizes.h"
#include "analysis/kinds/kinds.h"
#include "analysis/kinds/knob_specs.h"
#include "analysis/state_map.h"
#include "sim/base/error.h"

#include <fmt/format.h>

#include <algorithm>

namespace sandglass::analysis {

namespace {

class StateAnalysis : public Analysis {
public:
  StateAnalysis(const Parameters& knobs, const AnalysisContext& context) : knobs_(knobs), context_(context) {}

  void add(const Frame& frame) override {
    if (!map_) {
      if (context_.diameter <= 0) context_.diameter = meanDiameter(frame);
      StateOptions options;
      options.limits = {knobs_.number("solid_inertia"), knobs_.number("gas_inertia"),
                        knobs_.number("gas_fraction"), knobs_.number("gas_contacts"),
                        knobs_.number("rearranged")};
      options.width = knobs_.number("width");
      options.memory = static_cast<int>(knobs_.integer("memory"));
      options.contactGap = knobs_.number("gap");
      options.diameter = context_.diameter;
      options.density = context_.facts.grainDensity;
      options.gravity = context_.facts.gravity;
      options.up = context_.facts.up;
      map_.emplace(options);
    }
    map_->add(frame);
    last_ = std::make_shared<Frame>(frame);
  }

  Results results() const override {
    if (!map_) throw InputError("the state map needs at least one frame");
    Results results;
    const std::string definition = map_->definition();
    Curve shares;
    shares.name = "state_shares";
    shares.title = "Shares of solid, liquid and gas";
    shares.definition = definition;
    shares.x = {"time", "s"};
    shares.y = {"share of the grains", ""};
    shares.frames = map_->shares().size();
    for (std::size_t s = 0; s < 3; ++s) {
      Series series{names()[s], {}, {}, {}};
      double mean = 0;
      for (const auto& at : map_->shares()) {
        series.x.push_back(at.time);
        series.y.push_back(at.share[s]);
        mean += at.share[s] / static_cast<double>(map_->shares().size());
      }
      shares.numbers[std::string(names()[s]) + "_mean"] = mean;
      shares.series.push_back(std::move(series));
    }
    results.curves.push_back(std::move(shares));

    Table sensitivity;
    sensitivity.name = "state_sensitivity";
    sensitivity.title = "Shares when a threshold moves by a fifth";
    sensitivity.definition = "unsmoothed states of all frames; " + definition;
    sensitivity.rowTitle = "threshold";
    sensitivity.columns = {{"solid", ""}, {"liquid", ""}, {"gas", ""}};
    for (const auto& [name, share] : map_->sensitivity()) {
      sensitivity.rowNames.push_back(name);
      sensitivity.rows.push_back({share[0], share[1], share[2]});
    }
    results.tables.push_back(std::move(sensitivity));

    Table flicker;
    flicker.name = "state_flicker";
    flicker.title = "States at once against states smoothed in time";
    flicker.definition = "shares of all grains and frames; rows: at once; columns: smoothed; " + definition;
    flicker.rowTitle = "at once";
    flicker.columns = {{"solid", ""}, {"liquid", ""}, {"gas", ""}};
    double total = 0;
    for (const auto& row : map_->flicker())
      for (const double v : row)
        total += v;
    for (std::size_t s = 0; s < 3; ++s) {
      flicker.rowNames.push_back(names()[s]);
      std::vector<double> row;
      for (const double v : map_->flicker()[s])
        row.push_back(total > 0 ? v / total : 0);
      flicker.rows.push_back(std::move(row));
    }
    results.tables.push_back(std::move(flicker));

    std::vector<double> state, inertia, fraction, contacts, temperature;
    for (const auto s : map_->states())
      state.push_back(static_cast<int>(s));
    for (const auto& m : map_->motion()) {
      inertia.push_back(m.inertia);
      fraction.push_back(m.fraction);
      contacts.push_back(m.contacts);
      temperature.push_back(m.temperature);
    }
    results.grains = {
        {"state", "", definition, std::move(state), {{0, names()[0]}, {1, names()[1]}, {2, names()[2]}}},
        {"inertial_number", "", "coarse-grained about the grain", std::move(inertia)},
        {"coarse_fraction", "", "coarse-grained about the grain", std::move(fraction)},
        {"coarse_contacts", "", "mean over the grain and its neighbours", std::move(contacts)},
        {"granular_temperature", "m^2/s^2", "coarse-grained about the grain", std::move(temperature)}};
    const auto& now = map_->shares().back().share;
    std::string sentence = fmt::format("state at {:.4g} s: {:.1f} % solid, {:.1f} % liquid, {:.1f} % gas",
                                       map_->shares().back().time, 100 * now[0], 100 * now[1], 100 * now[2]);
    if (knobs_.boolean("order")) {
      const AnalysisKind& kind = analysisKind("order");
      const Results order = analyze(kind, defaultKnobs(kind), context_, {last_});
      for (const auto& g : order.grains)
        if (g.name == "structure") results.grains.push_back(g);
      for (const auto& t : order.tables)
        if (t.name == "structure_types") results.tables.push_back(t);
    }
    results.sentences.push_back(sentence);
    return results;
  }

private:
  static const std::array<const char*, 3>& names() {
    static const std::array<const char*, 3> n{"solid", "liquid", "gas"};
    return n;
  }
  Parameters knobs_;
  AnalysisContext context_;
  std::optional<StateMap> map_;
  FramePtr last_;
};

} // namespace

AnalysisKind stateKind() {
  const StateThresholds limits;
  return {
      .name = "state",
      .title = "State map",
      .description = "solid, liquid or gas of each grain, and its order; shares against time",
      .source = "GDR MiDi 2004; da Cruz et al. 2005; Falk & Langer 1998",
      .needs = {.quantities = {quantity::radius, quantity::velocity}, .grains = 2},
      .knobs = {numberKnob("solid_inertia", limits.solidInertia, 0, 1e9,
                           "inertial number below which grains are solid"),
                numberKnob("gas_inertia", limits.gasInertia, 0, 1e9,
                           "inertial number above which they are gas"),
                numberKnob("gas_fraction", limits.gasFraction, 0, 1,
                           "packing fraction below which they may be gas"),
                numberKnob("gas_contacts", limits.gasContacts, 0, 12, "and the number of contacts for it"),
                numberKnob("rearranged", limits.rearranged, 0, 100,
                           "D2min between frames, in squared diameters, above which nothing is solid"),
                numberKnob("width", 1.5, 0, 100, "w of the kernel, in diameters", true),
                integerKnob("memory", 3, 1, 1000, "frames of which the commonest state counts"),
                numberKnob("gap", 0.001, 0, 1,
                           "largest gap of a contact, in diameters, where the frame has no contacts"),
                switchKnob("order", true, "also the order of the last frame's grains")},
      .make = [](const Parameters& knobs, const AnalysisContext& context) -> std::unique_ptr<Analysis> {
        return std::make_unique<StateAnalysis>(knobs, context);
      }};
}

} // namespace sandglass::analysis
