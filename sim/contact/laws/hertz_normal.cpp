// Hertz contact with the damping of Tsuji, Tanaka, Ishida (Powder Technol. 71, 239 (1992)):
//   F = 4/3 E* sqrt(R) overlap^(3/2) - 2 sqrt(5/6) beta sqrt(S m) v_n,  S = 2 E* sqrt(R overlap),
// beta = -ln e / sqrt(ln^2 e + pi^2), which gives the same restitution e at every impact speed
// (Antypov, Elliott, EPL 94, 50004 (2011)) as long as attraction while parting is not cut off.

#include "sim/base/error.h"
#include "sim/contact/law_loop.h"
#include "sim/contact/laws/laws.h"
#include "sim/contact/restitution.h"

#include <algorithm>
#include <cmath>

namespace sandglass {

namespace {

constexpr double unlimited = 1e30;

class HertzNormal final : public LawLoop<HertzNormal> {
public:
  explicit HertzNormal(const LawContext& context) {
    for (const PairType& t : context.types) {
      Constants<double> c;
      if (t.used) {
        c.modulus = t.effectiveYoungsModulus;
        c.floor = t.parameters.boolean("clamp_attraction") ? 0.0 : -unlimited;
        c.damping = 2.0 * std::sqrt(5.0 / 6.0) * dampingRatio(t.parameters.number("restitution"));
      }
      table_.push_back(c);
    }
  }

  template <class Real, class Table>
  SANDGLASS_LOOP void loop(ContactBlockOf<Real>& b, int first, const Table& table) const {
    SANDGLASS_CONTACTS(i) {
      const auto c = table(i);
      const Real x = std::max(b.overlap[i], Real(0));
      const Real S = 2 * c.modulus * std::sqrt(b.effectiveRadius[i] * x);
      const Real gamma = c.damping * std::sqrt(S * b.effectiveMass[i]);
      Real force = std::max(Real(2.0 / 3.0) * S * x - gamma * b.vn[i], c.floor);
      b.stiffness[i] = S;
      b.damping[i] = gamma;
      b.normalForce[i] += force;
      b.contactForce[i] += std::max(force, Real(0));
    }
  }

  double storedEnergy(const ContactBlock& b, int i, int) const override {
    const double x = std::max(b.overlap[i], 0.0);
    return 8.0 / 15.0 * table_[b.type[i]].modulus * std::sqrt(b.effectiveRadius[i] * x) * x * x;
  }

  /// Elastic Hertz collision (Landau, Lifshitz, Theory of Elasticity, section 9, problem 1):
  /// t = 2.8683 (m^2 / (R E*^2 v))^(1/5), with E* as above.
  double collisionTime(int type, double mass, double radius, double speed) const override {
    const double E = table_[type].modulus;
    return 2.8683 * std::pow(mass * mass / (radius * E * E * speed), 0.2);
  }

  unsigned reads() const override { return effectiveMass | effectiveRadius; }

  template <class Real> struct Constants {
    Real modulus = 0, damping = 0, floor = 0; ///< floor [N]: the most attractive force allowed
  };
  std::vector<Constants<double>> table_;
};

} // namespace

LawKind hertzNormalLaw() {
  ParameterSpec e{"restitution",
                  ParameterType::number,
                  "1",
                  "coefficient of restitution, the same at every speed",
                  {},
                  false,
                  0.0,
                  1.0,
                  true};
  ParameterSpec clamp{
      "clamp_attraction", ParameterType::boolean, "1",
      "cut the dashpot's attraction while parting; lowers nothing but the tail, raises restitution",
      ParameterValue(false)};
  return {"hertz", LawRole::normal, "Hertz spring with Tsuji's dashpot",
          true,    {e, clamp},      [](const LawContext& c) { return std::make_unique<HertzNormal>(c); }};
}

} // namespace sandglass
