#pragma once
// A sweep as the window sees it: the table read at once, and its points placed in a phase diagram.

#include "analysis/result.h"
#include "analysis/sweep/sweep_table.h"
#include "sim/frame/frame.h"
#include "sim/scene/scene.h"

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace sandglass::desktop {

struct SweepData {
  std::filesystem::path folder; ///< of the sweep
  std::string title;
  std::vector<analysis::SweepColumn> columns;
  std::vector<analysis::SweepRow> rows;
  std::size_t axes = 0; ///< the first columns are the axes
  std::size_t waiting = 0, failed = 0;
};

/// From a folder with a sweep.sqlite, or that file. In a worker. Throws InputError.
std::shared_ptr<const SweepData> readSweepData(const std::filesystem::path& path);
bool isSweep(const std::filesystem::path& path);

/// What is kept of one run of a sweep.
struct SweepRunData {
  int run = 0;
  Scene scene;
  FramePtr last; ///< null: none was kept
  std::vector<analysis::Curve> curves;
};
SweepRunData readSweepRun(const std::filesystem::path& folder, int run);

/// What a diagram shows.
struct SweepChoice {
  std::size_t x = 0, y = 1, colour = 0;      ///< columns; x and y of numbers
  std::map<std::size_t, std::string> only{}; ///< of further axes: the one value to show, as text
};

/// The runs of one point.
struct SweepSpot {
  int point = 0;
  std::vector<std::size_t> rows; ///< in SweepData::rows, by replicate
  double x = 0, y = 0;
  bool done = false, failed = false; ///< any run of it; all of them
  int shownClass = -1;               ///< of texts: the commonest, the first of equals
  std::map<int, int> classes;        ///< of texts: how many runs have each
  double value = 0;                  ///< of numbers: the mean; NaN: none
  double deviation = 0;              ///< of numbers: standard deviation of the runs; 0 with one run
  /// Share of the runs that do not have the commonest text; of numbers deviation over the diagram's range.
  double disagreement = 0;
};

struct SweepDiagram {
  std::vector<SweepSpot> spots;
  std::vector<std::string> classes; ///< of a column of texts; empty: numbers
  double low = 0, high = 1;         ///< of the numbers
  /// Omega_c where one axis of the diagram is a rate (1/s, rad/s) and the table has `critical_rotation`, or
  /// is a ratio to it; pairs of x and y in order.
  std::vector<std::pair<double, double>> critical;
};
SweepDiagram diagramOf(const SweepData& data, const SweepChoice& choice);

/// Columns whose values are numbers (or texts as well), in the order of the table.
std::vector<std::size_t> columnsFor(const SweepData& data, bool alsoTexts);
/// x and y by default: the first two axes with numbers; colour: "state", else the first result.
SweepChoice firstChoice(const SweepData& data);
std::string cellText(const SweepData& data, const analysis::SweepRow& row, std::size_t column);

} // namespace sandglass::desktop
