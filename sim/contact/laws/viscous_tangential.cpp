// Viscous tangential force with Coulomb's limit (Haff, Werner, Powder Technol. 48, 239 (1986)):
//   F_t = -min(gamma_t |v_t|, mu F_n) v_t / |v_t|.
// No history: cheap, right for fast flows, but a heap at rest creeps. gamma_t is given, or a rate times the
// reduced mass.

#include "sim/contact/law_loop.h"
#include "sim/contact/laws/law_options.h"
#include "sim/contact/laws/laws.h"

#include <cmath>
#include <numbers>

namespace sandglass {

namespace {

class ViscousTangential final : public LawLoop<ViscousTangential> {
public:
  explicit ViscousTangential(const LawContext& context) {
    for (const PairType& t : context.types) {
      Constants<double> c;
      if (t.used) {
        const Parameters& p = t.parameters;
        c.friction = p.number("friction");
        if (requireOne(p, "a viscous tangential law", "damping", "damping_rate"))
          c.damping = p.number("damping");
        else
          c.rate = p.number("damping_rate");
        rated_ = rated_ || c.rate > 0.0;
        fullArm_.take(readsFullRadiusArm(p));
      }
      table_.push_back(c);
    }
  }

  bool turnsGrains() const override { return true; }
  bool fullRadiusArm() const override { return fullArm_.value(); }
  /// The dashpot's decay time sets a scale beside the normal law's.
  double collisionTime(int type, double mass, double, double) const override {
    const auto& c = table_[type];
    return std::numbers::pi / (c.rate + c.damping / mass);
  }
  unsigned reads() const override { return rated_ ? unsigned{effectiveMass} : 0u; }

  template <class Real, class Table>
  SANDGLASS_LOOP void loop(ContactBlockOf<Real>& b, int, const Table& table) const {
    rated_ ? drag<true>(b, table) : drag<false>(b, table);
  }

  template <class Real> struct Constants {
    Real friction = 0, damping = 0, rate = 0; ///< 1, [kg/s], [1/s]
  };
  std::vector<Constants<double>> table_;

private:
  template <bool rated, class Real, class Table>
  SANDGLASS_LOOP static void drag(ContactBlockOf<Real>& b, const Table& table) {
    SANDGLASS_CONTACTS(i) {
      const auto c = table(i);
      Real gamma = c.damping;
      if constexpr (rated) gamma += c.rate * b.effectiveMass[i];
      const Real speed = std::sqrt(b.vtx[i] * b.vtx[i] + b.vty[i] * b.vty[i] + b.vtz[i] * b.vtz[i]);
      const Real limit = c.friction * b.contactForce[i];
      const bool slides = gamma * speed > limit;
      const Real factor = slides ? limit / speed : gamma;
      const bool touches = b.overlap[i] > 0;
      b.ftx[i] -= touches ? factor * b.vtx[i] : 0;
      b.fty[i] -= touches ? factor * b.vty[i] : 0;
      b.ftz[i] -= touches ? factor * b.vtz[i] : 0;
    }
  }

  bool rated_ = false;
  SharedChoice fullArm_{"arm"};
};

} // namespace

LawKind viscousTangentialLaw() {
  const ParameterSpec friction{"friction", ParameterType::number, "1", "Coulomb coefficient", {}, false, 0.0,
                               100.0};
  const ParameterSpec damping{
      "damping", ParameterType::number, "kg/s", "force over slip velocity", {}, true, 0.0, 1e30};
  const ParameterSpec rate{"damping_rate",
                           ParameterType::number,
                           "1/s",
                           "the same over the reduced mass, instead of damping",
                           {},
                           true,
                           0.0,
                           1e30};
  return {"viscous",
          LawRole::tangential,
          "viscous force with Coulomb limit, no history",
          false,
          {friction, damping, rate, contactArm()},
          [](const LawContext& c) { return std::make_unique<ViscousTangential>(c); }};
}

} // namespace sandglass
