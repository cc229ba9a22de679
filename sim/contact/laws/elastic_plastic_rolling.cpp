// Rolling resistance, elastic-plastic spring-dashpot (type C of Ai, Chen, Rotter, Ooi, Powder Technol. 206,
// 269 (2011)): a couple M = -k_r theta - c_r w against the relative rolling angle theta, |k_r theta| <= l
// F_n,
//   k_r = 2.25 k_n l^2  (Jiang, Yu, Harris, Comput. Geotech. 32, 340 (2005)),
// l the rolling length: given, or a coefficient times the effective radius. The dashpot acts while the couple
// is below its limit. Rotation about the normal (torsion) is left free.

#include "sim/contact/law_loop.h"
#include "sim/contact/laws/law_options.h"
#include "sim/contact/laws/laws.h"

#include <cmath>

namespace sandglass {

namespace {

class ElasticPlasticRolling final : public LawLoop<ElasticPlasticRolling> {
public:
  explicit ElasticPlasticRolling(const LawContext& context) {
    for (const PairType& t : context.types) {
      Constants<double> c;
      if (t.used) {
        requireOne(t.parameters, "rolling resistance", "length", "coefficient");
        c.length = t.parameters.number("length", 0.0);
        c.coefficient = t.parameters.number("coefficient", 0.0);
        c.damping = t.parameters.number("damping");
      }
      table_.push_back(c);
    }
  }

  int historySize() const override { return 3; }
  std::vector<int> historyVectors() const override { return {0}; }
  bool readsSpin() const override { return true; }
  bool turnsGrains() const override { return true; }

  template <class Real, class Table>
  SANDGLASS_LOOP void loop(ContactBlockOf<Real>& b, int first, const Table& table) const {
    Real *ax = b.history[first], *ay = b.history[first + 1], *az = b.history[first + 2];
    SANDGLASS_CONTACTS(i) {
      const auto c = table(i);
      const Real twist = b.wx[i] * b.nx[i] + b.wy[i] * b.ny[i] + b.wz[i] * b.nz[i];
      const Real wx = b.wx[i] - twist * b.nx[i], wy = b.wy[i] - twist * b.ny[i],
                 wz = b.wz[i] - twist * b.nz[i];
      const Real along = ax[i] * b.nx[i] + ay[i] * b.ny[i] + az[i] * b.nz[i];
      Real x = ax[i] - along * b.nx[i] + wx * b.dt, y = ay[i] - along * b.ny[i] + wy * b.dt,
           z = az[i] - along * b.nz[i] + wz * b.dt;
      const Real length = c.length + c.coefficient * b.effectiveRadius[i];
      const Real k = Real(2.25) * b.stiffness[i] * length * length;
      const Real limit = length * b.contactForce[i];
      const Real elastic = k * std::sqrt(x * x + y * y + z * z);
      const bool yields = elastic > limit;
      const Real scale = yields ? limit / elastic : Real(1);
      x *= scale;
      y *= scale;
      z *= scale;
      // Moment of inertia of the pair about the contact: 1/I = sum of 1/(7/5 m r^2).
      const Real inverseInertia = (b.inverseMassA[i] / (b.radiusA[i] * b.radiusA[i]) +
                                   b.inverseMassB[i] / (b.radiusB[i] * b.radiusB[i])) /
                                  Real(1.4);
      const Real dashpot = yields ? 0 : 2 * c.damping * std::sqrt(k / inverseInertia);
      const bool touches = b.overlap[i] > 0;
      ax[i] = touches ? x : 0;
      ay[i] = touches ? y : 0;
      az[i] = touches ? z : 0;
      b.mx[i] += touches ? -k * x - dashpot * wx : 0;
      b.my[i] += touches ? -k * y - dashpot * wy : 0;
      b.mz[i] += touches ? -k * z - dashpot * wz : 0;
    }
  }

  double storedEnergy(const ContactBlock& b, int i, int first) const override {
    const auto& c = table_[b.type[i]];
    const double length = c.length + c.coefficient * b.effectiveRadius[i];
    double a2 = 0.0;
    for (int k = 0; k < 3; ++k)
      a2 += b.history[first + k][i] * b.history[first + k][i];
    return 0.5 * 2.25 * b.stiffness[i] * length * length * a2;
  }

  unsigned reads() const override { return radii | masses | effectiveRadius; }

  template <class Real> struct Constants { Real length = 0, coefficient = 0, damping = 0; };
  std::vector<Constants<double>> table_;
};

class NoRolling final : public Law {
public:
  void apply(ContactBlock&, int, KernelWidth) const override {}
};

} // namespace

LawKind noRollingLaw() {
  return {"none", LawRole::rolling, "no rolling resistance", false, {}, [](const LawContext&) {
            return std::make_unique<NoRolling>();
          }};
}

LawKind elasticPlasticRollingLaw() {
  return {"elastic_plastic",
          LawRole::rolling,
          "rolling spring and dashpot with a limit couple",
          false,
          {coupleLength(), coupleCoefficient(), coupleDamping()},
          [](const LawContext& c) { return std::make_unique<ElasticPlasticRolling>(c); }};
}

} // namespace sandglass
