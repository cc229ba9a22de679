// An upward force on grains that are pressed together:  F_z = L exp(-beta (z - z_0)) sum_j xi_ij, with the
// overlaps xi of all contacts with other grains. No physics is behind it that we know of: it stands in the
// program of Rice (H. E. Rice, M.S. thesis, University of Mississippi, 2012) without a word in the text.

#include "sim/fields/field.h"
#include "sim/fields/field_kinds.h"

namespace sandglass {

namespace {

class OverlapLift final : public Field {
public:
  explicit OverlapLift(const Parameters& p)
      : coefficient_(p.number("coefficient")), decay_(p.number("decay")), reference_(p.number("reference")) {}

  bool readsOverlaps() const override { return coefficient_ > 0.0; }

  void apply(FieldBlock& b, double factor) const override {
    if (coefficient_ == 0.0) return;
    const double coefficient = factor * coefficient_;
    const FieldBlock::Column& share = b.falloff(decay_, reference_, Vec3::UnitZ());
    SANDGLASS_GRAINS(i)
    b.az[i] += coefficient * b.overlap[i] * share[i] * b.inverseMass[i];
  }

private:
  double coefficient_, decay_, reference_;
};

} // namespace

FieldKind overlapLiftField() {
  return {"overlap_lift",
          FieldRole::lift,
          "an upward force on grains that overlap others, as a program of 2012 had it",
          "an exponential a grain and step",
          {fieldNumber("coefficient", "N/m", "force over the sum of overlaps", 0, false, 0.0),
           heightDecay("rate at which it falls off with height"), heightReference()},
          [](const Parameters& p) { return std::make_unique<OverlapLift>(p); }};
}

} // namespace sandglass
