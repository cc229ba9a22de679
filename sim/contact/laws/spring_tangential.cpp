// Tangential spring with history and Coulomb limit (Cundall, Strack, Geotechnique 29, 47 (1979)).
// The displacement s is kept as a vector: turned into the present tangent plane at unchanged length
// (rotation = "turn") or projected on it ("project", which loses a little length as the contact rolls), then
//   s += v_t dt,  F_t = -k_t s - gamma_t v_t,  |F_t| <= mu F_n,
// and where the limit binds, s is set to what carries the limit force beside the dashpot (withinLimit()). The
// dashpot is a share of the normal one (damping_ratio) or damping_rate times the reduced mass.
// k_t is a share of the normal stiffness: given ("spring"), or 4 G*/E* ("mindlin"), which with a Hertz
// normal law is Mindlin's no-slip stiffness 8 G* sqrt(R overlap).

#include "sim/base/error.h"
#include "sim/contact/fused/fused_laws.h"
#include "sim/contact/law_loop.h"
#include "sim/contact/laws/law_options.h"
#include "sim/contact/laws/laws.h"
#include "sim/contact/laws/spring_formula.h"

#include <cmath>
#include <numbers>

namespace sandglass {

namespace {

class SpringTangential final : public LawLoop<SpringTangential> {
public:
  SpringTangential(const LawContext& context, bool mindlin) {
    for (const PairType& t : context.types) {
      Constants<double> c;
      if (t.used) {
        const Parameters& p = t.parameters;
        c.friction = p.number("friction");
        c.ratio =
            mindlin ? 4.0 * t.effectiveShearModulus / t.effectiveYoungsModulus : p.number("stiffness_ratio");
        if (p.has("damping_ratio") && p.has("damping_rate"))
          throw InputError("a tangential spring takes either damping_ratio or damping_rate, and not both");
        c.rate = p.number("damping_rate", 0.0);
        const double usual = mindlin && !p.has("damping_rate") ? std::sqrt(c.ratio) : 0.0;
        c.damping = p.number("damping_ratio", usual);
        c.gamma = c.rate * t.uniformMass;
        oneMass_ = oneMass_ && t.uniformMass > 0.0;
        rated_ = rated_ || c.rate > 0.0;
        damped_ = damped_ || c.rate > 0.0 || c.damping > 0.0;
        project_.take(p.text("rotation") == "project");
        fullArm_.take(readsFullRadiusArm(p));
      }
      table_.push_back(c);
    }
  }

  int historySize() const override { return 3; }
  std::vector<int> historyVectors() const override { return {0}; }
  bool turnsGrains() const override { return true; }
  bool fullRadiusArm() const override { return fullArm_.value(); }

  template <class Real, class Table>
  SANDGLASS_LOOP void loop(ContactBlockOf<Real>& b, int first, const Table& table) const {
    if (project_.value())
      spring<true>(b, first, table);
    else
      spring<false>(b, first, table);
  }

  double storedEnergy(const ContactBlock& b, int i, int first) const override {
    double s2 = 0.0;
    for (int k = 0; k < 3; ++k)
      s2 += b.history[first + k][i] * b.history[first + k][i];
    return 0.5 * table_[b.type[i]].ratio * b.stiffness[i] * s2;
  }

  /// A dashpot given by its rate has a time scale of its own.
  double collisionTime(int type, double, double, double) const override {
    return std::numbers::pi / table_[type].rate; // infinite without
  }

  void fuse(FusedLaws& laws) const override {
    laws.tangential = FusedLaws::Tangential::spring;
    laws.dashpot = dashpot();
    laws.project = project_.value();
    laws.radiusArm = fullArm_.value();
    laws.spring = table_[laws.type];
  }

  unsigned reads() const override { return rated_ && !oneMass_ ? unsigned{effectiveMass} : 0u; }

  template <class Real> using Constants = SpringConstants<Real>;
  std::vector<Constants<double>> table_;

private:
  Dashpot dashpot() const {
    return !damped_ ? Dashpot::none : rated_ && !oneMass_ ? Dashpot::rate : Dashpot::coefficient;
  }

