#pragma once
// Rows of a validation: what we get, what is expected, from where, and whether it agrees. A report is rows
// with their plots, written as CSV and as a page of Markdown that names machine, version and date.

#include "analysis/result.h"

#include <filesystem>
#include <string>
#include <vector>

namespace sandglass::validate {

struct Row {
  std::string testCase, quantity;
  double ours = 0, uncertainty = 0; ///< half width of the 95 % interval; 0 where none applies
  std::string expected, tolerance, source;
  bool ok = false;
  std::string skipped = {}; ///< why there is no verdict; empty where there is one
  std::string verdict() const { return skipped.empty() ? (ok ? "ok" : "off") : "skipped: " + skipped; }
};

/// case,quantity,ours,uncertainty,expected,tolerance,source,verdict
std::string csv(const std::vector<Row>& rows);
/// No verdict is `off`.
bool allOk(const std::vector<Row>& rows);

struct Report {
  std::vector<Row> rows;
  std::vector<analysis::Curve> curves; ///< each becomes FOLDER/NAME/<curve name>.png and .csv

  /// Within `share` of `expected`.
  void near(const std::string& testCase, const std::string& quantity, double ours, double uncertainty,
            double expected, double share, const std::string& source);
  /// Between two bounds; an infinite one is left out of the text.
  void between(const std::string& testCase, const std::string& quantity, double ours, double uncertainty,
               double low, double high, const std::string& source);
  void recorded(const std::string& testCase, const std::string& quantity, double ours, double uncertainty,
                const std::string& expected, const std::string& source, const std::string& why);
};

/// Writes FOLDER/name.csv, FOLDER/name.md and the plots; `preamble` is Markdown below the title, `conditions`
/// says seeds and the like.
void writeReport(const Report& report, const std::filesystem::path& folder, const std::string& name,
                 const std::string& title, const std::string& preamble, const std::string& conditions);

} // namespace sandglass::validate
