// The 81 runs of the source's realistic set, with its defects: codes, robust facts, rotation of the bed.

#include "analysis/sweep/phase_diagram.h"
#include "tests/validate/vortex/cases.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace sandglass::validate {

namespace {

constexpr int rows = 9, columns = 9;

double radiusOf(int row) {
  return 2 + 0.5 * row;
}
double rotationOf(int column) {
  return 25.0 * column;
}

/// Codes of the re-run, one seed.
constexpr std::array<std::array<int, columns>, rows> codes{{{3, 3, 5, 5, 3, 3, 3, 3, 3},
                                                            {1, 1, 3, 5, 5, 3, 3, 3, 3},
                                                            {1, 1, 1, 5, 5, 3, 3, 3, 3},
                                                            {1, 1, 1, 1, 5, 3, 3, 3, 3},
                                                            {1, 1, 1, 1, 5, 3, 5, 3, 3},
                                                            {5, 5, 5, 5, 5, 5, 5, 3, 3},
                                                            {5, 1, 1, 1, 1, 5, 3, 5, 3},
                                                            {2, 1, 2, 1, 2, 2, 3, 3, 3},
                                                            {1, 1, 1, 1, 1, 2, 2, 3, 3}}};

constexpr const char* source = "re-run of Rice's listing";

/// First rotation at which most seeds spout.
double spoutOnset(const Cells& cells, double radius) {
  for (int c = 0; c < columns; ++c)
    if (cells.commonest(cells.at({{"r", radius}, {"omega", rotationOf(c)}}), "listed_code") == 5)
      return rotationOf(c);
  return std::nan("");
}

void robustFacts(const Cells& cells, Report& report) {
  double pinned = 0, all = 0, wall = 0, wallAll = 0, elsewhere = 0, elsewhereAll = 0;
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      const bool text = (radiusOf(r) == 2 && rotationOf(c) >= 100) ||
                        (radiusOf(r) == 2.5 && rotationOf(c) >= 150) ||
                        (radiusOf(r) == 3 && rotationOf(c) >= 200);
      for (const auto* row : cells.at({{"r", radiusOf(r)}, {"omega", rotationOf(c)}})) {
        if (radiusOf(r) <= 4.5 && rotationOf(c) >= 175) {
          pinned += cells.number(*row, "listed_code") == 3;
          all += 1;
        }
        const bool atWall = cells.text(*row, "state_text") == "pinned";
        (text ? wall : elsewhere) += atWall;
        (text ? wallAll : elsewhereAll) += 1;
      }
    }
  report.between("grid", "share pinned, r <= 4.5 mm from 175 rad/s", pinned / all, 0, 0.9, 1, source);
  const double two = spoutOnset(cells, 2), three = spoutOnset(cells, 3), four = spoutOnset(cells, 4);
  report.between("grid", "first spout, r = 2 mm [rad/s]", two, 0, 25, 75, source);
  report.between("grid", "first spout, r = 4 mm [rad/s]", four, 0, 75, 125, source);
  report.between("grid", "its rise from 2 over 3 to 4 mm, smaller step [rad/s]",
                 std::min(three - two, four - three), 0, 0, 50, source);
  report.between("grid", "code of r = 2 mm without rotation: pinned by the counter that is never cleared",
                 cells.commonest(cells.at({{"r", 2}, {"omega", 0}}), "listed_code"), 0, 3, 3, source);
  report.between("grid", "share at the wall, as the text has pinned, where the re-run is", wall / wallAll, 0,
                 0.6, 1, source);
  report.between("grid", "and elsewhere", elsewhere / elsewhereAll, 0, 0, 0.05, source);
}

void settling(const Cells& cells, Report& report) {
  double low = 1e9, high = 0, spread = 0, low6 = 1e9, high6 = 0;
  for (int r = 0; r < rows; ++r) {
    for (const double seed : {1.0, 2.0, 3.0}) {
      double least = 1e9, most = 0;
      for (const auto& row : cells.rows()) {
        if (row.status != analysis::SweepStatus::done || static_cast<double>(row.replicate) != seed ||
            std::abs(cells.number(row, "r") - radiusOf(r)) > 1e-6)
          continue;
        // The source says from which frame on it looks at the bed: the middle of the settled window.
        const double frame = 1000 * cells.number(row, "listed_settle_time") + 250;
        if (std::isnan(frame)) continue;
        least = std::min(least, frame);
        most = std::max(most, frame);
      }
      if (most == 0) continue;
      if (radiusOf(r) <= 5) {
        spread = std::max(spread, most - least);
        low = std::min(low, least);
        high = std::max(high, most);
      } else if (radiusOf(r) == 6) {
        low6 = std::min(low6, least);
        high6 = std::max(high6, most);
      }
    }
  }
  // The height alone decides there, and who flies highest is a matter of the seed.
  report.between("grid", "first frame looked at, r <= 5 mm, least", low, 0, 400, 480,
                 "re-run: 422 to 451, one seed");
  report.between("grid", "and most", high, 0, 400, 480, "re-run: 422 to 451, one seed");
  report.between("grid", "spread over the rotations at one radius and seed [frames]", spread, 0, 0, 10,
                 "re-run: identical");
  report.between("grid", "first frame looked at, r = 6 mm, least", low6, 0, 480, 590,
                 "re-run: 529 to 538, one seed");
}

