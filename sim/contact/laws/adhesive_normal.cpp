// Adhesive elastic spheres: modulus E*, radius R (the reduced one), work of adhesion W = 2 gamma [J/m^2].
//
// DMT (Derjaguin, Muller, Toporov, J. Colloid Interface Sci. 53, 314 (1975)), for stiff small grains: Hertz
// with a constant attraction in contact,
//   F = 4/3 E* sqrt(R) d^(3/2) - 2 pi W R,  pull-off 2 pi W R.
//
// JKR (Johnson, Kendall, Roberts, Proc. R. Soc. A 324, 301 (1971)), for soft large ones: with contact radius
// a
//   d = a^2/R - sqrt(2 pi W a / E*),  F = 4 E* a^3 / (3 R) - sqrt(8 pi W E* a^3).
// The contact is born at touch (d = 0) and holds by a neck to d = -3 a_t^2/R, a_t^3 = pi W R^2 / (8 E*);
// pull-off force 3/2 pi W R. In units of a_t, with u = sqrt(a/a_t) - 1 and q = d R / a_t^2 + 3,
//   u sqrt(u^2 + 4 u + 6) = sqrt(q),  F = E* a_t^3 / R (4/3 (1+u)^6 - 8 (1+u)^3),
// which has one simple root: Newton's steps from min(sqrt(q/6), q^(1/4)) settle it.
//
// The friction limit follows the load without the adhesion: F + 2 pi W R (DMT), F + 3 pi W R (JKR; Thornton,
// J. Phys. D 24, 1942 (1991)), where grains overlap. Optional dashpot: Tsuji's, as of the Hertz law.

#include "sim/base/math.h"
#include "sim/contact/law_loop.h"
#include "sim/contact/laws/laws.h"
#include "sim/contact/restitution.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sandglass {

namespace {

template <class Real> struct AdhesiveConstants {
  Real modulus = 0, adhesion = 0; ///< E* [Pa], pi W [J/m^2]
  Real damping = 0;               ///< gamma over sqrt(S m)
};

AdhesiveConstants<double> readAdhesive(const PairType& t) {
  AdhesiveConstants<double> c;
  if (!t.used) return c;
  c.modulus = t.effectiveYoungsModulus;
  c.adhesion = std::numbers::pi * t.parameters.number("surface_energy");
  c.damping = 2.0 * std::sqrt(5.0 / 6.0) * dampingRatio(t.parameters.number("restitution"));
  return c;
}

/// As of the Hertz law.
double hertzTime(double modulus, double mass, double radius, double speed) {
  if (modulus <= 0.0) return std::numeric_limits<double>::infinity();
  return 2.8683 * std::pow(mass * mass / (radius * modulus * modulus * speed), 0.2);
}

class DmtNormal final : public LawLoop<DmtNormal> {
public:
  explicit DmtNormal(const LawContext& context) {
    for (const PairType& t : context.types)
      table_.push_back(readAdhesive(t));
  }

  unsigned reads() const override { return effectiveMass | effectiveRadius; }

  template <class Real, class Table>
  SANDGLASS_LOOP void loop(ContactBlockOf<Real>& b, int, const Table& table) const {
    SANDGLASS_CONTACTS(i) {
      const auto c = table(i);
      const bool touches = b.overlap[i] > 0;
      const Real x = std::max(b.overlap[i], Real(0));
      const Real S = 2 * c.modulus * std::sqrt(b.effectiveRadius[i] * x);
      const Real gamma = c.damping * std::sqrt(S * b.effectiveMass[i]);
      const Real load = Real(2.0 / 3.0) * S * x - gamma * b.vn[i];
      b.stiffness[i] += S;
      b.damping[i] += gamma;
      b.normalForce[i] += touches ? load - 2 * c.adhesion * b.effectiveRadius[i] : 0;
      b.contactForce[i] += touches ? std::max(load, Real(0)) : 0;
    }
  }

  double storedEnergy(const ContactBlock& b, int i, int) const override {
    const auto& c = table_[b.type[i]];
    const double x = std::max(b.overlap[i], 0.0), R = b.effectiveRadius[i];
    return 8.0 / 15.0 * c.modulus * std::sqrt(R * x) * x * x - 2.0 * c.adhesion * R * x;
  }

  double collisionTime(int type, double mass, double radius, double speed) const override {
    return hertzTime(table_[type].modulus, mass, radius, speed);
  }

  template <class Real> using Constants = AdhesiveConstants<Real>;
  std::vector<Constants<double>> table_;
};

class JkrNormal final : public LawLoop<JkrNormal> {
public:
  explicit JkrNormal(const LawContext& context) {
    for (const PairType& t : context.types) {
      const Constants<double> c = readAdhesive(t);
      if (t.used) {
        const double R = t.largestEffectiveRadius, a = std::cbrt(c.adhesion * R * R / (8.0 * c.modulus));
        range_ = std::max(range_, 3.0 * a * a / R * (1.0 + 1e-9));
      }
      table_.push_back(c);
    }
  }

