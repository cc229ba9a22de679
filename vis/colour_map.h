#pragma once
// Colour maps. Sequential ones rise evenly in lightness, so that equal steps of a quantity look equal and the
// map survives grey printing and colour-blind eyes.
//   viridis, inferno, magma, plasma  Smith and van der Walt 2015 (CC0), ten stops each
//   cividis           Nunez, Anderton, Renslow 2018, doi:10.1371/journal.pone.0199239, ten stops
//   dune              our own: L* from 29 to 91 in even steps, from deep blue over teal to sand
//   grey              L* from 15 to 95
//   coolwarm          diverging, Moreland 2009, doi:10.1007/978-3-642-10520-3_9
//   discrete          eight colours, Okabe and Ito 2008, for species and other counted things

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace sandglass::vis {

using Rgb = std::array<std::uint8_t, 3>;

/// Shares of red, green and blue, 0 to 1 and cut to that, as bytes.
Rgb rgb(const std::array<double, 3>& colour);

class ColourMap {
public:
  /// `reversed`: from the end to the start; `bands` more than 0: so many steps. Throws InputError naming the
  /// maps there are.
  explicit ColourMap(const std::string& name, bool reversed = false, int bands = 0);

  /// Colour of a share of the range, clamped to 0..1; NaN is grey. A discrete map takes its first colours
  /// for the first eighths of the range.
  Rgb at(double share) const;

  /// Colour of a counted thing: the discrete map repeats after eight, others are sampled at eight places.
  Rgb ofIndex(long index) const;

  bool discrete() const { return discrete_; }

private:
  std::vector<Rgb> table_;
  bool discrete_ = false, banded_ = false;
};

} // namespace sandglass::vis
