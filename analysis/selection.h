#pragma once
// Grains chosen by an expression over their quantities: "z > 0.05 && speed < 0.1". SI units. Names are those
// of grainScalar(): x y z speed id, every scalar, velocity.z, |spin|. Operators: + - * / ^ < <= > >= == !=
// && || ! and a ? b : c; functions: abs, sqrt, exp, ln, sin, cos, atan2, min, max, rint and the others of
// muParser.

#include "sim/frame/frame.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace sandglass::analysis {

/// The values of a quantity, one for each grain; throws InputError when the frame does not have it.
using QuantityLookup = std::function<std::vector<double>(const std::string& name)>;

/// 1 for every grain for which the expression is neither 0 nor NaN. Throws InputError, with the place in the
/// text, when it is no expression, and when it names a quantity that the frame lacks. Quantities are looked
/// up by grainScalar() unless `lookup` is given.
std::vector<std::uint8_t> selectGrains(const Frame& frame, const std::string& expression,
                                       const QuantityLookup& lookup = {});

} // namespace sandglass::analysis
