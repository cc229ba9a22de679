// States collapse on rotation over critical rotation when the bed follows the fluid.

#include "analysis/sweep/phase_diagram.h"
#include "tests/validate/vortex/cases.h"

#include <fmt/format.h>

#include <cmath>

namespace sandglass::validate {

namespace {

constexpr double ratios[] = {0.5, 0.75, 1, 1.25, 1.5, 2};
constexpr const char* source = "re-run of Rice's listing, coupled";

} // namespace

std::string judgeCoupled(const analysis::SweepTable& table, Report& report) {
  const Cells cells(table);
  std::string page = fmt::format(
      "{} of {} runs done, {} failed. Codes of the seeds and median empty core / R:\n\n| r [mm] |",
      cells.at({}).size(), cells.rows().size(), cells.failed());
  for (const double ratio : ratios)
    page += fmt::format(" {} Ω_c |", ratio);
  page += "\n|---|---|---|---|---|---|---|\n";
  double least = 10, most = 0, lowBorder = 10, highBorder = 0;
  for (const double radius : {3.0, 4.0, 5.0, 6.0}) {
    page += fmt::format("| {} |", radius);
    for (const double ratio : ratios) {
      const auto cell = cells.at({{"r", radius}, {"ratio", ratio}});
      page += ' ';
      for (const auto* row : cell) {
        page += fmt::format("{}", cells.number(*row, "listed_code"));
        const double follows = cells.number(*row, "rotation") / cells.number(*row, "omega");
        least = std::min(least, follows);
        most = std::max(most, follows);
      }
      page += fmt::format("; {:.2f} |", cells.mean(cell, "core"));
    }
    page += '\n';
    const double border = coreBorder(cells, ratios, {{"r", radius}});
    lowBorder = std::min(lowBorder, border);
    highBorder = std::max(highBorder, border);
    report.between("coupled",
                   fmt::format("rotation / critical at which the core is R / 3, r = {} mm", radius), border,
                   0, 0.75, 1.25, "border within 0.25 of the critical rotation");
    const int below = cells.commonest(cells.at({{"r", radius}, {"ratio", 0.5}}), "listed_code");
    const int expected = radius < 6 ? 1 : 2;
    report.between("coupled", fmt::format("code at half the critical rotation, r = {} mm", radius), below, 0,
                   expected, expected, source);
    const int above = cells.commonest(cells.at({{"r", radius}, {"ratio", 2.0}}), "listed_code");
    report.between("coupled", fmt::format("code at twice the critical rotation, r = {} mm", radius), above, 0,
                   3, 3, source);
  }
  report.between("coupled", "borders, highest less lowest", highBorder - lowBorder, 0, 0, 0.5,
                 "collapse: all within 0.25 of the critical rotation");
  report.between("coupled", "rotation of the bed / of the fluid, least", least, 0, 0.85, 1.1,
                 "re-run: 0.92 to 1.06");
  report.between("coupled", "and most", most, 0, 0.85, 1.1, "re-run: 0.92 to 1.06");
  double spouts = 0, large = 0;
  for (const double ratio : {0.75, 1.0, 1.25}) {
    for (const double radius : {3.0, 4.0, 5.0})
      spouts += cells.commonest(cells.at({{"r", radius}, {"ratio", ratio}}), "listed_code") == 5;
    large += cells.commonest(cells.at({{"r", 6}, {"ratio", ratio}}), "listed_code") == 5;
  }
  report.between("coupled", "cells that spout from 0.75 to 1.25, r <= 5 mm (of 9)", spouts, 0, 3, 9, source);
  report.between("coupled", "and with r = 6 mm (of 3)", large, 0, 0, 0, source);
  for (const char* y : {"ratio", "omega"}) {
    analysis::DiagramOptions options;
    options.x = "r";
    options.y = y;
    options.colour = "state_listed";
    auto diagram = analysis::phaseDiagram(table, options);
    diagram.chart.name = fmt::format("coupled_{}", y);
    report.curves.push_back(diagram.chart);
  }
  analysis::Curve cores;
  cores.name = "coupled_core";
  cores.title = "Empty core of a bed that follows the fluid";
  cores.definition =
      "median distance of the innermost centre from the axis in the last second, mean of three seeds";
  cores.x = {"rotation / critical rotation", ""};
  cores.y = {"core / R", ""};
  for (const double radius : {3.0, 4.0, 5.0, 6.0}) {
    analysis::Series series{fmt::format("r = {} mm", radius), {}, {}, {}};
    for (const double ratio : ratios) {
      series.x.push_back(ratio);
      series.y.push_back(cells.mean(cells.at({{"r", radius}, {"ratio", ratio}}), "core"));
    }
    cores.series.push_back(std::move(series));
  }
  cores.marks = {{"critical", 1, true}};
  report.curves.push_back(cores);
  return page;
}

std::string judgeVolume(const analysis::SweepTable& table, Report& report) {
  const Cells cells(table);
  std::string page =
      fmt::format("{} of {} runs done, {} failed. Commonest of our states, with the empty core / R:\n",
                  cells.at({}).size(), cells.rows().size(), cells.failed());
  for (const double density : {5000.0, 7500.0, 10000.0}) {
    page += fmt::format("\nDensity {} kg/m³\n\n| r [mm] | grains |", density);
    for (const double ratio : {0.5, 0.75, 1.0, 1.25, 1.5})
      page += fmt::format(" {} Ω_c |", ratio);
    page += "\n|---|---|---|---|---|---|---|\n";
    for (const double radius : {3.0, 4.0, 5.0, 6.0}) {
      page += fmt::format("| {} | {} |", radius, std::round(256 * std::pow(4 / radius, 3)));
      for (const double ratio : {0.5, 0.75, 1.0, 1.25, 1.5}) {
        const auto cell = cells.at({{"r", radius}, {"ratio", ratio}, {"density", density}});
        page += cell.empty() ? " - |"
                             : fmt::format(" {} {:.2f} |", cells.commonestText(cell, "state"),
                                           cells.mean(cell, "core"));
      }
      page += '\n';
    }
  }
  std::vector<double> critical;
  for (const auto& row : cells.rows())
    if (row.status == analysis::SweepStatus::done) critical.push_back(cells.number(row, "critical_rotation"));
  const auto [low, high] = std::minmax_element(critical.begin(), critical.end());
  report.between("volume", "critical rotation, highest over lowest (whole numbers of grains)", *high / *low,
                 0, 1, 1.01, "bed volume held constant");
  for (const double density : {5000.0, 7500.0, 10000.0})
    for (const double radius : {3.0, 6.0}) {
      const auto below = cells.at({{"r", radius}, {"ratio", 0.5}, {"density", density}}),
                 above = cells.at({{"r", radius}, {"ratio", 1.5}, {"density", density}});
      report.between("volume",
                     fmt::format("core / R at 1.5 less that at 0.5, r = {} mm, {} kg/m^3", radius, density),
                     cells.mean(above, "core") - cells.mean(below, "core"), 0, 0.15, 1,
                     "the core opens at the critical rotation, whatever the grains");
    }
  return page;
}

} // namespace sandglass::validate
