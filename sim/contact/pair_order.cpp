#include "sim/contact/pair_order.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sandglass {

const std::int64_t* PairOrder::place(const Rows& rows, const GrainColumns& columns, const GrainStore& grains,
                                     const Quad* shifts, std::int64_t& inside, std::int64_t& crossing) {
  std::array<std::int64_t, 2 * classes> count{};
  class_.clear();
  const std::int32_t* partner = rows.partner;
  const std::uint8_t* code = rows.code;
  for (std::int64_t i = rows.first; i < rows.last; ++i) {
    const double x = columns.x[i], y = columns.y[i], z = columns.z[i];
    const double radius = grains.place[i].w, reach = columns.reach[i];
    for (std::int32_t k = 0; k < rows.length[i - rows.first]; ++k, ++partner) {
      const std::int32_t j = *partner;
      double dx = columns.x[j] - x, dy = columns.y[j] - y, dz = columns.z[j] - z;
      if (code) {
        const Quad& shift = shifts[*code++];
        dx += shift.x;
        dy += shift.y;
        dz += shift.z;
      }
      const double touching = radius + grains.place[j].w;
      const double gap = std::sqrt(dx * dx + dy * dy + dz * dz) - touching;
      // Fine steps near contact, where most pairs of a flowing bed are.
      const double share = std::sqrt(std::min(1.0, std::abs(gap) / (reach + columns.reach[j] - touching)));
      const int kind = (j >= rows.crossingFrom ? classes : 0) +
                       (gap > 0.0 ? deepClasses + static_cast<int>(share * (gapClasses - 1))
                                  : static_cast<int>((1.0 - share) * (deepClasses - 1)));
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
