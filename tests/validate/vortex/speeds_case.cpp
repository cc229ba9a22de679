// Mean speed of the fluid at the grains less that of the grains, at 5 s: the table of the source.

#include "tests/validate/vortex/cases.h"

#include <fmt/format.h>

namespace sandglass::validate {

std::string judgeSpeeds(const analysis::SweepTable& table, Report& report) {
  struct Expected {
    double radius, rotation, thesis, again;
  };
  constexpr Expected expected[] = {{2, 30, 1.188, 1.097}, {2, 90, 4.101, 4.108}, {2, 150, 5.901, 5.892},
                                   {6, 30, 1.143, 1.102}, {6, 90, 3.316, 3.310}, {6, 150, 5.881, 6.125}};
  const Cells cells(table);
  for (const auto& e : expected) {
    std::vector<double> values;
    double sum = 0;
    for (const auto* row : cells.at({{"r", e.radius}, {"omega", e.rotation}})) {
      values.push_back(e.rotation * cells.number(*row, "mean_distance") - cells.number(*row, "mean_speed"));
      sum += values.back();
    }
    report.near("speeds",
                fmt::format("speed behind the fluid, r = {} mm, {} rad/s [m/s]", e.radius, e.rotation),
                sum / static_cast<double>(values.size()), halfWidth(values), e.thesis, 0.10,
                fmt::format("Rice 2012, table 1; re-run {}", e.again));
  }
  return fmt::format(
      "{} of {} runs done with every defect of the source (`preset = \"rice2012\"`), {} failed.",
      cells.at({}).size(), cells.rows().size(), cells.failed());
}

} // namespace sandglass::validate
