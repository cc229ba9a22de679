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

/// One diagram in the making: places of the plane, then series, the table, and an example of each state.
class DiagramMaker {
public:
  DiagramMaker(const SweepTable& table, const DiagramOptions& options)
      : table_(table), options_(options), columns_(table.columns()), x_(table.column(options.x)),
        y_(table.column(options.y)), colour_(table.column(options.colour)), names_(columns_[colour_].text),
        all_(table.rows()) {
    for (const std::size_t c : {x_, y_})
      if (columns_[c].text)
        throw InputError(fmt::format("the column '{}' holds names, but an axis of a diagram needs numbers",
                                     columns_[c].name));
    if (options_.line == "auto")
      options_.line = has("critical_rotation") && isRotation(columns_[y_].unit) ? "critical_rotation" : "";
  }

  PhaseDiagram make() {
    collect();
    describe();
    // First, even when empty: the kinds of points have the same colours with and without it.
    diagram_.chart.series.push_back(options_.line.empty() ? Series{} : line());
    rings_.ring = true;
    names_ ? addNames() : addClasses();
    if (!rings_.x.empty()) diagram_.chart.series.push_back(std::move(rings_));
    fillTable();
    if (names_) addExamples();
    return std::move(diagram_);
  }

private:
  bool has(const char* column) const {
    return std::any_of(columns_.begin(), columns_.end(),
                       [&](const SweepColumn& c) { return c.name == column; });
  }

  static void add(Series& series, const Place& place) {
    series.x.push_back(place.x);
    series.y.push_back(place.y);
  }

  void collect() {
    std::map<std::pair<double, double>, Place> byPlace;
    for (const auto& row : all_) {
      const bool wanted =
          std::all_of(options_.where.begin(), options_.where.end(), [&](const auto& condition) {
            return row.text(table_.column(condition.first)) == condition.second;
          });
      const double px = row.number(x_), py = row.number(y_);
      if (!wanted || row.status == SweepStatus::waiting || std::isnan(px) || std::isnan(py)) continue;
      rows_.push_back(&row);
      Place& place = byPlace[{px, py}];
      place.x = px;
      place.y = py;
      ++place.runs;
      if (row.status == SweepStatus::failed) ++place.failed;
      if (names_)
        place.names[row.status == SweepStatus::failed ? failedName : row.text(colour_)].push_back(&row);
      else if (!std::isnan(row.number(colour_)))
        place.numbers.push_back(row.number(colour_));
    }
    if (byPlace.empty()) throw InputError("the sweep has no runs yet that this diagram could show");
    for (auto& [at, place] : byPlace) {
      judge(place, names_);
      places_.push_back(std::move(place));
    }
  }

  Axis axis(std::size_t column) const {
    std::string name = columns_[column].name;
    std::replace(name.begin(), name.end(), '_', ' ');
    return {name, columns_[column].unit};
  }

  void describe() {
    Curve& chart = diagram_.chart;
    const SweepColumn& colour = columns_[colour_];
    chart.name = fmt::format("diagram_{}_{}_{}", options_.x, options_.y, options_.colour);
    chart.title = table_.plan().title.empty() ? "Phase diagram" : table_.plan().title;
    chart.x = axis(x_);
    chart.y = axis(y_);
    chart.definition =
        fmt::format("{} runs; {}{}: {}", rows_.size(), colour.name,
                    colour.unit.empty() ? "" : fmt::format(" [{}]", colour.unit), colour.description);
    for (const auto& [name, value] : options_.where)
      chart.definition += fmt::format("; {} = {}", name, value);
  }

  Series line() const {
    Series line = lineOver(table_, rows_, options_);
    double highest = 0; // the line must not make the diagram small
    for (const auto& place : places_)
      highest = std::max(highest, place.y);
    for (std::size_t k = line.x.size(); k-- > 0;)
      if (line.y[k] > 1.1 * highest) {
        line.x.erase(line.x.begin() + static_cast<std::ptrdiff_t>(k));
        line.y.erase(line.y.begin() + static_cast<std::ptrdiff_t>(k));
      }
    return line;
  }

  void addNames() {
    for (const auto& name : orderOfNames(places_)) {
      Series series = scattered(name);
      for (const auto& place : places_)
        if (place.name == name) add(series, place);
      diagram_.chart.series.push_back(std::move(series));
    }
    for (const auto& place : places_)
      if (place.agreement < 1) add(rings_, place);
  }