  template <bool project, class Real, class Table>
  SANDGLASS_LOOP void spring(ContactBlockOf<Real>& b, int first, const Table& table) const {
    switch (dashpot()) {
    case Dashpot::none:
      spring<project, Dashpot::none>(b, first, table);
      break;
    case Dashpot::rate:
      spring<project, Dashpot::rate>(b, first, table);
      break;
    case Dashpot::coefficient:
      spring<project, Dashpot::coefficient>(b, first, table);
      break;
    }
  }

  template <bool project, Dashpot dashpot, class Real, class Table>
  SANDGLASS_LOOP static void spring(ContactBlockOf<Real>& b, int first, const Table& table) {
    Real *sx = b.history[first], *sy = b.history[first + 1], *sz = b.history[first + 2];
    SANDGLASS_CONTACTS(i) {
      const Constants<Real> c = table(i);
      Vector3<Real> s{sx[i], sy[i], sz[i]};
      const NormalForce<Real> normal{0, b.contactForce[i], b.stiffness[i], b.damping[i]};
      const Vector3<Real> f = springForce<ScalarArithmetic, project, dashpot>(
          c, Vector3<Real>{b.nx[i], b.ny[i], b.nz[i]}, Vector3<Real>{b.vtx[i], b.vty[i], b.vtz[i]},
          b.overlap[i], normal, b.effectiveMass[i], b.dt, s);
      sx[i] = s.x;
      sy[i] = s.y;
      sz[i] = s.z;
      b.ftx[i] += f.x;
      b.fty[i] += f.y;
      b.ftz[i] += f.z;
    }
  }

  bool oneMass_ = true, rated_ = false, damped_ = false;
  SharedChoice project_{"rotation"}, fullArm_{"arm"};
};

/// Frictionless: no history, no torque, no spin.
class NoTangential final : public Law {
public:
  void apply(ContactBlock&, int, KernelWidth) const override {}
};

const ParameterSpec friction{"friction", ParameterType::number, "1", "Coulomb coefficient", {}, false, 0.0,
                             100.0};
ParameterSpec damping(const char* leftOut) {
  return {"damping_ratio",
          ParameterType::number,
          "1",
          std::string("share of the normal dashpot; without it and damping_rate ") + leftOut,
          {},
          true,
          0.0,
          100.0};
}
const ParameterSpec dampingRate{"damping_rate",
                                ParameterType::number,
                                "1/s",
                                "dashpot over reduced mass, instead of damping_ratio",
                                {},
                                true,
                                0.0,
                                1e30};

ParameterSpec rotation() {
  ParameterSpec spec{"rotation", ParameterType::text, "1",
                     "how the spring follows the turning contact: turned at its length, or projected",
                     ParameterValue(std::string("turn"))};
  spec.choices = {"turn", "project"};
  return spec;
}

} // namespace

LawKind noTangentialLaw() {
  return {"none", LawRole::tangential, "frictionless; grains do not spin", false, {}, [](const LawContext&) {
            return std::make_unique<NoTangential>();
          }};
}

LawKind springTangentialLaw() {
  ParameterSpec ratio{"stiffness_ratio",
                      ParameterType::number,
                      "1",
                      "tangential over normal stiffness; 2/7 makes both periods equal",
                      ParameterValue(2.0 / 7.0),
                      false,
                      0.0,
                      10.0,
                      true};
  return {"spring",
          LawRole::tangential,
          "tangential spring with history and Coulomb limit",
          false,
          {friction, ratio, damping("none"), dampingRate, rotation(), contactArm()},
          [](const LawContext& c) { return std::make_unique<SpringTangential>(c, false); }};
}

LawKind mindlinTangentialLaw() {
  return {"mindlin",
          LawRole::tangential,
          "Mindlin's no-slip stiffness with Coulomb limit",
          true,
          {friction, damping("the root of tangential over normal stiffness"), dampingRate, rotation(),
           contactArm()},
          [](const LawContext& c) { return std::make_unique<SpringTangential>(c, true); }};
}

} // namespace sandglass
