#include "analysis/result.h"

#include "analysis/csv_cell.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace sandglass::analysis {

namespace {

std::string axisText(const Axis& axis) {
  return axis.unit.empty() ? axis.name : fmt::format("{} [{}]", axis.name, axis.unit);
}

std::string comment(const std::string& key, std::string value) {
  for (char& c : value)
    if (c == '\n' || c == '\r') c = ' ';
  return fmt::format("# {}: {}\n", key, value);
}

bool sharesX(const Curve& curve) {
  for (const auto& s : curve.series)
    if (s.x != curve.series.front().x) return false;
  return true;
}

/// A name of `numbers` has one unit wherever it occurs; "" where it has none.
std::string unitOf(const Curve& curve, std::string name) {
  static const std::map<std::string, std::string> units{{"angle", "deg"},
                                                        {"angle_left", "deg"},
                                                        {"angle_right", "deg"},
                                                        {"apex", "m"},
                                                        {"beverloo_rate", "kg/s"},
                                                        {"bounce_period", "s"},
                                                        {"critical_rotation", "rad/s"},
                                                        {"curvature", "1/m"},
                                                        {"curvature_of_rotation", "1/m"},
                                                        {"cutoff", "m"},
                                                        {"density", "1/m^3"},
                                                        {"depth", "m"},
                                                        {"diameter", "m"},
                                                        {"diffusion", "m^2/s"},
                                                        {"grain_mean_force", "N"},
                                                        {"mass_end", "kg"},
                                                        {"mass_start", "kg"},
                                                        {"mean_speed", "m/s"},
                                                        {"range_end", "s"},
                                                        {"range_start", "s"},
                                                        {"rate", "kg/s"},
                                                        {"rate_per_depth", "kg/(m s)"},
                                                        {"rms", "m"},
                                                        {"rotation", "rad/s"},
                                                        {"rotation_of_surface", "rad/s"},
                                                        {"settled", "s"},
                                                        {"speed_deviation", "m/s"},
                                                        {"start", "s"},
                                                        {"wall_mean_force", "N"}};
  static const std::vector<std::string> ofDistributions{"mean",      "median",   "standard_deviation",
                                                        "deviation", "shortest", "longest"};
  for (const char* error : {"_standard_error", "_error"})
    if (const auto at = name.find(error); at != std::string::npos) name.resize(at);
  if (std::find(ofDistributions.begin(), ofDistributions.end(), name) != ofDistributions.end())
    return curve.x.unit;
  const auto found = units.find(name);
  return found == units.end() ? "" : found->second;
}

nlohmann::json axisJson(const Axis& axis) {
  return {{"name", axis.name}, {"unit", axis.unit}};
}

} // namespace

// fmt's "{}" prints the shortest digits that read back as the same double.

std::string toCsv(const Curve& curve) {
  std::string out = comment("title", curve.title) + comment("definition", curve.definition);
  if (curve.frames > 0) out += comment("frames", fmt::format("{}", curve.frames));
  if (!curve.series.empty()) out += comment("values", axisText(curve.y));
  for (const auto& [key, value] : curve.numbers)
    out += comment(axisText({key, unitOf(curve, key)}), fmt::format("{}", value));
  for (const auto& mark : curve.marks)
    out += comment("mark " + mark.label, fmt::format("{}", mark.position));
  for (const auto& [key, value] : curve.provenance)
    out += comment("provenance " + key, value);
  if (curve.series.empty()) return out + csvCell(axisText(curve.x)) + "," + csvCell(axisText(curve.y)) + "\n";

  if (sharesX(curve)) {
    out += csvCell(axisText(curve.x));
    for (const auto& s : curve.series) {
      const std::string& name = s.name.empty() ? curve.y.name : s.name;
      out += "," + csvCell(axisText({name, curve.y.unit}));
      if (!s.error.empty()) out += "," + csvCell(axisText({name + " error", curve.y.unit}));
    }
    out += "\n";
    for (std::size_t i = 0; i < curve.series.front().x.size(); ++i) {
      out += fmt::format("{}", curve.series.front().x[i]);
      for (const auto& s : curve.series) {
        out += fmt::format(",{}", s.y[i]);
        if (!s.error.empty()) out += fmt::format(",{}", s.error[i]);
      }
      out += "\n";
    }
    return out;
  }
  out += fmt::format("series,{},{},error\n", csvCell(axisText(curve.x)), csvCell(axisText(curve.y)));
  for (const auto& s : curve.series)
    for (std::size_t i = 0; i < s.x.size(); ++i)
      out += fmt::format("{},{},{},{}\n", csvCell(s.name), s.x[i], s.y[i],
                         s.error.empty() ? "" : fmt::format("{}", s.error[i]));
  return out;
}

std::string toJson(const Curve& curve) {
  nlohmann::json j{{"name", curve.name},     {"title", curve.title},     {"definition", curve.definition},
                   {"frames", curve.frames}, {"numbers", curve.numbers}, {"provenance", curve.provenance},
                   {"x", axisJson(curve.x)}, {"y", axisJson(curve.y)}};
  j["number_units"] = nlohmann::json::object();
  for (const auto& [key, unused] : curve.numbers)
    if (const auto unit = unitOf(curve, key); !unit.empty()) j["number_units"][key] = unit;
  j["series"] = nlohmann::json::array();
  for (const auto& s : curve.series) {
    nlohmann::json series{{"name", s.name}, {"x", s.x}, {"y", s.y}};
    if (!s.error.empty()) series["error"] = s.error;
    j["series"].push_back(std::move(series));
  }
  j["marks"] = nlohmann::json::array();
  for (const auto& m : curve.marks)
    j["marks"].push_back({{"label", m.label}, {"position", m.position}, {"vertical", m.vertical}});
  return j.dump(2) + "\n";
}

std::string toCsv(const Table& table) {
  std::string out = comment("title", table.title) + comment("definition", table.definition);
  for (const auto& [key, value] : table.provenance)
    out += comment("provenance " + key, value);
  const bool named = !table.rowNames.empty();
  if (named) out += csvCell(table.rowTitle);
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    out += (c || named ? "," : "") + csvCell(axisText(table.columns[c]));
  out += "\n";
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    if (named) out += csvCell(table.rowNames.at(r));
    for (std::size_t c = 0; c < table.rows[r].size(); ++c) {
      if (c || named) out += ",";
      if (!std::isnan(table.rows[r][c])) out += fmt::format("{}", table.rows[r][c]);
    }
    out += "\n";
  }
  return out;
}

std::string toJson(const Table& table) {
  nlohmann::json j{{"name", table.name},
                   {"title", table.title},
                   {"definition", table.definition},
                   {"rows", table.rows},
                   {"provenance", table.provenance}};
  if (!table.rowNames.empty()) {
    j["row_title"] = table.rowTitle;
    j["row_names"] = table.rowNames;
  }
  j["columns"] = nlohmann::json::array();
  for (const auto& column : table.columns)
    j["columns"].push_back(axisJson(column));
  return j.dump(2) + "\n";
}

} // namespace sandglass::analysis
