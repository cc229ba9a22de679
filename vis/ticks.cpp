#include "vis/ticks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace sandglass::vis {

namespace {

std::string superscript(int number) {
  static const char* const digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text;
  for (const char c : fmt::format("{}", number))
    text += c == '-' ? "⁻" : digits[c - '0'];
  return text;
}

} // namespace

double roundBelow(double limit) {
  const double power = std::pow(10.0, std::floor(std::log10(limit)));
  const double share = limit / power * (1 + 1e-9);
  return power * (share >= 5 ? 5 : share >= 2 ? 2 : 1);
}

Ticks niceTicks(double low, double high, int wanted) {
  Ticks ticks;
  const double largest = std::max(std::abs(low), std::abs(high));
  if (largest > 0 && std::isfinite(largest) && (largest >= 1e5 || largest < 1e-2))
    ticks.exponent = 3 * static_cast<int>(std::floor(std::log10(largest) / 3 + 1e-9));
  const double unit = std::pow(10.0, ticks.exponent);
  if (!(high > low) || high - low < 1e-12 * largest) {
    ticks.values = {low};
    ticks.labels = {fmt::format("{:.4g}", low / unit)};
    return ticks;
  }
  const double step = roundBelow((high - low) / std::max(wanted - 1, 1) * 1.6);
  const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step / unit) + 1e-9)));
  const double slack = 1e-9 * (high - low);
  for (double k = std::ceil((low - slack) / step); k * step <= high + slack; ++k) {
    ticks.values.push_back(k * step);
    ticks.labels.push_back(fmt::format("{:.{}f}", k == 0 ? 0.0 : k * step / unit, decimals));
  }
  return ticks;
}

std::string axisTitle(const std::string& name, const std::string& unit, int exponent) {
  static const std::set<std::string> takePrefix{"m", "s", "N", "J", "W", "Pa", "Hz"};
  static const std::map<int, std::string> prefixes{{-9, "n"}, {-6, "µ"}, {-3, "m"},
                                                   {3, "k"},  {6, "M"},  {9, "G"}};
  std::string inside = unit;
  if (const auto prefix = prefixes.find(exponent); prefix != prefixes.end() && takePrefix.contains(unit))
    inside = prefix->second + unit;
  else if (exponent != 0)
    inside = "10" + superscript(exponent) + (unit.empty() ? "" : " ") + unit;
  return inside.empty() ? name : name + " [" + inside + "]";
}

std::string lengthText(double metres) {
  static constexpr std::pair<double, const char*> units[] = {{1e3, "km"},  {1, "m"},     {1e-2, "cm"},
                                                             {1e-3, "mm"}, {1e-6, "µm"}, {1e-9, "nm"}};
  for (const auto& [size, name] : units)
    if (metres >= size * (1 - 1e-9))
      return fmt::format("{:g} {}", std::round(metres / size * 1e6) / 1e6, name);
  return fmt::format("{:.3g} m", metres);
}

std::string timeText(double seconds) {
  if (seconds > 0 && seconds < 0.0995) return fmt::format("t = {:.2f} ms", 1e3 * seconds);
  return fmt::format("t = {:.3f} s", seconds);
}

} // namespace sandglass::vis
