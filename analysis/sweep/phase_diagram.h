#pragma once
// The plane of two columns of a sweep's table, each point marked by a third: states by name, numbers by
// class. Replicates are merged: the commonest state or the mean stands, and points whose seeds disagree are
// ringed.

#include "analysis/result.h"
#include "analysis/sweep/sweep_table.h"

#include <string>
#include <vector>

namespace sandglass::analysis {

struct DiagramOptions {
  std::string x, y;             ///< columns of numbers
  std::string colour = "state"; ///< column of names or numbers
  /// Column drawn as a line over x: mean of its values at each x. "auto": critical_rotation where the table
  /// has it and y is a rotation; "": none.
  std::string line = "auto";
  std::vector<std::pair<std::string, std::string>> where; ///< only rows with these values in these columns
  int classes = 6;                                        ///< of a column of numbers
};

/// A run worth showing for each name that occurs: of high confidence, in the middle of its field.
struct DiagramExample {
  std::string name;
  int run = 0;
  std::string label; ///< "x = .., y = .."
};

struct PhaseDiagram {
  Curve chart; ///< a scattered series for each name or class, rings, the line
  Table table; ///< x, y, value, agreement, runs, failed
  std::vector<DiagramExample> examples;
};

/// Throws InputError when a column is missing or has no numbers, or nothing is left to draw.
PhaseDiagram phaseDiagram(const SweepTable& table, const DiagramOptions& options);

} // namespace sandglass::analysis
