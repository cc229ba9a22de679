#pragma once
// One cell of a table of comma-separated values.

#include <string>

namespace sandglass::analysis {

/// In quotes where it needs them (RFC 4180).
std::string csvCell(const std::string& text);

} // namespace sandglass::analysis
