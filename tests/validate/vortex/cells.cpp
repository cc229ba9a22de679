#include "analysis/statistics.h"
#include "tests/validate/vortex/cases.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace sandglass::validate {

using analysis::SweepRow;
using analysis::SweepStatus;

std::vector<const SweepRow*> Cells::at(const std::vector<std::pair<std::string, double>>& values) const {
  std::vector<const SweepRow*> found;
  for (const auto& row : rows_) {
    const bool here = std::all_of(values.begin(), values.end(), [&](const auto& v) {
      return std::abs(number(row, v.first) - v.second) <= 1e-6 * std::max(1.0, std::abs(v.second));
    });
    if (here && row.status == SweepStatus::done) found.push_back(&row);
  }
  return found;
}

std::size_t Cells::failed() const {
  return static_cast<std::size_t>(std::count_if(
      rows_.begin(), rows_.end(), [](const SweepRow& row) { return row.status == SweepStatus::failed; }));
}

double Cells::mean(const std::vector<const SweepRow*>& rows, const std::string& column) const {
  double sum = 0, count = 0;
  for (const auto* row : rows)
    if (const double x = number(*row, column); !std::isnan(x)) sum += x, count += 1;
  return count > 0 ? sum / count : std::nan("");
}

int Cells::commonest(const std::vector<const SweepRow*>& rows, const std::string& column) const {
  std::map<int, int> counts;
  for (const auto* row : rows)
    if (const double x = number(*row, column); !std::isnan(x)) ++counts[static_cast<int>(x)];
  int best = -1, most = 0;
  for (const auto* row : rows) { // in the order of the seeds
    const double x = number(*row, column);
    if (std::isnan(x) || counts[static_cast<int>(x)] <= most) continue;
    best = static_cast<int>(x);
    most = counts[best];
  }
  return best;
}

std::string Cells::commonestText(const std::vector<const SweepRow*>& rows, const std::string& column) const {
  std::map<std::string, int> counts;
  for (const auto* row : rows)
    ++counts[text(*row, column)];
  std::string best;
  int most = 0;
  for (const auto& [value, count] : counts)
    if (count > most) best = value, most = count;
  return best;
}

double coreBorder(const Cells& cells, std::span<const double> ratios,
                  const std::vector<std::pair<std::string, double>>& values) {
  double before = 0, core = 0;
  for (const double ratio : ratios) {
    auto here = values;
    here.emplace_back("ratio", ratio);
    const double now = cells.mean(cells.at(here), "core");
    if (now >= 1.0 / 3)
      return before == 0 ? ratio : before + (ratio - before) * (1.0 / 3 - core) / (now - core);
    before = ratio;
    core = now;
  }
  return std::nan("");
}

double halfWidth(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  if (n < 2) return 0;
  return analysis::studentFactor(0.95, n - 1) * std::sqrt(analysis::variance(values) / n);
}

} // namespace sandglass::validate
