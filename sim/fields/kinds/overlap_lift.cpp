// An upward force on grains that are pressed together:  F_z = L exp(-beta (z - z_0)) sum_j xi_ij, with the
// overlaps xi of all contacts with other grains. No physics is behind it that we know of: it stands in the
// program of Rice (H. E. Rice, M.S. thesis, University of Mississippi, 2012) without a word in the text.

#include "sim/fields/field.h"
#include "sim/fields/field_kinds.h"
#include "sim/math/exponential.h"

#include <cmath>

namespace sandglass {

namespace {

class OverlapLift final : public Field {
public:
  explicit OverlapLift(const Parameters& p)
      : coefficient_(p.number("coefficient")), decay_(p.number("decay")), reference_(p.number("reference")) {}

  bool looks() const override { return coefficient_ > 0.0; }

  void look(const GrainStore& grains, const PairList& list, Parallel& parallel) override {
    overlaps_.assign(grains.size(), 0.0);
    parallel.forRange(static_cast<std::int64_t>((grains.size() + PairList::group - 1) / PairList::group), 32,
                      [&](std::int64_t first, std::int64_t last) {
                        for (std::int64_t g = first; g < last; ++g)
                          lookAt(grains, list, g);
                      });
  }

  void apply(FieldBlock& b, double factor) const override {
    if (coefficient_ == 0.0) return;
    const double coefficient = factor * coefficient_, decay = decay_, reference = reference_;
    FieldBlock::Column sums{};
    for (int i = 0; i < b.size; ++i)
      sums[i] = overlaps_[b.first + i];
    SANDGLASS_GRAINS(i)
    b.az[i] += coefficient * sums[i] * exponential(-decay * (b.z[i] - reference)) * b.inverseMass[i];
  }

private:
  void lookAt(const GrainStore& grains, const PairList& list, std::int64_t g) {
    const auto add = [&](std::int64_t grain, std::int64_t pair) {
      const auto [a, b] = list.pairs()[pair];
      const Quad &p = grains.place[a], &q = grains.place[b];
      Vec3 apart = p.vec() - q.vec();
      if (list.periodic()) apart -= list.shifts()[list.shiftOf()[pair]].vec();
      const double sum = p.w + q.w, square = apart.squaredNorm();
      if (square < sum * sum) overlaps_[grain] += sum - std::sqrt(square);
    };
    const std::int64_t first = g * PairList::group,
                       last = std::min<std::int64_t>(first + PairList::group, grains.size());
    for (std::int64_t i = first; i < last; ++i)
      for (int s = 0; s < PairList::slotCount; ++s)
        if (const std::int64_t pair = list.slots(i)[s] >> 1; pair < list.entries()) add(i, pair);
    const PairList::Range extras = list.groupExtras(g);
    for (std::int64_t e = extras.begin; e < extras.end; ++e)
      add(list.extras()[e].grain, list.extras()[e].entry >> 1);
  }

  double coefficient_, decay_, reference_;
  std::vector<double> overlaps_; ///< [m] sums, in storage order
};

} // namespace

FieldKind overlapLiftField() {
  return {"overlap_lift",
          FieldRole::lift,
          "an upward force on grains that overlap others, as a program of 2012 had it",
          "8 bytes a grain, one more look at each contact a step",
          {fieldNumber("coefficient", "N/m", "force over the sum of overlaps", 0, false, 0.0),
           heightDecay("rate at which it falls off with height"), heightReference()},
          [](const Parameters& p) { return std::make_unique<OverlapLift>(p); }};
}

} // namespace sandglass
