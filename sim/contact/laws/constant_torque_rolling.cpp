// Rolling resistance of constant size (type A of Ai, Chen, Rotter, Ooi, Powder Technol. 206, 269 (2011)):
//   M = -l F_n w / |w|,
// w the relative spin without its part about the normal, l a length: given, or a share of the effective
// radius. Without a cap the couple would turn a slow spin round within one step and shake for ever. It is
// capped at a sixth of what stops the pair within a step, so that twelve neighbours of equal size together
// do not turn the spin round; a single slow contact then comes to rest within some ten steps.

#include "sim/contact/law_loop.h"
#include "sim/contact/laws/law_options.h"
#include "sim/contact/laws/laws.h"

#include <algorithm>
#include <cmath>

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
    const Real inverseStep = b.dt > 0 ? 1 / b.dt : Real(0);
    const bool moves = b.dt > 0;
    SANDGLASS_CONTACTS(i) {
      const auto c = table(i);
      const Real twist = b.wx[i] * b.nx[i] + b.wy[i] * b.ny[i] + b.wz[i] * b.nz[i];
      const Real wx = b.wx[i] - twist * b.nx[i], wy = b.wy[i] - twist * b.ny[i],
                 wz = b.wz[i] - twist * b.nz[i];
      const Real w = std::sqrt(wx * wx + wy * wy + wz * wz);
      const Real inverseInertia = Real(2.5) * (b.inverseMassA[i] / (b.radiusA[i] * b.radiusA[i]) +
                                               b.inverseMassB[i] / (b.radiusB[i] * b.radiusB[i]));
      const Real most = Real(1.0 / 6.0) * inverseStep / inverseInertia; // couple over spin
      const Real limit = (c.length + c.coefficient * b.effectiveRadius[i]) * b.contactForce[i];
      const Real free = w > 0 ? limit / w : Real(0);
      const Real factor = b.overlap[i] > 0 ? (moves ? std::min(free, most) : free) : Real(0);
      b.mx[i] -= factor * wx;
      b.my[i] -= factor * wy;
      b.mz[i] -= factor * wz;
    }
  }

  template <class Real> struct Constants { Real length = 0, coefficient = 0; };
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
