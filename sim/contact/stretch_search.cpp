#include "sim/contact/stretch_search.h"

#include <algorithm>

namespace sandglass {

std::int64_t searchCellPlain(const CellSearch& cell, std::int32_t* partner, std::uint8_t* code,
                             std::int32_t* count) {
  std::int64_t found = 0;
  for (std::int32_t i = cell.first; i < cell.last; ++i) {
    const std::int64_t before = found;
    for (int s = 0; s < cell.stretchCount; ++s) {
      const Stretch& stretch = cell.stretches[s];
      const Quad& shift = cell.shift[stretch.code];
      const double px = cell.x[i] - shift.x, py = cell.y[i] - shift.y, pz = cell.z[i] - shift.z;
      const std::int32_t begin = std::max(stretch.begin, stretch.code > cell.center ? i : i + 1);
      for (std::int32_t j = begin; j < stretch.end; ++j) {
        const double dx = px - cell.x[j], dy = py - cell.y[j], dz = pz - cell.z[j];
        const double reach = cell.reach[i] + cell.reach[j];
        if (!(dx * dx + dy * dy + dz * dz < reach * reach)) continue;
        partner[found] = j;
        if (code) code[found] = static_cast<std::uint8_t>(stretch.code);
        ++found;
      }
    }
    count[i - cell.first] = static_cast<std::int32_t>(found - before);
  }
  return found;
}

CellSearcher cellSearcher(KernelWidth width) {
  switch (width) {
  case KernelWidth::avx512:
    return searchCellAvx512;
  case KernelWidth::avx2:
    return searchCellAvx2;
  case KernelWidth::plain:
    break;
  }
  return searchCellPlain;
}

} // namespace sandglass
