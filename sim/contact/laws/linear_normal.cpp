// Linear spring and dashpot:  F = k overlap - gamma v_n.
// Restitution and collision time of a pair of reduced mass m (Schaefer, Dippel, Wolf, J. Phys. I 6, 5
// (1996)):
//   e = exp(-gamma t_c / (2 m)),  t_c = pi / sqrt(k/m - (gamma/2m)^2),
// hence k = m (pi^2 + ln^2 e) / t_c^2. The dashpot follows each pair's own mass, so e does not depend on
// size.

#include "sim/base/error.h"
#include "sim/contact/law_loop.h"
#include "sim/contact/laws/laws.h"
#include "sim/contact/restitution.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sandglass {

namespace {

constexpr double unlimited = 1e30;

class LinearNormal final : public LawLoop<LinearNormal> {
public:
  explicit LinearNormal(const LawContext& context) {
    for (const PairType& t : context.types) {
      Constants<double> c;
      if (t.used) {
        const double e = t.parameters.number("restitution");
        const bool clamp = t.parameters.boolean("clamp_attraction");
        c.floor = clamp ? 0.0 : -unlimited;
        c.zeta = clamp ? dampingRatioClamped(e) : dampingRatio(e);
        const bool given = t.parameters.has("stiffness"), timed = t.parameters.has("collision_time");
        if (given == timed)
          throw InputError("a linear contact needs either stiffness or collision_time, and not both");
        if (given) {
          c.k = t.parameters.number("stiffness");
        } else {
          const double l = std::log(e), tc = t.parameters.number("collision_time");
          c.k = t.referenceMass * (std::numbers::pi * std::numbers::pi + l * l) / (tc * tc);
        }
      }
      table_.push_back(c);
    }
  }

  template <class Real, class Table>
  SANDGLASS_LOOP void loop(ContactBlockOf<Real>& b, int first, const Table& table) const {
    for (int i = 0; i < b.size; ++i) {
      const auto c = table(i);
      const Real gamma = 2 * c.zeta * std::sqrt(c.k * b.effectiveMass[i]);
      Real force = std::max(c.k * b.overlap[i] - gamma * b.vn[i], c.floor);
      force = b.overlap[i] > 0 ? force : 0;
      b.stiffness[i] = c.k;
      b.damping[i] = gamma;
      b.normalForce[i] += force;
      b.contactForce[i] += std::max(force, Real(0));
    }
  }

  double storedEnergy(const ContactBlock& b, int i, int) const override {
    const double x = std::max(b.overlap[i], 0.0);
    return 0.5 * table_[b.type[i]].k * x * x;
  }

  double collisionTime(int type, double mass, double, double) const override {
    // Overdamped contacts creep apart; their spring alone still limits the step.
    const auto& c = table_[type];
    return std::numbers::pi / std::sqrt(c.k / mass * std::max(1.0 - c.zeta * c.zeta, 0.1));
  }

  unsigned reads() const override { return effectiveMass; }

  template <class Real> struct Constants {
    Real k = 0, zeta = 0, floor = 0; ///< floor [N]: the most attractive force allowed
  };
  std::vector<Constants<double>> table_;
};

} // namespace

LawKind linearNormalLaw() {
  ParameterSpec stiffness{"stiffness", ParameterType::number, "N/m", "spring constant", {}, true, 0.0, 1e30,
                          true};
  ParameterSpec time{"collision_time",
                     ParameterType::number,
                     "s",
                     "duration of a collision of two mean grains, instead of stiffness",
                     {},
                     true,
                     0.0,
                     1e30,
                     true};
  ParameterSpec e{
      "restitution", ParameterType::number, "1", "coefficient of restitution", {}, false, 0.0, 1.0, true};
  ParameterSpec clamp{"clamp_attraction", ParameterType::boolean, "1",
                      "cut the dashpot's attraction while parting", ParameterValue(false)};
  return {"linear",
          LawRole::normal,
          "linear spring and dashpot",
          false,
          {stiffness, time, e, clamp},
          [](const LawContext& c) { return std::make_unique<LinearNormal>(c); }};
}

} // namespace sandglass
