// The source's idealised sets where the theory of its critical rotation holds, and their times of settling.

#include "tests/validate/vortex/cases.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace sandglass::validate {

namespace {

constexpr const char* laws[] = {"linear", "quadratic", "both"};

} // namespace

// A liquid whose surface z = Omega^2 (x^2 - c^2) / 2g begins on the floor at the distance c from the axis has
// the volume pi Omega^2 (R^2 - c^2)^2 / 4g. That it is the bed's, V = pi Omega_c^2 R^4 / 4g, gives
// Omega / Omega_c = 1 / (1 - c^2 / R^2), so 9/8 at c = R / 3.
std::string judgeBare(const analysis::SweepTable& table, Report& report) {
  constexpr double ratios[] = {0.75, 1, 1.25, 1.5};
  const Cells cells(table);
  std::string page = fmt::format(
      "{} of {} runs done, {} failed. No wind, no friction; grains of 3 mm make less than one layer. "
      "Rotation / critical rotation at which the empty "
      "core is R / 3 (1.125 for a liquid), the bed's rotation over the fluid's, and our states at {}, {}, {} "
      "and {}:\n\n| r [mm] | linear | quadratic | both |\n|---|---|---|---|\n",
      cells.at({}).size(), cells.rows().size(), cells.failed(), ratios[0], ratios[1], ratios[2], ratios[3]);
  for (const double r : {3.0, 4.0, 5.0, 6.0}) {
    page += fmt::format("| {} |", r);
    for (int g = 1; g <= 3; ++g) {
      const double generation = g;
      const double border = coreBorder(cells, ratios, {{"r", r}, {"generation", generation}});
      if (r > 3.5) // a bed of less than a layer opens at any rotation
        report.near("bare", fmt::format("border / critical rotation, {} drag, r = {} mm", laws[g - 1], r),
                    border, 0, 1.125, 0.25,
                    "a liquid with a bare floor up to R / 3; Rice 2012, chapter 4: within 25 %");
      double follows = 0, count = 0;
      for (const auto* row : cells.at({{"r", r}, {"generation", generation}}))
        follows += cells.number(*row, "rotation") / cells.number(*row, "omega"), count += 1;
      std::string states;
      for (const double ratio : ratios) {
        const auto here = cells.at({{"r", r}, {"ratio", ratio}, {"generation", generation}});
        states += states.empty() ? "" : ", ";
        states += here.empty() ? "-" : cells.text(*here[0], "state");
      }
      page += fmt::format(" {:.2f}; {:.2f}; {} |", border, follows / count, states);
    }
    page += "\n";
  }
  return page + "\n";
}

std::string judgeSettling(const analysis::SweepTable& table, Report& report) {
  const Cells cells(table);
  std::string page = fmt::format("{} of {} runs done, {} failed. Mean time of settling (our rules) [s]:\n\n"
                                 "| r [mm] | linear | quadratic | both |\n|---|---|---|---|\n",
                                 cells.at({}).size(), cells.rows().size(), cells.failed());
  std::array<double, 3> small{}, large{};
  for (const double r : {2.0, 3.0, 4.0, 5.0, 6.0}) {
    page += fmt::format("| {} |", r);
    for (std::size_t g = 0; g < 3; ++g) {
      const double time =
          cells.mean(cells.at({{"r", r}, {"generation", static_cast<double>(g + 1)}}), "settle_time");
      if (r == 2.0) small[g] = time;
      large[g] = time;
      page += fmt::format(" {:.2f} |", time);
    }
    page += "\n";
  }
  for (std::size_t g = 0; g < 3; ++g)
    report.between("settling", fmt::format("settling of 6 mm over that of 2 mm, {} drag", laws[g]),
                   large[g] / small[g], 0, 0, 1, "Rice 2012, chapter 4: falls with the radius");
  return page + "\n";
}

} // namespace sandglass::validate