void rotations(const Cells& cells, Report& report) {
  for (const auto& [rotation, expected] : {std::pair{25.0, 2.2}, {50.0, 6.4}, {100.0, 23.7}, {200.0, 79.0}}) {
    std::vector<double> values;
    double sum = 0;
    for (const auto* row : cells.at({{"r", 2}, {"omega", rotation}})) {
      values.push_back(cells.number(*row, "rotation_end"));
      sum += values.back();
    }
    report.near("grid", fmt::format("rotation of the bed at 5 s, r = 2 mm, {} rad/s [rad/s]", rotation),
                sum / static_cast<double>(values.size()), halfWidth(values), expected, 0.15, source);
  }
}

} // namespace

std::string judgeGrid(const analysis::SweepTable& table, Report& report) {
  const Cells cells(table);
  int agree = 0, single = 0, runs = 0;
  std::string page = fmt::format(
      "{} of {} runs done, {} failed. Codes of the seeds in each cell, the re-run's in brackets where "
      "the commonest is another:\n\n| r [mm] |",
      cells.at({}).size(), cells.rows().size(), cells.failed());
  for (int c = 0; c < columns; ++c)
    page += fmt::format(" {} |", rotationOf(c));
  page += "\n|---|" + std::string("---|---|---|---|---|---|---|---|---|\n");
  std::string named;
  for (int r = 0; r < rows; ++r) {
    page += fmt::format("| {} |", radiusOf(r));
    for (int c = 0; c < columns; ++c) {
      const auto cell = cells.at({{"r", radiusOf(r)}, {"omega", rotationOf(c)}});
      const bool same = cells.commonest(cell, "listed_code") == codes[r][c];
      agree += same;
      page += ' ';
      for (const auto* row : cell) {
        const int code = static_cast<int>(cells.number(*row, "listed_code"));
        page += fmt::format("{}", code);
        single += code == codes[r][c];
        ++runs;
      }
      page += same ? " |" : fmt::format(" ({}) |", codes[r][c]);
      if (!same)
        named += fmt::format("{}({} mm, {} rad/s)", named.empty() ? "" : ", ", radiusOf(r), rotationOf(c));
    }
    page += '\n';
  }
  page += fmt::format("\nCells that disagree: {}.\n", named.empty() ? "none" : named);
  report.between("grid", "cells of 81 whose commonest code is the re-run's", agree, 0, 0.75 * 81, 81,
                 "re-run of Rice's listing, one seed");
  report.recorded("grid", "share of single runs with the re-run's code", static_cast<double>(single) / runs,
                  0, "", source, "beside the row above");
  robustFacts(cells, report);
  settling(cells, report);
  rotations(cells, report);
  analysis::DiagramOptions options;
  options.x = "r";
  options.y = "omega";
  options.colour = "state_listed";
  auto diagram = analysis::phaseDiagram(table, options);
  diagram.chart.name = "grid_listed";
  report.curves.push_back(diagram.chart);
  options.colour = "state";
  diagram = analysis::phaseDiagram(table, options);
  diagram.chart.name = "grid_own";
  diagram.chart.title = "States of the realistic grid, by our rules";
  report.curves.push_back(diagram.chart);

  page += "\nBoth classifications beside each other: mean shares of the general state map (solid, liquid, "
          "gas; at the "
          "end of each run) by state of the vortex, ours:\n\n| state | runs | solid | liquid | gas "
          "|\n|---|---|---|---|---|\n";
  for (const char* state : {"unresolved", "flat", "fluid", "pinned", "small spout", "large spout"}) {
    std::vector<const analysis::SweepRow*> some;
    for (const auto& row : cells.rows())
      if (row.status == analysis::SweepStatus::done && cells.text(row, "state") == state)
        some.push_back(&row);
    if (some.empty()) continue;
    page += fmt::format("| {} | {} | {:.2f} | {:.2f} | {:.2f} |\n", state, some.size(),
                        cells.mean(some, "solid"), cells.mean(some, "liquid"), cells.mean(some, "gas"));
  }
  return page;
}

} // namespace sandglass::validate
