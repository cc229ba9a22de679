// Resistance against spin about the contact normal, a couple M n on grain a and -M n on grain b. With the
// relative spin w about the normal and a length l (given, or a share of the effective radius):
//   constant_torque:  M = -l F_n sign(w), capped as the rolling law of that name is;
//   elastic_plastic:  M = -k a - c w against the angle a of twist, |M| <= l F_n, k = 2.25 k_n l^2, the
//   dashpot
//                     a share of critical damping; the rule of Jiang, Yu, Harris, Comput. Geotech. 32, 340
//                     (2005), carried over from rolling (Luding, Granular Matter 10, 235 (2008), treats both
//                     alike).
// A uniform pressure over a contact of radius a gives l = 2/3 mu a.

#include "sim/contact/law_loop.h"
#include "sim/contact/laws/law_options.h"
#include "sim/contact/laws/laws.h"

#include <algorithm>
#include <cmath>

namespace sandglass {

namespace {

template <class Real> struct TorsionConstants { Real length = 0, coefficient = 0, damping = 0; };

TorsionConstants<double> readTorsion(const PairType& t) {
  TorsionConstants<double> c;
  if (!t.used) return c;
  requireOne(t.parameters, "torsion", "length", "coefficient");
  c.length = t.parameters.number("length", 0.0);
  c.coefficient = t.parameters.number("coefficient", 0.0);
  c.damping = t.parameters.number("damping", 0.0);
  return c;
}

/// One over the moment of inertia of the relative spin: the sum of 1 / (2/5 m r^2).
template <class Real> SANDGLASS_LOOP Real inverseInertia(const ContactBlockOf<Real>& b, int i) {
  return Real(2.5) * (b.inverseMassA[i] / (b.radiusA[i] * b.radiusA[i]) +
                      b.inverseMassB[i] / (b.radiusB[i] * b.radiusB[i]));
}

class ConstantTorqueTorsion final : public LawLoop<ConstantTorqueTorsion> {
public:
  explicit ConstantTorqueTorsion(const LawContext& context) {
    for (const PairType& t : context.types)
      table_.push_back(readTorsion(t));
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
      const Real w = b.wx[i] * b.nx[i] + b.wy[i] * b.ny[i] + b.wz[i] * b.nz[i];
      const Real most = Real(1.0 / 6.0) * inverseStep / inverseInertia(b, i);
      const Real limit = (c.length + c.coefficient * b.effectiveRadius[i]) * b.contactForce[i];
      const Real size = std::abs(w);
      const Real free = size > 0 ? limit / size : Real(0);
      const Real M = b.overlap[i] > 0 ? -(moves ? std::min(free, most) : free) * w : Real(0);
      b.mx[i] += M * b.nx[i];
      b.my[i] += M * b.ny[i];
      b.mz[i] += M * b.nz[i];
    }
  }

  template <class Real> using Constants = TorsionConstants<Real>;
  std::vector<Constants<double>> table_;
};

class ElasticPlasticTorsion final : public LawLoop<ElasticPlasticTorsion> {
public:
  explicit ElasticPlasticTorsion(const LawContext& context) {
    for (const PairType& t : context.types)
      table_.push_back(readTorsion(t));
  }

  int historySize() const override { return 1; } // angle of twist [rad]
  bool readsSpin() const override { return true; }
  bool turnsGrains() const override { return true; }
  unsigned reads() const override { return radii | masses | effectiveRadius; }

  template <class Real, class Table>
  SANDGLASS_LOOP void loop(ContactBlockOf<Real>& b, int first, const Table& table) const {
    Real* angle = b.history[first];
    SANDGLASS_CONTACTS(i) {
      const auto c = table(i);
      const Real w = b.wx[i] * b.nx[i] + b.wy[i] * b.ny[i] + b.wz[i] * b.nz[i];
      const Real length = c.length + c.coefficient * b.effectiveRadius[i];
      const Real k = Real(2.25) * b.stiffness[i] * length * length;
      const Real limit = length * b.contactForce[i];
      const Real dashpot = 2 * c.damping * std::sqrt(k / inverseInertia(b, i));
      const Real twist = angle[i] + w * b.dt;
      const Real free = -k * twist - dashpot * w;
      const bool yields = std::abs(free) > limit, touches = b.overlap[i] > 0;
      const Real M = touches ? (yields ? std::copysign(limit, free) : free) : Real(0);
      // As withinLimit() has it for vectors.
      const Real ofSpring = M + dashpot * w, kept = ofSpring * M > 0 ? -ofSpring / k : Real(0);
      angle[i] = touches ? (yields ? kept : twist) : Real(0);
      b.mx[i] += M * b.nx[i];
      b.my[i] += M * b.ny[i];
      b.mz[i] += M * b.nz[i];
    }
  }

  double storedEnergy(const ContactBlock& b, int i, int first) const override {
    const auto& c = table_[b.type[i]];
    const double length = c.length + c.coefficient * b.effectiveRadius[i], a = b.history[first][i];
    return b.overlap[i] > 0 ? 0.5 * 2.25 * b.stiffness[i] * length * length * a * a : 0.0;
  }

  template <class Real> using Constants = TorsionConstants<Real>;
  std::vector<Constants<double>> table_;
};

class NoTorsion final : public Law {
public:
  void apply(ContactBlock&, int, KernelWidth) const override {}
};

} // namespace

LawKind noTorsionLaw() {
  return {"none", LawRole::torsion, "grains spin freely about the normal", false, {}, [](const LawContext&) {
            return std::make_unique<NoTorsion>();
          }};
}

LawKind constantTorqueTorsionLaw() {
  return {"constant_torque",
          LawRole::torsion,
          "couple of constant size about the normal",
          false,
          {coupleLength(), coupleCoefficient()},
          [](const LawContext& c) { return std::make_unique<ConstantTorqueTorsion>(c); }};
}

LawKind elasticPlasticTorsionLaw() {
  return {"elastic_plastic",
          LawRole::torsion,
          "spring and dashpot about the normal with a limit couple",
          false,
          {coupleLength(), coupleCoefficient(), coupleDamping()},
          [](const LawContext& c) { return std::make_unique<ElasticPlasticTorsion>(c); }};
}

} // namespace sandglass
