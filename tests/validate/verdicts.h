#pragma once
// Rows of a validation: what we get, what is expected, from where, and whether it agrees.

#include <string>
#include <vector>

namespace sandglass::validate {

struct Row {
  std::string testCase, quantity;
  double ours = 0, uncertainty = 0; ///< half width of the 95 % interval; 0 where none applies
  std::string expected, tolerance, source;
  bool ok = false;
};

/// case,quantity,ours,uncertainty,expected,tolerance,source,verdict
std::string csv(const std::vector<Row>& rows);
bool allOk(const std::vector<Row>& rows);

} // namespace sandglass::validate
