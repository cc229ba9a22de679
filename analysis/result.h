#pragma once
// What an analysis returns. Results know their axes, units, definition and error bars; they print themselves
// as CSV and JSON; vis draws them.

#include <map>
#include <string>
#include <vector>

namespace sandglass::analysis {

struct Axis {
  std::string name; ///< "r / d", "discharged mass"
  std::string unit; ///< SI symbol, "" when dimensionless
};

/// One line of a Curve. `error` is a standard error of y, empty when there is none.
struct Series {
  std::string name;
  std::vector<double> x, y, error;
  bool scatter = false; ///< points with no line between them
  bool ring = false;    ///< of a scatter: drawn around the points of others
};

/// A vertical or horizontal mark worth drawing: a first minimum, a fit's range, a reference value.
struct Mark {
  std::string label;
  double position = 0;
  bool vertical = true;
};

struct Curve {
  std::string name; ///< file stem: "gr", "discharge"
  std::string title;
  std::string definition; ///< one line: estimator, region, cut-off
  Axis x, y;
  std::vector<Series> series;
  std::vector<Mark> marks;
  std::size_t frames = 0;                ///< frames averaged
  std::map<std::string, double> numbers; ///< "rate", "rate_error_95", ...
  std::map<std::string, std::string> provenance;
};

/// Rows of named columns; numbers only, but for a first column of names where rows have them.
struct Table {
  std::string name, title, definition;
  std::vector<Axis> columns;             ///< of the numbers
  std::vector<std::vector<double>> rows; ///< NaN: an empty cell
  std::map<std::string, std::string> provenance;
  std::string rowTitle{};              ///< heading of the names
  std::vector<std::string> rowNames{}; ///< one for each row, or none
};

/// CSV: a comment header (title, definition, frames, what the values are, numbers, provenance), then
/// x,y[,error] columns, each with its unit; series of unequal x follow each other with their name in the
/// first column. Numbers of the same name have the same unit in every Curve.
std::string toCsv(const Curve& curve);
std::string toJson(const Curve& curve);
std::string toCsv(const Table& table);
std::string toJson(const Table& table);

} // namespace sandglass::analysis
