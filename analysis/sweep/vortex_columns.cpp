#include "analysis/sweep/vortex_columns.h"

#include "analysis/vortex/vortex_results.h"
#include "analysis/vortex/vortex_states.h"
#include "analysis/vortex/vortex_theory.h"

#include <cmath>

namespace sandglass::analysis {

std::vector<std::pair<SweepColumn, SweepValue>> vortexColumns(const VortexMeasures& measures,
                                                              const Frame& last, const VortexRules& rules) {
  std::vector<std::pair<SweepColumn, SweepValue>> all;
  const auto number = [&](const char* name, const char* unit, const char* description, double value) {
    all.emplace_back(SweepColumn{name, unit, SweepRole::result, false, description}, value);
  };
  const auto text = [&](const char* name, const char* description, const std::string& value) {
    all.emplace_back(SweepColumn{name, "", SweepRole::result, true, description}, value);
  };
  const auto limited = [&](VortexRules source) {
    source.heightLimit = rules.heightLimit;
    return source;
  };
  const VortexVerdict own = vortexVerdict(measures, rules),
                      byText = vortexVerdict(measures, limited(textVortexRules())),
                      listed = vortexVerdict(measures, limited(listedVortexRules()));
  text("state", "of the bed, by our rules", nameOf(own.state));
  number("state_start", "s", "since when without break", own.start);
  number("confidence", "", "share of thresholds moved by a fifth that give the same state", own.confidence);
  number("settle_time", "s", "when the bed had settled, by our rules", own.settled);
  text("state_text", "by the rules in the source's text", nameOf(byText.state));
  text("state_listed", "by the rules in the source's listing", nameOf(listed.state));
  number("listed_code", "", "the source's code: 0 unresolved, 1 settled, 2 fluid, 3 pinned, 4 and 5 spouts",
         static_cast<double>(listed.state));
  number("listed_start", "s", "since when, by the listing", listed.start);
  number("listed_settle_time", "s", "when the bed had settled, by the listing", listed.settled);

  const VortexTank& tank = measures.tank();
  const auto& samples = measures.samples();
  const double rotation = std::abs(bedRotation(measures));
  const double critical =
      criticalRotation(static_cast<double>(measures.grains()), measures.radius(), tank.radius, tank.gravity);
  number("rotation", "rad/s", "of the bed, mean of the last 1000 frames", rotation);
  number("rotation_end", "rad/s", "of the bed, at the end", std::abs(samples.back().rotation));
  number("critical_rotation", "rad/s", "at which a close-packed bed's paraboloid touches the floor",
         critical);
  number("rotation_ratio", "", "rotation / critical_rotation", rotation / critical);
  number("core", "", "empty core / tank radius, median of the last 1000 frames",
         coreRadius(measures) / tank.radius);
  const SurfaceProfile surface = measures.profile();
  number("curvature", "1/m", "of the paraboloid through the surface", surface.curvature);
  number("curvature_ratio", "", "curvature over rotation^2 / 2 g",
         surface.curvature * 2 * tank.gravity / (rotation * rotation));
  double risers = 0, height = 0;
  const std::size_t from = samples.size() - std::min<std::size_t>(1000, samples.size());
  for (std::size_t k = from; k < samples.size(); ++k) {
    risers += samples[k].speedRisers[1] / static_cast<double>(samples.size() - from);
    height += samples[k].meanHeight / static_cast<double>(samples.size() - from);
  }
  number("risers", "", "rising grains, mean of the last 1000 frames", risers);
  number("mean_height", "m", "of the centres above the floor", height - tank.floor);
  number("bounce_period", "s", "of the mean height", bouncePeriod(measures).value_or(std::nan("")));
  double distance = 0, speed = 0;
  const auto& velocity = last.vector(quantity::velocity);
  for (std::size_t i = 0; i < last.size(); ++i) {
    const Vec3 x = last.position[i] - tank.onAxis;
    distance += (x - x.dot(tank.up) * tank.up).norm() / static_cast<double>(last.size());
    speed += velocity[i].norm() / static_cast<double>(last.size());
  }
  number("mean_distance", "m", "of the centres from the axis, at the end", distance);
  number("mean_speed", "m/s", "of the grains, at the end", speed);
  return all;
}

std::vector<Curve> vortexCurves(const VortexMeasures& measures, const VortexRules& rules) {
  std::vector<Curve> curves = vortexResults(measures, rules).curves;
  for (auto& curve : curves)
    if (curve.name == "vortex_surface") curve.series.resize(1);
  return curves;
}

} // namespace sandglass::analysis
