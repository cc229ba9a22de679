#include "analysis/sweep/phase_diagram.h"

#include "analysis/statistics.h"
#include "analysis/sweep/sweep_classes.h"
#include "sim/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace sandglass::analysis {

namespace {

/// What the runs of one place of the plane say.
struct Place {
  double x = 0, y = 0;
  std::map<std::string, std::vector<const SweepRow*>> names;
  std::vector<double> numbers;
  std::size_t runs = 0, failed = 0;
  std::string name;                                        ///< the commonest
  double value = std::numeric_limits<double>::quiet_NaN(); ///< the mean
  double agreement = 1;                                    ///< share of the runs that say `name`
  double spread = 0;                                       ///< standard deviation of the numbers
};

std::vector<std::string> orderOfNames(const std::vector<Place>& places) {
  std::set<std::string> names;
  for (const auto& p : places)
    for (const auto& [name, runs] : p.names)
      names.insert(name);
  return orderOfClasses(names);
}

void judge(Place& place, bool names) {
  if (names) {
    std::size_t most = 0;
    for (const auto& [name, runs] : place.names)
      if (runs.size() > most) place.name = name, most = runs.size();
    place.agreement = static_cast<double>(most) / static_cast<double>(place.runs);
    return;
  }
  if (place.numbers.empty()) return;
  place.value = mean(place.numbers);
  place.spread = std::sqrt(variance(place.numbers));
}

Series scattered(std::string name) {
  Series series{std::move(name), {}, {}, {}};
  series.scatter = true;
  return series;
}

Series lineOver(const SweepTable& table, const std::vector<const SweepRow*>& rows,
                const DiagramOptions& options) {
  const std::size_t x = table.column(options.x), y = table.column(options.line);
  std::map<double, std::vector<double>> values;
  for (const auto* row : rows)
    if (!std::isnan(row->number(y))) values[row->number(x)].push_back(row->number(y));
  std::string name = options.line;
  std::replace(name.begin(), name.end(), '_', ' ');
  Series line{name, {}, {}, {}};
  for (const auto& [at, found] : values) {
    line.x.push_back(at);
    line.y.push_back(mean(found));
  }
  return line;
}

} // namespace

