// Linear, quadratic and both drags, so coupled that a bed follows the fluid: what the source says of its
// idealised sets, qualitatively.

#include "analysis/sweep/phase_diagram.h"
#include "tests/validate/vortex/cases.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace sandglass::validate {

namespace {

constexpr double ratios[] = {0.25, 0.5, 0.75, 1, 1.25, 1.5, 2};
constexpr double radii[] = {2, 3, 4, 5, 6};
constexpr const char* names[] = {"linear", "quadratic", "both"};
constexpr const char* source = "Rice 2012, chapter 4, qualitatively";

} // namespace

std::string judgeDrags(const analysis::SweepTable& table, Report& report) {
  const Cells cells(table);
  std::string page =
      fmt::format("{} of {} runs done, {} failed. Rotation / critical rotation at which the empty core is R "
                  "/ 3, and mean "
                  "time of settling (our rules):\n\n| r [mm] | Ω_c √(R/g) | linear | quadratic | both | "
                  "settled, linear [s] | quadratic | both |\n|---|---|---|---|---|---|---|---|\n",
                  cells.at({}).size(), cells.rows().size(), cells.failed());
  std::array<std::array<double, 3>, 5> settled{};
  for (std::size_t k = 0; k < 5; ++k) {
    const double r = radii[k], scaled = 4 * std::sqrt(std::sqrt(2.0) * 256 / M_PI) * std::pow(r / 60, 1.5);
    page += fmt::format("| {} | {:.2f} |", r, scaled);
    std::string times;
    for (int g = 1; g <= 3; ++g) {
      const double at = coreBorder(cells, ratios, {{"r", r}, {"generation", static_cast<double>(g)}});
      page += fmt::format(" {:.2f} |", at);
      std::vector<const analysis::SweepRow*> some =
          cells.at({{"r", r}, {"generation", static_cast<double>(g)}});
      settled[k][static_cast<std::size_t>(g - 1)] = cells.mean(some, "settle_time");
      times += fmt::format(" {:.2f} |", settled[k][static_cast<std::size_t>(g - 1)]);
      if (scaled > 0.6)
        report.recorded(
            "drags", fmt::format("border / critical rotation, {} drag, r = {} mm", names[g - 1], r), at, 0,
            "0.75 to 1.25", source,
            "friction holds the bed back and the wind carries a part of it: the case bare is without both");
    }
    page += times + "\n";
  }
  for (std::size_t g = 0; g < 3; ++g)
    report.recorded("drags", fmt::format("settling of 6 mm over that of 2 mm, {} drag", names[g]),
                    settled[4][g] / settled[0][g], 0, "below 1", source,
                    "beads fall freely where the drag acts across alone: see the case settling");
  double different = 0, low = 0;
  for (const double r : radii)
    for (const double ratio : ratios) {
      const auto one = cells.at({{"r", r}, {"ratio", ratio}, {"generation", 1.0}}),
                 two = cells.at({{"r", r}, {"ratio", ratio}, {"generation", 2.0}});
      if (one.empty() || two.empty() || cells.text(*one[0], "state") == cells.text(*two[0], "state"))
        continue;
      different += 1;
      low += ratio <= 1;
    }
  report.recorded("drags", "cells of 35 in which linear and quadratic drag give different states", different,
                  0, "", source, "no number is given");
  report.recorded("drags", "of these up to the critical rotation (20 of the 35 cells)", low, 0, "most",
                  source, "\"differ mainly at low rotation\" is no number");
  for (int g = 1; g <= 3; ++g)
    for (const char* what : {"state", "settle_time"}) {
      analysis::DiagramOptions options;
      options.x = "r";
      options.y = "ratio";
      options.colour = what;
      options.where = {{"generation", std::to_string(g)}};
      auto diagram = analysis::phaseDiagram(table, options);
      diagram.chart.name = fmt::format("drags_{}_{}", names[g - 1], what);
      diagram.chart.title = fmt::format("{} drag: {}", names[g - 1],
                                        std::string(what) == "state" ? "states" : "time of settling [s]");
      diagram.chart.title[0] = static_cast<char>(std::toupper(diagram.chart.title[0]));
      report.curves.push_back(diagram.chart);
    }
  return page;
}

} // namespace sandglass::validate
