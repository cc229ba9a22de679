#pragma once
// Arithmetic on named numbers, for what a sweep derives from its axes.

#include <map>
#include <string>
#include <vector>

namespace sandglass::analysis {

/// The value of "4 / R^2 * sqrt(g)" with the numbers by name, and pi. Functions: sqrt, exp, ln, log10, sin,
/// cos, tan, atan2, abs, min, max, rint, ... (muParser). Throws InputError with a phrase that follows the
/// name of the key: `"..." is no expression of ...: REASON`.
double evaluate(const std::string& expression, const std::map<std::string, double>& numbers);

} // namespace sandglass::analysis
