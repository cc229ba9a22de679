#pragma once
// The vortex tank against H. E. Rice, Simulation and Phases of Macroscopic Particles in Vortex Flow (M.S.
// thesis, University of Mississippi, 2012) and against an independent small program that re-ran its listing.
// Each case is a sweep, a TOML file beside this one, and what is said of its table.

#include "analysis/sweep/sweep_table.h"
#include "tests/validate/verdicts.h"

#include <span>
#include <string>
#include <vector>

namespace sandglass::validate {

struct VortexCase {
  std::string name; ///< "speeds", ...
  std::string title;
  /// Adds rows and curves; returns Markdown for the page.
  std::string (*judge)(const analysis::SweepTable& table, Report& report);
};

std::string judgeSpeeds(const analysis::SweepTable& table, Report& report);
std::string judgeGrid(const analysis::SweepTable& table, Report& report);
std::string judgeCoupled(const analysis::SweepTable& table, Report& report);
std::string judgeDrags(const analysis::SweepTable& table, Report& report);
std::string judgeBare(const analysis::SweepTable& table, Report& report);
std::string judgeSettling(const analysis::SweepTable& table, Report& report);
std::string judgeVolume(const analysis::SweepTable& table, Report& report);

// Without a sweep.
std::string judgeContacts(Report& report);   ///< the sample vortex_tank as the source has it
std::string judgeSamples(Report& report);    ///< vortex_tank, vortex_spout, vortex_manual
std::string judgeParaboloid(Report& report); ///< the sample vortex_paraboloid

/// Runs of a sweep by the values of its axes, seeds together.
class Cells {
public:
  explicit Cells(const analysis::SweepTable& table) : table_(table), rows_(table.rows()) {}
  /// Rows of which all these columns have these values (to a millionth), done ones only.
  std::vector<const analysis::SweepRow*> at(const std::vector<std::pair<std::string, double>>& values) const;
  std::size_t failed() const;
  const std::vector<analysis::SweepRow>& rows() const { return rows_; }
  double number(const analysis::SweepRow& row, const std::string& column) const {
    return row.number(table_.column(column));
  }
  std::string text(const analysis::SweepRow& row, const std::string& column) const {
    return row.text(table_.column(column));
  }
  double mean(const std::vector<const analysis::SweepRow*>& rows, const std::string& column) const;
  /// The commonest number of a column among these rows, the first seed's among equals; -1 without rows.
  int commonest(const std::vector<const analysis::SweepRow*>& rows, const std::string& column) const;
  std::string commonestText(const std::vector<const analysis::SweepRow*>& rows,
                            const std::string& column) const;

private:
  const analysis::SweepTable& table_;
  std::vector<analysis::SweepRow> rows_;
};

/// Where the empty core first reaches a third of the tank, between the `ratios` on both sides, among runs
/// with these values; NaN: nowhere.
double coreBorder(const Cells& cells, std::span<const double> ratios,
                  const std::vector<std::pair<std::string, double>>& values);

/// Half width of the 95 % interval of the mean (Student's t); 0 for fewer than two.
double halfWidth(const std::vector<double>& values);

} // namespace sandglass::validate