  void addClasses() {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const auto& place : places_)
      if (!std::isnan(place.value)) low = std::min(low, place.value), high = std::max(high, place.value);
    if (!(low <= high))
      throw InputError(fmt::format("no run has a number in the column '{}'", options_.colour));
    const int classes = high > low ? std::clamp(options_.classes, 1, 6) : 1;
    const double width = high > low ? (high - low) / classes : 1;
    for (int k = 0; k < classes; ++k) {
      const double from = low + k * width, to = k + 1 == classes ? high : from + width;
      Series series =
          scattered(k == 0 ? fmt::format("{:.3g} to {:.3g}", from, to) : fmt::format("to {:.3g}", to));
      for (const auto& place : places_)
        if (!std::isnan(place.value) &&
            std::min(classes - 1, static_cast<int>((place.value - low) / width)) == k)
          add(series, place);
      diagram_.chart.series.push_back(std::move(series));
    }
    Series none = scattered("none");
    for (const auto& place : places_) {
      if (std::isnan(place.value)) add(none, place);
      if (place.spread > width) add(rings_, place);
    }
    if (!none.x.empty()) diagram_.chart.series.push_back(std::move(none));
  }

  void fillTable() {
    Table& out = diagram_.table;
    out.name = diagram_.chart.name;
    out.title = diagram_.chart.title;
    out.definition = diagram_.chart.definition +
                     "; agreement: share of the runs with the commonest state; spread: standard "
                     "deviation over the seeds";
    out.columns = {{options_.x, columns_[x_].unit},
                   {options_.y, columns_[y_].unit},
                   {options_.colour, columns_[colour_].unit},
                   {"agreement", ""},
                   {"spread", columns_[colour_].unit},
                   {"runs", ""},
                   {"failed", ""}};
    if (names_) out.rowTitle = options_.colour + " by name";
    const auto order = orderOfNames(places_);
    for (const auto& place : places_) {
      const auto code = std::find(order.begin(), order.end(), place.name) - order.begin();
      out.rows.push_back({place.x, place.y, names_ ? static_cast<double>(code) : place.value, place.agreement,
                          place.spread, static_cast<double>(place.runs), static_cast<double>(place.failed)});
      if (names_) out.rowNames.push_back(place.name);
    }
  }

  void addExamples() {
    for (const auto& name : orderOfNames(places_)) {
      if (name == failedName) continue;
      const DiagramExample found = example(name);
      if (found.run > 0) diagram_.examples.push_back(found); // 0: a name that is nowhere the commonest
    }
  }

  /// A run in the middle of the field of a state: the least sum of squares to the others of that name, in
  /// spans of the axes.
  DiagramExample example(const std::string& name) const {
    const bool sure = has("confidence");
    double spanX = 1e-300, spanY = 1e-300, best = std::numeric_limits<double>::infinity();
    for (const auto& p : places_) {
      spanX = std::max(spanX, std::abs(p.x - places_.front().x));
      spanY = std::max(spanY, std::abs(p.y - places_.front().y));
    }
    const auto named = [](const Axis& axis, double value) {
      return fmt::format("{} {:.4g}{}{}", axis.name, value, axis.unit.empty() ? "" : " ", axis.unit);
    };
    DiagramExample found;
    for (const auto& p : places_) {
      if (p.name != name) continue;
      double sum = 0, count = 0;
      for (const auto& q : places_)
        if (q.name == name) {
          sum += std::pow((p.x - q.x) / spanX, 2) + std::pow((p.y - q.y) / spanY, 2);
          count += 1;
        }
      const SweepRow* row = p.names.at(name).front();
      const double doubt = sure ? 1 - row->number(table_.column("confidence")) : 0;
      const double cost = sum / count + (std::isnan(doubt) ? 1 : doubt) + (1 - p.agreement);
      if (cost >= best) continue;
      best = cost;
      found = {name, row->run,
               fmt::format("{}, {}", named(diagram_.chart.x, p.x), named(diagram_.chart.y, p.y))};
    }
    return found;
  }

  const SweepTable& table_;
  DiagramOptions options_;
  const std::vector<SweepColumn>& columns_;
  std::size_t x_, y_, colour_;
  bool names_; ///< the colour is a name
  std::vector<SweepRow> all_;
  std::vector<const SweepRow*> rows_; ///< those that the diagram shows
  std::vector<Place> places_;
  PhaseDiagram diagram_;
  Series rings_ = scattered("seeds disagree");
};

} // namespace

PhaseDiagram phaseDiagram(const SweepTable& table, const DiagramOptions& options) {
  return DiagramMaker(table, options).make();
}

} // namespace sandglass::analysis
