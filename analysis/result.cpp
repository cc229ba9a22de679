#include "analysis/result.h"

#include "analysis/csv_cell.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

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

nlohmann::json axisJson(const Axis& axis) {
  return {{"name", axis.name}, {"unit", axis.unit}};
}

} // namespace

// fmt's "{}" prints the shortest digits that read back as the same double.

std::string toCsv(const Curve& curve) {
  std::string out = comment("title", curve.title) + comment("definition", curve.definition);
  if (curve.frames > 0) out += comment("frames", fmt::format("{}", curve.frames));
  for (const auto& [key, value] : curve.numbers)
    out += comment(key, fmt::format("{}", value));
  for (const auto& mark : curve.marks)
    out += comment("mark " + mark.label, fmt::format("{}", mark.position));
  for (const auto& [key, value] : curve.provenance)
    out += comment("provenance " + key, value);
  if (curve.series.empty()) return out + csvCell(axisText(curve.x)) + "," + csvCell(axisText(curve.y)) + "\n";

  if (sharesX(curve)) {
    out += csvCell(axisText(curve.x));
    for (const auto& s : curve.series) {
      const std::string name = s.name.empty() ? axisText(curve.y) : s.name;
      out += "," + csvCell(name);
      if (!s.error.empty()) out += "," + csvCell(name + " error");
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
