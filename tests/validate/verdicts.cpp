#include "tests/validate/verdicts.h"

#include <fmt/format.h>

#include <algorithm>

namespace sandglass::validate {

std::string csv(const std::vector<Row>& rows) {
  std::string text = "case,quantity,ours,uncertainty,expected,tolerance,source,verdict\n";
  for (const Row& r : rows)
    text += fmt::format("{},\"{}\",{:.5g},{:.3g},{},{},\"{}\",{}\n", r.testCase, r.quantity, r.ours,
                        r.uncertainty, r.expected, r.tolerance, r.source, r.ok ? "ok" : "off");
  return text;
}

bool allOk(const std::vector<Row>& rows) {
  return std::all_of(rows.begin(), rows.end(), [](const Row& r) { return r.ok; });
}

} // namespace sandglass::validate
