// Hertz contact  F = 4/3 E* sqrt(R) d^(3/2) - gamma v_n,  S = 2 E* sqrt(R d) its stiffness, with a dashpot by
//   restitution:       gamma = 2 sqrt(5/6) beta sqrt(S m), beta = -ln e / sqrt(ln^2 e + pi^2): Tsuji, Tanaka,
//                      Ishida, Powder Technol. 71, 239 (1992). The same e at every impact speed (Antypov,
//                      Elliott, EPL 94, 50004 (2011)) as long as attraction while parting is not cut off;
//   damping_rate:      gamma = rate m sqrt(R d), as other programs have it;
//   dissipation_time:  a viscoelastic material, e falls with speed. With rho = 4/3 E* sqrt(R),
//       F = rho (d^(3/2) + 3/2 A sqrt(d) d')  (Brilliantov, Spahn, Hertzsch, Poeschel, PRE 53, 5382 (1996);
//                                             convention "brilliantov", gamma = A S), or
//       F = rho (d^(3/2) +     A sqrt(d) d')  (Kuwabara, Kono, Jpn. J. Appl. Phys. 26, 1230 (1987): the
//                                             factor is in the constant; "kuwabara_kono", gamma = 2/3 A S).

#include "sim/base/error.h"
#include "sim/contact/fused/fused_laws.h"
#include "sim/contact/law_loop.h"
#include "sim/contact/laws/hertz_formula.h"
#include "sim/contact/laws/law_options.h"
#include "sim/contact/laws/laws.h"
#include "sim/contact/restitution.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sandglass {

namespace {

class HertzNormal final : public LawLoop<HertzNormal> {
public:
  explicit HertzNormal(const LawContext& context) {
    for (const PairType& t : context.types) {
      Constants<double> c;
      if (t.used) {
        const Parameters& p = t.parameters;
        const int given = p.has("restitution") + p.has("damping_rate") + p.has("dissipation_time");
        if (given != 1)
          throw InputError(
              "a hertz contact needs exactly one of restitution, damping_rate and dissipation_time");
        c.modulus = t.effectiveYoungsModulus;
        c.floor = attractionFloor(p);
        if (p.has("restitution"))
          c.tsuji = 2.0 * std::sqrt(5.0 / 6.0) * dampingRatio(p.number("restitution"));
        c.rate = p.number("damping_rate", 0.0) / (2.0 * c.modulus);
        const bool inside = p.text("dissipation_convention") == "kuwabara_kono";
        c.time = (inside ? 2.0 / 3.0 : 1.0) * p.number("dissipation_time", 0.0);
        tsuji_ = tsuji_ || c.tsuji > 0.0;
        masses_ = masses_ || c.tsuji > 0.0 || c.rate > 0.0;
      }
      table_.push_back(c);
    }
  }

  template <class Real, class Table>
  SANDGLASS_LOOP void loop(ContactBlockOf<Real>& b, int, const Table& table) const {
    if (tsuji_)
      spring<true, true>(b, table);
    else
      masses_ ? spring<false, true>(b, table) : spring<false, false>(b, table);
  }

  double storedEnergy(const ContactBlock& b, int i, int) const override {
    const double x = std::max(b.overlap[i], 0.0);
    return 8.0 / 15.0 * table_[b.type[i]].modulus * std::sqrt(b.effectiveRadius[i] * x) * x * x;
  }

  /// Elastic Hertz collision (Landau, Lifshitz, Theory of Elasticity, section 9, problem 1):
  /// t = 2.8683 (m^2 / (R E*^2 v))^(1/5), with E* as above. At its deepest, 0.340 v t (2.943 d = v t), where
  /// S = 15/8 m v^2 / d^2, the rate of a dashpot gamma = A S is A S / m = 16.2 A / t^2; one that is faster
  /// than the collision limits the step, as in linear contacts.
  double collisionTime(int type, double mass, double radius, double speed) const override {
    const auto& c = table_[type];
    const double E = c.modulus;
    if (E <= 0.0) return Law::collisionTime(type, mass, radius, speed);
    const double t = 2.8683 * std::pow(mass * mass / (radius * E * E * speed), 0.2);
    const double decay = 16.2 * (c.time + c.rate * mass) / (t * t); // 0: no limit
    return std::min(t, std::numbers::pi / decay);
  }

  void fuse(FusedLaws& laws) const override {
    laws.normal = tsuji_ ? FusedLaws::Normal::hertz : FusedLaws::Normal::other;
    laws.hertz = table_[laws.type];
  }

  unsigned reads() const override {
    return masses_ ? unsigned{effectiveMass} | effectiveRadius : unsigned{effectiveRadius};
  }

  template <class Real> using Constants = HertzConstants<Real>;
  std::vector<Constants<double>> table_;

private:
  template <bool tsuji, bool masses, class Real, class Table>
  SANDGLASS_LOOP static void spring(ContactBlockOf<Real>& b, const Table& table) {
    SANDGLASS_CONTACTS(i) {
      const Constants<Real> c = table(i);
      const auto answer = hertzForce<ScalarArithmetic, tsuji, masses>(
          c, b.overlap[i], b.vn[i], b.effectiveRadius[i], b.effectiveMass[i]);
      b.stiffness[i] += answer.stiffness;
      b.damping[i] += answer.damping;
      b.normalForce[i] += answer.force;
      b.contactForce[i] += answer.load;
    }
  }

  bool tsuji_ = false, masses_ = false;
};

} // namespace

LawKind hertzNormalLaw() {
  const auto number = [](const char* name, const char* unit, const char* description, double largest,
                         bool open) {
    return ParameterSpec{name, ParameterType::number, unit, description, {}, true, 0.0, largest, open};
  };
  ParameterSpec convention{"dissipation_convention", ParameterType::text, "1",
                           "whether the factor 3/2 stands before the dissipation time or is inside it",
                           ParameterValue(std::string("brilliantov"))};
  convention.choices = {"brilliantov", "kuwabara_kono"};
  return {"hertz",
          LawRole::normal,
          "Hertz spring with the dashpot of Tsuji, or of a viscoelastic material",
          true,
          {number("restitution", "1", "coefficient of restitution, the same at every speed", 1.0, true),
           number("damping_rate", "1/(m*s)", "dashpot over reduced mass and contact radius", 1e30, false),
           number("dissipation_time", "s", "constant A of a viscoelastic material", 1e30, false), convention,
           clampAttraction()},
          [](const LawContext& c) { return std::make_unique<HertzNormal>(c); }};
}

} // namespace sandglass
