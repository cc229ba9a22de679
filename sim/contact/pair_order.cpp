#include "sim/contact/pair_order.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace sandglass {

namespace {

/// By how many steps, each a fourth of a power of two, `length2` is below `most2`.
int stepsBelow(double length2, double most2) {
  constexpr int bitsOfStep = 21; // a float has 23 behind its exponent
  const auto bits = [](double number) { return std::bit_cast<std::int32_t>(static_cast<float>(number)); };
  return (bits(most2) - bits(length2)) >> bitsOfStep;
}

} // namespace

const std::int64_t* PairOrder::place(const Rows& rows, const GrainColumns& columns, const GrainStore& grains,
                                     const Quad* shifts, std::int64_t& inside, std::int64_t& crossing) {
  std::array<std::int64_t, 2 * classes> count{};
  class_.clear();
  const std::int32_t* partner = rows.partner;
  const std::uint8_t* code = rows.code;
  for (std::int64_t i = rows.first; i < rows.last; ++i) {
    const Quad here = grains.place[i];
    const double reach = columns.reach[i];
    for (std::int32_t k = 0; k < rows.length[i - rows.first]; ++k, ++partner) {
      const std::int32_t j = *partner;
      const Quad there = grains.place[j];
      double dx = there.x - here.x, dy = there.y - here.y, dz = there.z - here.z;
      if (code) {
        const Quad& shift = shifts[*code++];
        dx += shift.x;
        dy += shift.y;
        dz += shift.z;
      }
      const double touching = here.w + there.w, most = reach + columns.reach[j];
      // Differences of squares, since a gap or an overlap is small beside the radii.
      const double apart = dx * dx + dy * dy + dz * dz - touching * touching;
      const int below = std::max(0, stepsBelow(std::abs(apart), most * most - touching * touching));
      const int kind =
          (j >= rows.crossingFrom ? classes : 0) +
          (apart > 0.0 ? classes - 1 - std::min(below, gapClasses - 1) : std::min(below, deepClasses - 1));
      ++count[kind];
      class_.push_back(static_cast<std::uint8_t>(kind));
    }
  }
  std::array<std::int64_t, 2 * classes> at;
  for (int kind = 0; kind < 2 * classes; ++kind) {
    std::int64_t& next = kind < classes ? inside : crossing;
    at[kind] = next;
    next += count[kind];
  }
  places_.clear();
  for (const std::uint8_t kind : class_)
    places_.push_back(at[kind]++);
  return places_.data();
}

} // namespace sandglass
