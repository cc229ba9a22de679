#include "analysis/sweep/sweep_plan.h"

#include "analysis/sweep/expression.h"
#include "sim/base/error.h"
#include "sim/scene/units.h"

#include <fmt/format.h>

#include <cmath>

namespace sandglass::analysis {

namespace {

std::string assignment(const std::string& key, const SweepValue& value, const std::string& unit, bool whole) {
  if (const auto* text = std::get_if<std::string>(&value)) {
    std::string quoted;
    for (const char c : *text) {
      if (c == '"' || c == '\\') quoted += '\\';
      quoted += c;
    }
    return fmt::format("{}=\"{}\"", key, quoted);
  }
  const double number = std::get<double>(value);
  if (whole) return fmt::format("{}={}", key, static_cast<std::int64_t>(number));
  if (unit == "1") return fmt::format("{}={}", key, number);
  return fmt::format("{}=\"{}\"", key, quantityText(number, unit));
}

} // namespace

std::vector<SweepValue> deriveValues(const SweepPlan& plan, const std::vector<SweepValue>& axes) {
  std::map<std::string, double> known;
  for (std::size_t a = 0; a < plan.axes.size(); ++a)
    if (const auto* number = std::get_if<double>(&axes[a])) known[plan.axes[a].name] = *number;
  std::vector<SweepValue> values;
  for (const auto& d : plan.derived) {
    double value = 0;
    try {
      value = evaluate(d.expression, known);
    } catch (const InputError& e) {
      throw InputError(fmt::format("{}: derived.{}.value {}", plan.file, d.name, e.what()));
    }
    if (d.whole) value = std::round(value);
    if (!std::isfinite(value))
      throw InputError(
          fmt::format("{}: derived.{}.value \"{}\" is no finite number", plan.file, d.name, d.expression));
    known[d.name] = value;
    values.emplace_back(value);
  }
  return values;
}

std::vector<std::string> overridesOf(const SweepPlan& plan, const SweepPoint& point) {
  std::vector<std::string> all = plan.set;
  for (std::size_t a = 0; a < plan.axes.size(); ++a)
    for (const auto& key : plan.axes[a].keys)
      all.push_back(assignment(key, point.values[a], plan.axes[a].unit, false));
  for (std::size_t d = 0; d < plan.derived.size(); ++d)
    for (const auto& key : plan.derived[d].keys)
      all.push_back(assignment(key, point.values[plan.axes.size() + d], plan.derived[d].unit,
                               plan.derived[d].whole && plan.derived[d].unit == "1"));
  return all;
}

Scene sceneOf(const SweepPlan& plan, const SweepPoint& point, std::uint64_t seed) {
  auto overrides = overridesOf(plan, point);
  overrides.push_back(fmt::format("seed={}", seed));
  const auto folder = std::filesystem::path(plan.sceneFile).parent_path();
  return parseScene(plan.sceneText, plan.sceneFile, overrides, folder.empty() ? "." : folder.string());
}

} // namespace sandglass::analysis
