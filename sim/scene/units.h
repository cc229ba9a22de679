#pragma once
// Quantities with units ("3 mm", "45 deg", "140.4 g/(cm s)") through the udunits2 library.

#include <string>
#include <string_view>

namespace sandglass {

/// The number that `text` stands for, in `siUnit` ("m", "kg/m^3", "1" for a plain number). Exact when the
/// text already uses that unit. Throws InputError with a phrase that continues "KEY is VALUE, ...". Any
/// thread.
double parseQuantity(std::string_view text, const std::string& siUnit);

/// "a length", "a density", "a plain number"; "a quantity in N s/m" where the dimension has no common name.
std::string dimensionName(const std::string& siUnit);

/// What a scene may write for it: "such as \"3 mm\"".
std::string quantityExample(const std::string& siUnit);

/// The shortest text that reads back to the same bits: "0.00224 m", "0.2" for a plain number.
std::string quantityText(double value, const std::string& siUnit);

} // namespace sandglass
