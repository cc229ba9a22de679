#include "tests/validate/verdicts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sandglass::validate {

std::string csv(const std::vector<Row>& rows) {
  std::string text = "case,quantity,ours,uncertainty,expected,tolerance,source,verdict\n";
  for (const Row& r : rows)
    text += fmt::format("\"{}\",\"{}\",{:.6g},{:.3g},\"{}\",\"{}\",\"{}\",\"{}\"\n", r.testCase, r.quantity,
                        r.ours, r.uncertainty, r.expected, r.tolerance, r.source, r.verdict());
  return text;
}

bool allOk(const std::vector<Row>& rows) {
  return std::all_of(rows.begin(), rows.end(), [](const Row& r) { return r.ok || !r.skipped.empty(); });
}

void Report::near(const std::string& testCase, const std::string& quantity, double ours, double uncertainty,
                  double expected, double share, const std::string& source) {
  const std::string tolerance =
      share < 1e-3 ? fmt::format("{:.2g} relative", share) : fmt::format("{:g} %", 100 * share);
  rows.push_back({testCase,
                  quantity,
                  ours,
                  uncertainty,
                  fmt::format("{:.6g}", expected),
                  tolerance,
                  source,
                  std::abs(ours / expected - 1) <= share,
                  {}});
}

void Report::between(const std::string& testCase, const std::string& quantity, double ours,
                     double uncertainty, double low, double high, const std::string& source) {
  const std::string expected = std::isinf(high)  ? fmt::format("at least {:.4g}", low)
                               : std::isinf(low) ? fmt::format("at most {:.4g}", high)
                                                 : fmt::format("{:.4g} to {:.4g}", low, high);
  rows.push_back(
      {testCase, quantity, ours, uncertainty, expected, "", source, ours >= low && ours <= high, {}});
}

void Report::recorded(const std::string& testCase, const std::string& quantity, double ours,
                      double uncertainty, const std::string& expected, const std::string& source,
                      const std::string& why) {
  rows.push_back({testCase, quantity, ours, uncertainty, expected, "", source, true, why});
}

} // namespace sandglass::validate
