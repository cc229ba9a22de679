// Rolling resistance, elastic-plastic spring-dashpot (type C of Ai, Chen, Rotter, Ooi, Powder Technol. 206,
// 269 (2011)): a couple M = -k_r theta - c_r w against the relative rolling angle theta, |M| <= l F_n,
//   k_r = 2.25 k_n l^2  (Jiang, Yu, Harris, Comput. Geotech. 32, 340 (2005)),
// l the rolling length: given, or a coefficient times the effective radius. The paper limits the spring
// alone; a dashpot that comes on top would stop a spinning grain in a single light touch. Rotation about the
// normal (torsion) is left free.

#include "sim/contact/fused/fused_laws.h"
#include "sim/contact/law_loop.h"
#include "sim/contact/laws/law_options.h"
#include "sim/contact/laws/laws.h"
#include "sim/contact/laws/rolling_pair.h"

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
      const Vector3<Real> n{b.nx[i], b.ny[i], b.nz[i]};
      Vector3<Real> angle{ax[i], ay[i], az[i]};
      const Vector3<Real> couple = elasticPlasticCouple<ScalarArithmetic>(
          c, n, rollingPair(b, i), b.overlap[i], b.contactForce[i], b.stiffness[i], b.dt, angle);
      ax[i] = angle.x;
      ay[i] = angle.y;
      az[i] = angle.z;
      b.mx[i] += couple.x;
      b.my[i] += couple.y;
      b.mz[i] += couple.z;
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

  void fuse(FusedLaws& laws) const override {
    laws.rolling = FusedLaws::Rolling::elasticPlastic;
    laws.couple = table_[laws.type];
  }

  template <class Real> using Constants = RollingConstants<Real>;
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
