// Rolling resistance of constant size (type A of Ai, Chen, Rotter, Ooi, Powder Technol. 206, 269 (2011)):
//   M = -l F_n w / |w|,
// w the relative spin without its part about the normal, l a length: given, or a share of the effective
// radius. Without a cap the couple would turn a slow spin round within one step and shake for ever. It is
// capped at a sixth of what stops the pair within a step, so that twelve neighbours of equal size together
// do not turn the spin round; a single slow contact then comes to rest within some ten steps.

#include "sim/contact/fused/fused_laws.h"
#include "sim/contact/law_loop.h"
#include "sim/contact/laws/law_options.h"
#include "sim/contact/laws/laws.h"
#include "sim/contact/laws/rolling_pair.h"

namespace sandglass {

namespace {

class ConstantTorqueRolling final : public LawLoop<ConstantTorqueRolling> {
public:
  explicit ConstantTorqueRolling(const LawContext& context) {
    for (const PairType& t : context.types) {
      Constants<double> c;
      if (t.used) {
        requireOne(t.parameters, "rolling resistance", "length", "coefficient");
        c.length = t.parameters.number("length", 0.0);
        c.coefficient = t.parameters.number("coefficient", 0.0);
      }
      table_.push_back(c);
    }
  }

  bool readsSpin() const override { return true; }
  bool turnsGrains() const override { return true; }
  unsigned reads() const override { return radii | masses | effectiveRadius; }

  template <class Real, class Table>
  SANDGLASS_LOOP void loop(ContactBlockOf<Real>& b, int, const Table& table) const {
    const Real most = coupleCap(b.dt);
    SANDGLASS_CONTACTS(i) {
      const auto c = table(i);
      const Vector3<Real> couple =
          constantCouple<ScalarArithmetic>(c, rollingPair(b, i), b.overlap[i], b.contactForce[i], most);
      b.mx[i] += couple.x;
      b.my[i] += couple.y;
      b.mz[i] += couple.z;
    }
  }

  void fuse(FusedLaws& laws) const override {
    laws.rolling = FusedLaws::Rolling::constantTorque;
    laws.couple = table_[laws.type];
  }

  template <class Real> using Constants = RollingConstants<Real>;
  std::vector<Constants<double>> table_;
};

} // namespace

LawKind constantTorqueRollingLaw() {
  return {"constant_torque",
          LawRole::rolling,
          "couple of constant size against rolling",
          false,
          {coupleLength(), coupleCoefficient()},
          [](const LawContext& c) { return std::make_unique<ConstantTorqueRolling>(c); }};
}

} // namespace sandglass
