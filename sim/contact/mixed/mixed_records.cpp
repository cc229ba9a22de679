#include "sim/contact/mixed/mixed_records.h"

#include "sim/contact/mixed/mixed_loops.h"

#include <algorithm>
#include <cmath>

namespace sandglass {

void MixedRecords::bind(const GrainStore& grains, const PairList& list, ParticleView& view) {
  const std::size_t n = grains.size(), numbers = 4 * static_cast<std::size_t>(view.quads);
  double largest = 0.0;
  for (std::size_t i = 0; i < n; ++i)
    largest = std::max(largest, 2.0 * grains.place[i].w);
  int exponent = 0;
  std::frexp(largest, &exponent); // largest < 2^exponent
  view.unit = std::ldexp(1.0, exponent - 30);
  view.perUnit = std::ldexp(1.0, 30 - exponent);
  records_.assign((n + 2) * numbers, 0);
  // The phantoms: half way round from each other, and of no radius or mass that could make a quotient
  // infinite: what they do to each other is added up, and must be zeros.
  for (std::size_t i = n; i < n + 2; ++i) {
    records_[i * numbers] = i == n ? 0 : 1 << 30;
    records_[i * numbers + 3] = 1 << 20;
    records_[i * numbers + 7] = std::bit_cast<std::int32_t>(1.0F);
  }
  shifts_.clear();
  for (const Quad& shift : list.shifts())
    for (const double s : {shift.x, shift.y, shift.z, 0.0})
      shifts_.push_back(fixedPoint(s * view.perUnit));
  view.mixed = records_.data();
  view.mixedShifts = list.periodic() ? shifts_.data() : nullptr;
}

void MixedRecords::refresh(const Kernel& kernel, const ParticleView& view, std::int64_t grains) {
  for (std::int64_t first = 0; first < grains; first += GroupSums::capacity)
    kernel.narrow(view, first, static_cast<int>(std::min<std::int64_t>(GroupSums::capacity, grains - first)));
}

} // namespace sandglass
