#pragma once
// How the columns of a sweep are told apart when they are drawn: the same in files and in the window.

#include <set>
#include <string>
#include <vector>

namespace sandglass::analysis {

/// Stands in place of a name for runs that failed.
inline constexpr const char* failedName = "failed";

/// The names that occur, in the order of their colours. Where they are states of a vortex: all states, in
/// their own order, so that each looks the same in every diagram, and `failedName` behind them where it
/// occurs; others by the alphabet.
std::vector<std::string> orderOfClasses(const std::set<std::string>& names);

/// Whether a column in that unit is a rate of turning.
bool isRotation(const std::string& unit);

} // namespace sandglass::analysis