PhaseDiagram phaseDiagram(const SweepTable& table, const DiagramOptions& given) {
  DiagramOptions options = given;
  const std::size_t x = table.column(options.x), y = table.column(options.y),
                    colour = table.column(options.colour);
  const auto& columns = table.columns();
  for (const std::size_t c : {x, y})
    if (columns[c].text)
      throw InputError(fmt::format("the column '{}' holds names, but an axis of a diagram needs numbers",
                                   columns[c].name));
  if (options.line == "auto") {
    const bool known = std::any_of(columns.begin(), columns.end(),
                                   [](const SweepColumn& c) { return c.name == "critical_rotation"; });
    options.line = known && isRotation(columns[y].unit) ? "critical_rotation" : "";
  }
  const bool names = columns[colour].text;

  const auto all = table.rows();
  std::vector<const SweepRow*> rows;
  std::map<std::pair<double, double>, Place> byPlace;
  for (const auto& row : all) {
    const bool wanted = std::all_of(options.where.begin(), options.where.end(), [&](const auto& condition) {
      return row.text(table.column(condition.first)) == condition.second;
    });
    const double px = row.number(x), py = row.number(y);
    if (!wanted || row.status == SweepStatus::waiting || std::isnan(px) || std::isnan(py)) continue;
    rows.push_back(&row);
    Place& place = byPlace[{px, py}];
    place.x = px;
    place.y = py;
    ++place.runs;
    if (row.status == SweepStatus::failed) ++place.failed;
    if (names)
      place.names[row.status == SweepStatus::failed ? failedName : row.text(colour)].push_back(&row);
    else if (!std::isnan(row.number(colour)))
      place.numbers.push_back(row.number(colour));
  }
  if (byPlace.empty()) throw InputError("the sweep has no runs yet that this diagram could show");
  std::vector<Place> places;
  for (auto& [at, place] : byPlace) {
    judge(place, names);
    places.push_back(std::move(place));
  }

  PhaseDiagram diagram;
  Curve& chart = diagram.chart;
  const auto axis = [&](std::size_t c) {
    std::string name = columns[c].name;
    std::replace(name.begin(), name.end(), '_', ' ');
    return Axis{name, columns[c].unit};
  };
  chart.name = fmt::format("diagram_{}_{}_{}", options.x, options.y, options.colour);
  chart.title = table.plan().title.empty() ? "Phase diagram" : table.plan().title;
  chart.x = axis(x);
  chart.y = axis(y);
  chart.definition =
      fmt::format("{} runs; {}{}: {}", rows.size(), columns[colour].name,
                  columns[colour].unit.empty() ? "" : fmt::format(" [{}]", columns[colour].unit),
                  columns[colour].description);
  for (const auto& [name, value] : options.where)
    chart.definition += fmt::format("; {} = {}", name, value);

  // First, even when empty: the kinds of points have the same colours with and without it.
  Series line;
  if (!options.line.empty()) {
    line = lineOver(table, rows, options);
    double highest = 0; // the line must not make the diagram small
    for (const auto& place : places)
      highest = std::max(highest, place.y);
    for (std::size_t k = line.x.size(); k-- > 0;)
      if (line.y[k] > 1.1 * highest) {
        line.x.erase(line.x.begin() + static_cast<std::ptrdiff_t>(k));
        line.y.erase(line.y.begin() + static_cast<std::ptrdiff_t>(k));
      }
  }
  chart.series.push_back(std::move(line));

  Series rings = scattered("seeds disagree");
  rings.ring = true;
  const auto add = [](Series& series, const Place& place) {
    series.x.push_back(place.x);
    series.y.push_back(place.y);
  };
  if (names) {
    for (const auto& name : orderOfNames(places)) {
      Series series = scattered(name);
      for (const auto& place : places)
        if (place.name == name) add(series, place);
      chart.series.push_back(std::move(series));
    }
    for (const auto& place : places)
      if (place.agreement < 1) add(rings, place);
  } else {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const auto& place : places)
      if (!std::isnan(place.value)) low = std::min(low, place.value), high = std::max(high, place.value);
    if (!(low <= high))
      throw InputError(fmt::format("no run has a number in the column '{}'", options.colour));
    const int classes = high > low ? std::clamp(options.classes, 1, 6) : 1;
    const double width = high > low ? (high - low) / classes : 1;
    for (int k = 0; k < classes; ++k) {
      const double from = low + k * width, to = k + 1 == classes ? high : from + width;
      Series series =
          scattered(k == 0 ? fmt::format("{:.3g} to {:.3g}", from, to) : fmt::format("to {:.3g}", to));
      for (const auto& place : places)
        if (!std::isnan(place.value) &&
            std::min(classes - 1, static_cast<int>((place.value - low) / width)) == k)
          add(series, place);
      chart.series.push_back(std::move(series));
    }
    Series none = scattered("none");
    for (const auto& place : places) {
      if (std::isnan(place.value)) add(none, place);
      if (place.spread > width) add(rings, place);
    }
    if (!none.x.empty()) chart.series.push_back(std::move(none));
  }
  if (!rings.x.empty()) chart.series.push_back(std::move(rings));
  Table& out = diagram.table;
  out.name = chart.name;
  out.title = chart.title;
  out.definition = chart.definition +
                   "; agreement: share of the runs with the commonest state; spread: standard "
                   "deviation over the seeds";
  out.columns = {{options.x, columns[x].unit},
                 {options.y, columns[y].unit},
                 {options.colour, columns[colour].unit},
                 {"agreement", ""},
                 {"spread", columns[colour].unit},
                 {"runs", ""},
                 {"failed", ""}};
  if (names) out.rowTitle = options.colour + " by name";
  const auto order = orderOfNames(places);
  for (const auto& place : places) {
    const auto code = std::find(order.begin(), order.end(), place.name) - order.begin();
    out.rows.push_back({place.x, place.y, names ? static_cast<double>(code) : place.value, place.agreement,
                        place.spread, static_cast<double>(place.runs), static_cast<double>(place.failed)});
    if (names) out.rowNames.push_back(place.name);
  }

  if (!names) return diagram;
  const bool sure = std::any_of(columns.begin(), columns.end(),
                                [](const SweepColumn& c) { return c.name == "confidence"; });
  for (const auto& name : order) {
    // In the middle of its field: the least sum of squares to the others of that name, in spans of the axes.
    double spanX = 1e-300, spanY = 1e-300, best = std::numeric_limits<double>::infinity();
    for (const auto& p : places) {
      spanX = std::max(spanX, std::abs(p.x - places.front().x));
      spanY = std::max(spanY, std::abs(p.y - places.front().y));
    }
    DiagramExample example;
    for (const auto& p : places) {
      if (p.name != name || name == failedName) continue;
      double sum = 0, count = 0;
      for (const auto& q : places)
        if (q.name == name) {
          sum += std::pow((p.x - q.x) / spanX, 2) + std::pow((p.y - q.y) / spanY, 2);
          count += 1;
        }
      const SweepRow* row = p.names.at(name).front();
      const double doubt = sure ? 1 - row->number(table.column("confidence")) : 0;
      const double cost = sum / count + (std::isnan(doubt) ? 1 : doubt) + (1 - p.agreement);
      if (cost >= best) continue;
      best = cost;
      example = {name, row->run,
                 fmt::format("{} {:.4g}{}{}, {} {:.4g}{}{}", chart.x.name, p.x,
                             chart.x.unit.empty() ? "" : " ", chart.x.unit, chart.y.name, p.y,
                             chart.y.unit.empty() ? "" : " ", chart.y.unit)};
    }
    if (example.run > 0) diagram.examples.push_back(std::move(example));
  }
  return diagram;
}

} // namespace sandglass::analysis
