// Linear spring and dashpot:  F = k overlap - gamma v_n.
// Restitution and collision time of a pair of reduced mass m (Schaefer, Dippel, Wolf, J. Phys. I 6, 5
// (1996)):
//   e = exp(-gamma t_c / (2 m)),  t_c = pi / sqrt(k/m - (gamma/2m)^2),
// hence k = m (pi^2 + ln^2 e) / t_c^2. The dashpot is given by
//   restitution:   gamma = 2 zeta sqrt(k m), so e does not depend on size, or by
//   damping_rate:  gamma = rate m, so the collision's decay time 2 / rate does not depend on size.
// Where all pairs of a type have one reduced mass, gamma is a constant and no mass is read.

#include "sim/base/error.h"
#include "sim/contact/fused/fused_laws.h"
#include "sim/contact/law_loop.h"
#include "sim/contact/laws/law_options.h"
#include "sim/contact/laws/laws.h"
#include "sim/contact/laws/linear_formula.h"
#include "sim/contact/restitution.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sandglass {

namespace {

class LinearNormal final : public LawLoop<LinearNormal> {
public:
  explicit LinearNormal(const LawContext& context) {
    for (const PairType& t : context.types) {
      Constants<double> c;
      if (t.used) {
        const Parameters& p = t.parameters;
        const bool clamp = p.boolean("clamp_attraction");
        c.floor = attractionFloor(p);
        if (requireOne(p, "a linear contact", "restitution", "damping_rate")) {
          const double e = p.number("restitution");
          c.zeta = clamp ? dampingRatioClamped(e) : dampingRatio(e);
        } else {
          c.rate = p.number("damping_rate");
        }
        if (requireOne(p, "a linear contact", "stiffness", "collision_time")) {
          c.k = p.number("stiffness");
        } else {
          const double tc = p.number("collision_time");
          const double l = c.rate > 0.0 ? 0.5 * c.rate * tc : -std::log(p.number("restitution", 1.0));
          c.k = t.referenceMass * (std::numbers::pi * std::numbers::pi + l * l) / (tc * tc);
        }
        c.gamma = linearDamping<ScalarArithmetic>(c, t.uniformMass);
        constantDamping_ = constantDamping_ && t.uniformMass > 0.0;
      }
      table_.push_back(c);
    }
  }

  template <class Real, class Table>
  SANDGLASS_LOOP void loop(ContactBlockOf<Real>& b, int, const Table& table) const {
    if (constantDamping_)
      spring<true>(b, table);
    else
      spring<false>(b, table);
  }

  double storedEnergy(const ContactBlock& b, int i, int) const override {
    const double x = std::max(b.overlap[i], 0.0);
    return 0.5 * table_[b.type[i]].k * x * x;
  }

  double collisionTime(int type, double mass, double, double) const override {
    // Overdamped contacts creep apart; then the decay time m / gamma of the dashpot limits the step.
    const auto& c = table_[type];
    if (c.k <= 0.0) return Law::collisionTime(type, mass, 0.0, 0.0);
    const double zeta = c.zeta + 0.5 * c.rate * std::sqrt(mass / c.k);
    const double omega = std::sqrt(c.k / mass), swing = omega * std::sqrt(std::max(1.0 - zeta * zeta, 0.1));
    return std::numbers::pi / std::max(swing, 2.0 * zeta * omega);
  }

  void fuse(FusedLaws& laws) const override {
    laws.normal = constantDamping_ ? FusedLaws::Normal::linear : FusedLaws::Normal::linearOfMass;
    laws.linear = table_[laws.type];
  }

  unsigned reads() const override { return constantDamping_ ? 0u : unsigned{effectiveMass}; }

  template <class Real> using Constants = LinearConstants<Real>;
  std::vector<Constants<double>> table_;

private:
  template <bool constantDamping, class Real, class Table>
  SANDGLASS_LOOP static void spring(ContactBlockOf<Real>& b, const Table& table) {
    SANDGLASS_CONTACTS(i) {
      const auto c = table(i);
      Real gamma = c.gamma;
      if constexpr (!constantDamping) gamma = linearDamping<ScalarArithmetic>(c, b.effectiveMass[i]);
      const auto answer = linearForce<ScalarArithmetic>(c, gamma, b.overlap[i], b.vn[i]);
      b.stiffness[i] += answer.stiffness;
      b.damping[i] += answer.damping;
      b.normalForce[i] += answer.force;
      b.contactForce[i] += answer.load;
    }
  }

  bool constantDamping_ = true;
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
  ParameterSpec e{"restitution", ParameterType::number, "1", "coefficient of restitution", {}, true, 0.0, 1.0,
                  true};
  ParameterSpec rate{"damping_rate",
                     ParameterType::number,
                     "1/s",
                     "dashpot over reduced mass, instead of restitution",
                     {},
                     true,
                     0.0,
                     1e30};
  return {"linear",
          LawRole::normal,
          "linear spring and dashpot",
          false,
          {stiffness, time, e, rate, clampAttraction()},
          [](const LawContext& c) { return std::make_unique<LinearNormal>(c); }};
}

} // namespace sandglass
