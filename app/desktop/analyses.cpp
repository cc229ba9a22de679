#include "app/desktop/analyses.h"

#include "analysis/contact_statistics.h"
#include "analysis/histogram.h"
#include "analysis/packing.h"
#include "analysis/registry.h"
#include "sim/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace sandglass::desktop {

namespace {

using analysis::Curve;

constexpr std::size_t mostFrames = 30; ///< of a run that an analysis in time looks at
// States are told from windows of many frames: as many as small runs have, fewer of large ones.
constexpr std::size_t mostGrainFrames = 3'000'000;
constexpr std::int64_t panelPoints =
    20000; ///< for shells' volumes; a panel needs no more than its line is wide

/// "name=value name=value" over the fallbacks.
Parameters knobsOf(const analysis::AnalysisKind& kind, const std::string& text) {
  Parameters knobs = analysis::defaultKnobs(kind);
  if (knobs.has("points_per_shell")) knobs.set("points_per_shell", panelPoints);
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const auto equals = word.find('=');
    if (equals == std::string::npos) throw InputError(fmt::format("'{}' is no knob; write name=value", word));
    analysis::setKnob(knobs, kind, word.substr(0, equals), word.substr(equals + 1));
  }
  return knobs;
}

/// Frames for an analysis in time, evenly over the run up to the one that is shown.
std::vector<FramePtr> framesOf(const AnalysisInput& in, std::size_t most = mostFrames) {
  std::vector<FramePtr> frames;
  if (!in.frames) return frames;
  const std::size_t size = in.frames->size(), stride = 1 + size / most;
  for (std::size_t k = 0; k < size && in.frames->time(k) <= in.frame->time; k += stride)
    frames.push_back(in.frames->load(k));
  return frames;
}

analysis::Results ofRegistry(const analysis::AnalysisKind& kind, const AnalysisInput& in) {
  analysis::AnalysisContext context;
  if (in.scene) context.facts = analysis::factsOf(*in.scene);
  const auto frames = kind.needs.frames > 1 ? framesOf(in) : std::vector<FramePtr>{in.frame};
  analysis::Results results = analysis::analyze(kind, knobsOf(kind, in.knobs), context, frames);
  for (auto& curve : results.curves)
    for (auto& series : curve.series)
      for (std::size_t k = 0; k < series.error.size(); ++k) // where nothing was found there is nothing to see
        if (series.y[k] == 0) series.error[k] = 0;
  return results;
}

analysis::Results alone(Curve curve) {
  analysis::Results results;
  results.curves.push_back(std::move(curve));
  return results;
}

/// Density of `values` as a staircase.
Curve densityOf(const std::vector<double>& values, const std::string& name, const std::string& unit,
                double low, double high, int count) {
  analysis::Histogram histogram(low, high, count);
  for (const double v : values)
    histogram.add(v);
  Curve curve;
  curve.x = {name, unit};
  const bool compound = unit.find_first_of("/* ") != std::string::npos;
  curve.y = {"density", unit.empty() ? "" : compound ? "1/(" + unit + ")" : "1/" + unit};
  curve.frames = 1;
  const analysis::Series middle = histogram.density("");
  analysis::Series stairs;
  const double half = (high - low) / count / 2;
  for (std::size_t k = 0; k < middle.x.size(); ++k)
    for (const double side : {-half, half}) {
      stairs.x.push_back(middle.x[k] + side);
      stairs.y.push_back(middle.y[k]);
    }
  curve.series.push_back(std::move(stairs));
  return curve;
}

analysis::Results histogramOf(const AnalysisInput& in) {
  const std::string quantity = in.quantity.empty() ? "speed" : in.quantity;
  std::vector<double> values = grainScalar(*in.frame, quantity);
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  if (values.empty()) throw InputError(fmt::format("no grain has a finite {}", quantity));
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const double low = *least, span = *most - *least;
  const double high = low + (span > 0 ? span * (1 + 1e-9) : std::max(std::abs(low), 1.0) * 1e-3);
  const int count = std::clamp(static_cast<int>(2 * std::cbrt(static_cast<double>(values.size()))), 10, 80);
  Curve curve = densityOf(values, quantity, unitOf(quantity), low, high, count);
  double sum = 0, squares = 0;
  for (const double v : values)
    sum += v;
  const double mean = sum / static_cast<double>(values.size());
  for (const double v : values)
    squares += (v - mean) * (v - mean);
  const double deviation = std::sqrt(squares / static_cast<double>(values.size()));
  curve.name = "histogram";
  curve.numbers = {{"mean", mean}, {"deviation", deviation}};
  curve.definition = fmt::format("{} grains; mean {:.4g}, standard deviation {:.3g} {}.", values.size(), mean,
                                 deviation, unitOf(quantity));
  return alone(std::move(curve));
}

analysis::Results packing(const AnalysisInput& in) {
  analysis::PackingOptions options;
  if (in.scene && in.scene->gravity.norm() > 0) options.up = -in.scene->gravity.normalized();
  analysis::PackingProfile profile(options);
  profile.add(*in.frame);
  return alone(profile.result());
}

