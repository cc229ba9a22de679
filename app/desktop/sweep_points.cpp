#include "app/desktop/sweep_points.h"

#include "analysis/statistics.h"
#include "analysis/sweep/sweep_classes.h"
#include "sim/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace sandglass::desktop {

namespace fs = std::filesystem;

namespace {

bool isText(const SweepData& data, std::size_t column) {
  return data.columns[column].text;
}

bool matches(const SweepData& data, const analysis::SweepRow& row, const SweepChoice& choice) {
  return std::all_of(choice.only.begin(), choice.only.end(),
                     [&](const auto& only) { return cellText(data, row, only.first) == only.second; });
}

std::vector<std::string> classesOf(const SweepData& data, std::size_t column) {
  std::set<std::string> found;
  for (const auto& row : data.rows)
    if (row.status == analysis::SweepStatus::done) found.insert(row.text(column));
  return analysis::orderOfClasses(found);
}

void judgeTexts(SweepSpot& spot, const SweepData& data, std::size_t column,
                const std::vector<std::string>& classes) {
  int runs = 0, most = 0;
  for (const auto k : spot.rows) {
    if (data.rows[k].status != analysis::SweepStatus::done) continue;
    const auto at = std::find(classes.begin(), classes.end(), data.rows[k].text(column));
    ++spot.classes[static_cast<int>(at - classes.begin())];
    ++runs;
  }
  for (const auto& [which, count] : spot.classes)
    if (count > most) most = count, spot.shownClass = which;
  spot.disagreement = runs > 0 ? 1 - static_cast<double>(most) / runs : 0;
}

void judgeNumbers(SweepSpot& spot, const SweepData& data, std::size_t column) {
  std::vector<double> values;
  for (const auto k : spot.rows)
    if (const double v = data.rows[k].number(column);
        data.rows[k].status == analysis::SweepStatus::done && std::isfinite(v))
      values.push_back(v);
  spot.value = values.empty() ? std::nan("") : analysis::mean(values);
  spot.deviation = std::sqrt(analysis::variance(values));
}

/// The column's mean over the runs of each place along `along`.
std::map<double, double> meansAlong(const SweepData& data, const SweepChoice& choice, std::size_t column,
                                    std::size_t along) {
  std::map<double, std::vector<double>> values;
  for (const auto& row : data.rows) {
    const double at = row.number(along), v = row.number(column);
    if (row.status != analysis::SweepStatus::done || !std::isfinite(at) || !std::isfinite(v) ||
        !matches(data, row, choice))
      continue;
    values[at].push_back(v);
  }
  std::map<double, double> means;
  for (const auto& [at, found] : values)
    means[at] = analysis::mean(found);
  return means;
}

std::vector<std::pair<double, double>> criticalCurve(const SweepData& data, const SweepChoice& choice) {
  const auto found = std::find_if(data.columns.begin(), data.columns.end(),
                                  [](const auto& c) { return c.name == "critical_rotation"; });
  std::vector<std::pair<double, double>> curve;
  if (found == data.columns.end()) return curve;
  const auto critical = static_cast<std::size_t>(found - data.columns.begin());
  const auto &x = data.columns[choice.x], &y = data.columns[choice.y];
  const auto isRatio = [](const analysis::SweepColumn& c) {
    return c.name.find("ratio") != std::string::npos && c.name.find("curvature") == std::string::npos;
  };
  if (choice.x == critical || choice.y == critical) return curve;
  if (analysis::isRotation(y.unit) || isRatio(y)) {
    for (const auto& [at, mean] : meansAlong(data, choice, critical, choice.x))
      curve.emplace_back(at, isRatio(y) ? 1 : mean);
  } else if (analysis::isRotation(x.unit) || isRatio(x)) {
    for (const auto& [at, mean] : meansAlong(data, choice, critical, choice.y))
      curve.emplace_back(isRatio(x) ? 1 : mean, at);
  }
  return curve;
}

} // namespace

