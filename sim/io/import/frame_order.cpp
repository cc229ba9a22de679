#include "sim/io/import/frame_order.h"

#include <algorithm>
#include <numeric>

namespace sandglass {

std::optional<std::int64_t> sortById(Frame& frame) {
  auto& id = frame.id;
  if (!std::is_sorted(id.begin(), id.end())) {
    std::vector<std::size_t> order(id.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return id[a] < id[b]; });
    const auto permute = [&](auto& values) {
      auto sorted = values;
      for (std::size_t k = 0; k < order.size(); ++k)
        sorted[k] = values[order[k]];
      values = std::move(sorted);
    };
    permute(id);
    permute(frame.position);
    if (!frame.orientation.empty()) permute(frame.orientation);
    for (auto& [name, values] : frame.scalars)
      permute(values);
    for (auto& [name, values] : frame.vectors)
      permute(values);
  }
  const auto twice = std::adjacent_find(id.begin(), id.end());
  return twice == id.end() ? std::optional<std::int64_t>{} : *twice;
}

} // namespace sandglass