analysis::Results forces(const AnalysisInput& in) {
  analysis::ContactStatistics statistics({});
  statistics.add(*in.frame);
  analysis::Results results = alone(statistics.forces());
  results.curves.push_back(statistics.overlaps());
  return results;
}

analysis::Results contactNumbers(const AnalysisInput& in) {
  const Frame& frame = *in.frame;
  if (frame.contacts.empty())
    throw InputError(
        "the frame holds no contacts; give the scene [output] contacts = true, or wait until grains "
        "touch");
  std::map<std::int64_t, int> touches;
  for (const auto id : frame.id)
    touches[id] = 0;
  std::int64_t pairs = 0;
  for (const auto& contact : frame.contacts) {
    if (contact.overlap < 0) continue; // a law that acts across a gap
    ++touches[contact.a];
    if (contact.b >= 0) ++touches[contact.b], ++pairs;
  }
  std::vector<double> values;
  for (const auto& [id, number] : touches)
    values.push_back(number);
  const double most = *std::max_element(values.begin(), values.end());
  Curve curve = densityOf(values, "contacts of a grain", "", -0.5, most + 0.5, static_cast<int>(most) + 1);
  curve.y.name = "share of grains";
  curve.name = "contacts";
  const double mean = 2 * static_cast<double>(pairs) / static_cast<double>(values.size());
  curve.numbers = {{"coordination", mean}};
  curve.definition =
      fmt::format("{} grains, walls counted; coordination by grains alone {:.3f}.", values.size(), mean);
  return alone(std::move(curve));
}

/// What the general map decides by: its knobs.
analysis::Table thresholdsOf(const analysis::AnalysisKind& kind, const Parameters& knobs) {
  analysis::Table table;
  table.name = "state_thresholds";
  table.title = "Thresholds of solid, liquid, gas";
  table.columns = {{"value", ""}};
  for (const auto& spec : kind.knobs) {
    if (spec.type != ParameterType::number) continue;
    table.rowNames.push_back(spec.name);
    table.rows.push_back({knobs.number(spec.name)});
    table.definition += (table.definition.empty() ? "" : "; ") + spec.name + ": " + spec.description;
  }
  return table;
}

/// The states of a bed in a vortex, where the scene has a tank, beside the general map.
analysis::Results states(const AnalysisInput& in) {
  const auto& general = analysis::analysisKind("state");
  const auto& vortex = analysis::analysisKind("vortex_states");
  analysis::AnalysisContext context;
  if (in.scene) context.facts = analysis::factsOf(*in.scene);
  const std::size_t most = std::max(mostFrames, mostGrainFrames / in.frame->size());
  std::vector<FramePtr> frames = framesOf(in, most);
  if (frames.empty() || frames.back()->time < in.frame->time) frames.push_back(in.frame);
  analysis::Results results;
  if (context.facts.tank && frames.size() > 1) {
    results = analysis::analyze(vortex, knobsOf(vortex, in.knobs), context, frames);
  } else {
    results.sentences.emplace_back("No upright round tank: the states of a vortex do not apply.");
  }
  // The map needs neighbours in each frame: the last few, as many as it remembers twice over.
  constexpr std::size_t recent = 12;
  const std::vector<FramePtr> last(
      frames.end() - static_cast<std::ptrdiff_t>(std::min(recent, frames.size())), frames.end());
  analysis::Results map = analysis::analyze(general, analysis::defaultKnobs(general), context, last);
  for (auto& curve : map.curves)
    results.curves.push_back(std::move(curve));
  results.sentences.insert(results.sentences.end(), map.sentences.begin(), map.sentences.end());
  results.tables.push_back(thresholdsOf(general, analysis::defaultKnobs(general)));
  for (auto& table : map.tables)
    if (table.name == "state_sensitivity") results.tables.push_back(std::move(table));
  return results;
}

} // namespace

const std::vector<PanelAnalysis>& panelAnalyses() {
  static const std::vector<PanelAnalysis> all = [] {
    std::vector<PanelAnalysis> list;
    for (const auto& kind : analysis::analysisKinds())
      list.push_back({kind.name, kind.title, kind.description, false, kind.name == "gr", kind.knobs,
                      [&kind](const AnalysisInput& in) { return ofRegistry(kind, in); }});
    const auto own = [&](const char* id, const char* title, const char* tip, bool asksQuantity,
                         auto compute) {
      for (const auto& panel : list)
        if (panel.id == id) return; // the registry has it by now
      list.push_back({id, title, tip, asksQuantity, false, {}, compute});
    };
    list.push_back({"states", "States", "the state of what is shown, the evidence for it, and the thresholds",
                    false, false, analysis::analysisKind("vortex_states").knobs, states});
    own("histogram", "Histogram", "how any quantity of the grains is distributed", true, histogramOf);
    own("packing", "Packing", "packing fraction by height", false, packing);
    own("contacts", "Contacts", "how many contacts grains have", false, contactNumbers);
    own("forces", "Contact forces", "how contact forces and overlaps are distributed", false, forces);
    return list;
  }();
  return all;
}

} // namespace sandglass::desktop