bool isSweep(const fs::path& path) {
  return path.extension() == ".sqlite" || fs::exists(path / analysis::SweepTable::fileName);
}

std::shared_ptr<const SweepData> readSweepData(const fs::path& path) {
  const analysis::SweepTable table(path);
  auto data = std::make_shared<SweepData>();
  data->folder = fs::is_directory(path) ? path : fs::absolute(path).parent_path();
  data->title = table.info("title");
  data->columns = table.columns();
  data->rows = table.rows();
  while (data->axes < data->columns.size() && data->columns[data->axes].role == analysis::SweepRole::axis)
    ++data->axes;
  for (const auto& row : data->rows) {
    data->waiting += row.status == analysis::SweepStatus::waiting;
    data->failed += row.status == analysis::SweepStatus::failed;
  }
  return data;
}

SweepRunData readSweepRun(const fs::path& folder, int run) {
  const analysis::SweepTable table(folder);
  return {run, table.scene(run), table.lastFrame(run), table.curves(run)};
}

std::string cellText(const SweepData& data, const analysis::SweepRow& row, std::size_t column) {
  if (column >= row.values.size()) return "";
  if (isText(data, column)) return row.text(column);
  const double v = row.number(column);
  return std::isfinite(v) ? fmt::format("{:.6g}", v) : "";
}

std::vector<std::size_t> columnsFor(const SweepData& data, bool alsoTexts) {
  std::vector<std::size_t> columns;
  for (std::size_t k = 0; k < data.columns.size(); ++k)
    if (alsoTexts || !isText(data, k)) columns.push_back(k);
  return columns;
}

SweepChoice firstChoice(const SweepData& data) {
  SweepChoice choice;
  const auto numbers = columnsFor(data, false);
  choice.x = numbers.empty() ? 0 : numbers[0];
  choice.y = numbers.size() > 1 ? numbers[1] : choice.x;
  choice.colour = data.columns.size() - 1;
  for (std::size_t k = data.columns.size(); k-- > 0;)
    if (data.columns[k].role == analysis::SweepRole::result) choice.colour = k;
  for (std::size_t k = 0; k < data.columns.size(); ++k)
    if (data.columns[k].name == "state") choice.colour = k;
  return choice;
}

SweepDiagram diagramOf(const SweepData& data, const SweepChoice& choice) {
  SweepDiagram diagram;
  if (isText(data, choice.colour)) diagram.classes = classesOf(data, choice.colour);
  std::map<int, SweepSpot> byPoint;
  for (std::size_t k = 0; k < data.rows.size(); ++k)
    if (matches(data, data.rows[k], choice)) byPoint[data.rows[k].point].rows.push_back(k);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (auto& [point, spot] : byPoint) {
    spot.point = point;
    spot.failed = true;
    double x = 0, y = 0;
    int placed = 0;
    for (const auto k : spot.rows) {
      const auto& row = data.rows[k];
      spot.done = spot.done || row.status == analysis::SweepStatus::done;
      spot.failed = spot.failed && row.status == analysis::SweepStatus::failed;
      if (!std::isfinite(row.number(choice.x)) || !std::isfinite(row.number(choice.y))) continue;
      x += row.number(choice.x); // a mean where it is a result
      y += row.number(choice.y);
      ++placed;
    }
    if (placed == 0) continue;
    spot.x = x / placed;
    spot.y = y / placed;
    if (diagram.classes.empty())
      judgeNumbers(spot, data, choice.colour);
    else
      judgeTexts(spot, data, choice.colour, diagram.classes);
    if (std::isfinite(spot.value)) low = std::min(low, spot.value), high = std::max(high, spot.value);
    diagram.spots.push_back(std::move(spot));
  }
  if (low <= high) diagram.low = low, diagram.high = high;
  if (diagram.classes.empty())
    for (auto& spot : diagram.spots)
      spot.disagreement = high > low ? spot.deviation / (high - low) : 0;
  diagram.critical = criticalCurve(data, choice);
  return diagram;
}

} // namespace sandglass::desktop