  int historySize() const override { return 1; } // 1 while the contact holds
  double range() const override { return range_; }
  unsigned reads() const override { return effectiveMass | effectiveRadius; }

  template <class Real, class Table>
  SANDGLASS_LOOP void loop(ContactBlockOf<Real>& b, int first, const Table& table) const {
    Real* holds = b.history[first];
    SANDGLASS_CONTACTS(i) {
      const auto c = table(i);
      const Real R = b.effectiveRadius[i];
      const Real at = tearRadius(c, R), unit = at * at / R;
      const Real q = c.adhesion > 0 ? b.overlap[i] / unit + 3 : Real(0);
      const bool touches = b.overlap[i] > 0 || (holds[i] > 0 && q > 0);
      const Real u = root(std::max(q, Real(0))), y3 = (1 + u) * (1 + u) * (1 + u);
      const Real contactRadius = at * (1 + u) * (1 + u);
      const Real S = 2 * c.modulus * contactRadius;
      const Real gamma = c.damping * std::sqrt(S * b.effectiveMass[i]);
      const Real force = c.modulus * at * unit * (Real(4.0 / 3.0) * y3 * y3 - 8 * y3) - gamma * b.vn[i];
      const bool overlaps = b.overlap[i] > 0;
      holds[i] = touches ? 1 : 0;
      b.stiffness[i] += touches ? S : 0;
      b.damping[i] += touches ? gamma : 0;
      b.normalForce[i] += touches ? force : 0;
      b.contactForce[i] += overlaps ? std::max(force + 3 * c.adhesion * R, Real(0)) : 0;
    }
  }

  /// Work to be had by pulling the grains apart to where the neck tears, with the sign of a stored energy.
  double storedEnergy(const ContactBlock& b, int i, int first) const override {
    const auto& c = table_[b.type[i]];
    if (b.history[first][i] <= 0.0 || c.modulus <= 0.0) return 0.0;
    const double R = b.effectiveRadius[i], at = tearRadius(c, R), unit = at * at / R;
    const double y = 1.0 + root(std::max(b.overlap[i] / unit + 3.0, 0.0));
    // F dd = E* a_t^3 / R (4/3 y^6 - 8 y^3) a_t^2 / R (4 y^3 - 4) dy
    const auto integral = [](double s) {
      return 8.0 / 15.0 * std::pow(s, 10) - 112.0 / 21.0 * std::pow(s, 7) + 8.0 * std::pow(s, 4);
    };
    return c.modulus * at * unit * unit * (integral(y) - integral(1.0));
  }

  double collisionTime(int type, double mass, double radius, double speed) const override {
    return hertzTime(table_[type].modulus, mass, radius, speed);
  }

  template <class Real> using Constants = AdhesiveConstants<Real>;
  std::vector<Constants<double>> table_;

private:
  template <class Real> SANDGLASS_LOOP static Real tearRadius(const AdhesiveConstants<Real>& c, Real R) {
    return c.modulus > 0 ? Real(cubeRoot(c.adhesion * R * R / (8 * c.modulus))) : Real(0);
  }
  template <class Real> SANDGLASS_LOOP static Real root(Real q) {
    const Real s = std::sqrt(q);
    Real u = std::min(std::sqrt(q * Real(1.0 / 6.0)), std::sqrt(s));
    for (int k = 0; k < 5; ++k) {
      const Real w = u * u + 4 * u + 6;
      u = u - (u * w - s * std::sqrt(w)) / (2 * u * u + 6 * u + 6);
    }
    return u;
  }

  double range_ = 0.0;
};

const ParameterSpec surfaceEnergy{"surface_energy",
                                  ParameterType::number,
                                  "J/m^2",
                                  "work of adhesion of the two surfaces",
                                  {},
                                  false,
                                  0.0,
                                  1e6,
                                  true};
const ParameterSpec restitution{"restitution",
                                ParameterType::number,
                                "1",
                                "of Tsuji's dashpot, without the loss by adhesion",
                                ParameterValue(1.0),
                                false,
                                0.0,
                                1.0,
                                true};

} // namespace

LawKind dmtNormalLaw() {
  return {"dmt",
          LawRole::normal,
          "Hertz with the constant adhesion of Derjaguin, Muller and Toporov",
          true,
          {surfaceEnergy, restitution},
          [](const LawContext& c) { return std::make_unique<DmtNormal>(c); }};
}

LawKind jkrNormalLaw() {
  return {"jkr",
          LawRole::normal,
          "adhesive contact of Johnson, Kendall and Roberts, torn at a neck",
          true,
          {surfaceEnergy, restitution},
          [](const LawContext& c) { return std::make_unique<JkrNormal>(c); }};
}

} // namespace sandglass
