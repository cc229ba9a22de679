#include "analysis/vortex/vortex_results.h"

#include "analysis/vortex/vortex_states.h"
#include "analysis/vortex/vortex_theory.h"

#include <fmt/format.h>

#include <cmath>

namespace sandglass::analysis {

namespace {

std::string definitionOf(const VortexRules& rules) {
  std::string text = fmt::format("rules '{}' ({})", rules.name,
                                 rules.sliding ? "windows in s, ending now" : "windows in frames");
  for (const auto& [name, value] : rules.thresholds())
    text += fmt::format(", {} = {:.4g}", name, value);
  return text;
}

template <class Value>
Curve courseOf(const VortexMeasures& measures, const char* name, const char* title, Axis y,
               std::string definition, Value&& value) {
  Curve curve;
  curve.name = name;
  curve.title = title;
  curve.definition = std::move(definition);
  curve.x = {"time", "s"};
  curve.y = std::move(y);
  curve.frames = measures.samples().size();
  Series series{title, {}, {}, {}};
  for (const auto& s : measures.samples()) {
    series.x.push_back(s.time);
    series.y.push_back(value(s));
  }
  curve.series.push_back(std::move(series));
  return curve;
}

Curve surface(const VortexMeasures& measures) {
  const SurfaceProfile p = measures.profile();
  Curve curve;
  curve.name = "vortex_surface";
  curve.title = "Surface of the bed";
  curve.definition =
      fmt::format("highest centre in {} bins of distance from the axis, mean over the last {} "
                  "frames; paraboloid through bins filled in half of them, least squares",
                  measures.bins(), std::min(measures.samples().size(), VortexMeasures::profileFrames));
  curve.x = {"distance from the axis", "m"};
  curve.y = {"height above the floor", "m"};
  curve.frames = std::min(measures.samples().size(), VortexMeasures::profileFrames);
  const double floor = measures.tank().floor;
  Series found{"surface", {}, {}, {}}, fit{"paraboloid", {}, {}, {}};
  for (std::size_t b = 0; b < p.distance.size(); ++b) {
    if (!std::isnan(p.height[b])) {
      found.x.push_back(p.distance[b]);
      found.y.push_back(p.height[b] - floor);
    }
    if (std::isnan(p.curvature)) continue;
    fit.x.push_back(p.distance[b]);
    fit.y.push_back(p.apex + p.curvature * p.distance[b] * p.distance[b] - floor);
  }
  curve.series = {found};
  if (!fit.x.empty()) curve.series.push_back(fit);
  const double rotation = bedRotation(measures, VortexMeasures::profileFrames);
  curve.numbers = {{"curvature", p.curvature},
                   {"curvature_of_rotation", rotation * rotation / (2 * measures.tank().gravity)},
                   {"apex", p.apex - floor},
                   {"rms", p.rms},
                   {"rotation_of_surface", p.rotation}};
  return curve;
}

Table verdictTable(const VortexMeasures& measures) {
  Table table;
  table.name = "vortex_states";
  table.title = "State by each set of rules";
  table.definition =
      "0 unresolved, 1 flat, 2 fluid, 3 pinned, 4 small spout, 5 large spout; confidence: share "
      "of thresholds moved by a fifth that give the same state";
  table.rowTitle = "rules";
  table.columns = {{"state", ""}, {"start", "s"}, {"settled", "s"}, {"confidence", ""}};
  for (const auto& rules : {ownVortexRules(), textVortexRules(), listedVortexRules()}) {
    const VortexVerdict v = vortexVerdict(measures, rules);
    table.rowNames.push_back(rules.name);
    table.rows.push_back({static_cast<double>(v.state), v.start, v.settled, v.confidence});
  }
  return table;
}

Table evidenceTable(const VortexVerdict& verdict, const VortexMeasures& measures, const VortexRules& rules) {
  Table table;
  table.name = "vortex_evidence";
  table.title = "What the state is decided from";
  table.rowTitle = "rule";
  table.columns = {{"holds", ""}, {"found", ""}, {"needed", ""}, {"since", "s"}};
  for (const auto& e : verdict.evidence) {
    table.rowNames.push_back(e.rule);
    table.rows.push_back({e.holds ? 1.0 : 0.0, e.found, e.needed, e.since});
    table.definition += fmt::format("{}{}: {}", table.definition.empty() ? "" : "; ", e.rule, e.measure);
  }
  const double none = std::nan("");
  for (const auto& [name, value] : rules.thresholds()) {
    table.rowNames.push_back("threshold " + name);
    table.rows.push_back({none, none, value, none});
  }
  const auto& limits = measures.limits();
  for (const auto& [name, value] : {std::pair{"rise", limits.rise},
                                    {"riser_step", limits.riserStep},
                                    {"riser_speed", limits.riserSpeed},
                                    {"spout_reach", limits.spoutReach}}) {
    table.rowNames.push_back(std::string("threshold ") + name);
    table.rows.push_back({none, none, value, none});
  }
  return table;
}

} // namespace

Results vortexResults(const VortexMeasures& measures, const VortexRules& rules) {
  Results results;
  const VortexVerdict verdict = vortexVerdict(measures, rules);
  const VortexTank& tank = measures.tank();
  const auto states = vortexHistory(measures, rules);
  std::size_t k = 0;
  Curve state = courseOf(
      measures, "vortex_state", "State",
      {"state (0 unresolved, 1 flat, 2 fluid, 3 pinned, 4 small, 5 large spout)", ""}, definitionOf(rules),
      [&](const VortexSample&) { return k < states.size() ? static_cast<double>(states[k++]) : 0.0; });
  state.numbers = {{"state", static_cast<double>(verdict.state)},
                   {"start", verdict.start},
                   {"settled", verdict.settled},
                   {"confidence", verdict.confidence}};
  const double bounce = bouncePeriod(measures).value_or(-1);
  state.numbers["bounce_period"] = bounce;
  results.curves.push_back(std::move(state));

  Curve rotation = courseOf(measures, "vortex_rotation", "Rotation of the bed", {"rotation", "rad/s"},
                            "angular momentum about the axis over moment of inertia of the centres",
                            [](const VortexSample& s) { return s.rotation; });
  const double critical =
      criticalRotation(static_cast<double>(measures.grains()), measures.radius(), tank.radius, tank.gravity);
  rotation.numbers = {{"rotation", bedRotation(measures)}, {"critical_rotation", critical}};
  rotation.marks = {{"critical rotation", std::copysign(critical, bedRotation(measures)), false}};
  results.curves.push_back(std::move(rotation));

  Curve core = courseOf(measures, "vortex_core", "Empty core", {"core radius / tank radius", ""},
                        "distance of the innermost centre from the axis, over the tank's radius",
                        [&](const VortexSample& s) { return s.core / tank.radius; });
  core.numbers = {{"core", coreRadius(measures) / tank.radius}};
  results.curves.push_back(std::move(core));

  const bool own = rules.sliding;
  results.curves.push_back(courseOf(
      measures, "vortex_risers", "Rising grains", {"rising grains", ""},
      own ? fmt::format("within {:.3g} tank radii of the axis, {:.3g} sqrt(g r) faster upwards than the mean",
                        measures.limits().spoutReach, measures.limits().riserSpeed)
          : fmt::format(
                "within {:.3g} tank radii of the axis, {:.3g} r a frame further upwards than the mean",
                measures.limits().spoutReach, measures.limits().riserStep),
      [own](const VortexSample& s) { return own ? s.speedRisers[1] : s.stepRisers[1]; }));
  results.curves.push_back(courseOf(measures, "vortex_energy", "Energy of a grain", {"energy", "J"},
                                    "mean of a grain: moving, turning, and weight above the floor",
                                    [](const VortexSample& s) { return s.aboveFloor; }));
  results.curves.push_back(surface(measures));
  results.tables = {verdictTable(measures), evidenceTable(verdict, measures, rules)};

  std::string sentence = fmt::format("vortex: {}", nameOf(verdict.state));
  if (!std::isnan(verdict.start)) sentence += fmt::format(" since {:.4g} s", verdict.start);
  sentence += fmt::format(" (confidence {:.0f} %, rules '{}')", 100 * verdict.confidence, rules.name);
  if (!std::isnan(verdict.settled)) sentence += fmt::format(", settled at {:.4g} s", verdict.settled);
  sentence +=
      fmt::format("; bed at {:.4g} rad/s, {:.3g} of the critical {:.4g}; empty core {:.3g} of the tank",
                  bedRotation(measures), std::abs(bedRotation(measures)) / critical, critical,
                  coreRadius(measures) / tank.radius);
  if (bounce > 0) sentence += fmt::format("; bounces every {:.4g} s", bounce);
  results.sentences.push_back(std::move(sentence));
  return results;
}

} // namespace sandglass::analysis
