#pragma once
// Round numbers for legends, axes and scale bars.

#include <string>
#include <vector>

namespace sandglass::vis {

struct Ticks {
  std::vector<double> values;      ///< inside the range, ascending, steps of 1, 2 or 5 times a power of ten
  std::vector<std::string> labels; ///< one each, all with the same number of decimals
  int exponent = 0;                ///< the labels are to be multiplied by ten to this power (a multiple of 3)
};

/// About `wanted` ticks between low and high; a single one when the range is empty.
Ticks niceTicks(double low, double high, int wanted);

/// "name [unit]", with the power of ten of the ticks as a prefix or a factor: "energy [µJ]", "speed [10⁻³
/// m/s]".
std::string axisTitle(const std::string& name, const std::string& unit, int exponent);

/// The largest 1, 2 or 5 times a power of ten that does not exceed `limit` (> 0).
double roundBelow(double limit);

std::string lengthText(double metres); ///< "2 cm", "500 µm"
std::string timeText(double seconds);  ///< "t = 0.125 s"

} // namespace sandglass::vis
