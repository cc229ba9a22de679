#pragma once
// The contact peak of a g(r) and the first minimum behind it, which bounds the first shell of neighbours.

#include <optional>
#include <span>

namespace sandglass::analysis {

struct FirstShell {
  double peak = 0;    ///< r of the contact peak
  double minimum = 0; ///< r of the first minimum behind it
};

/// `r` are bin centres in diameters, evenly spaced; `error` the standard errors of g. The peak is the highest
/// bin below 1.5. The minimum is the lowest of a running mean 0.1 wide within 1.75 peak distances, refined by
/// a parabola through 0.3; the middle of it where it is flat. Nothing when the peak does not stand out by
/// three errors or the minimum is not below 1.
std::optional<FirstShell> firstShell(std::span<const double> r, std::span<const double> g,
                                     std::span<const double> error);

} // namespace sandglass::analysis
