// Tangential spring with history and Coulomb limit (Cundall, Strack, Geotechnique 29, 47 (1979)).
// The displacement s is kept as a vector: turned into the present tangent plane at unchanged length, then
//   s += v_t dt,  F_t = -k_t s - gamma_t v_t,  |F_t| <= mu F_n,
// and where the limit binds, s is set to what carries the limit force.
// k_t is a share of the normal stiffness: given ("spring"), or 4 G*/E* ("mindlin"), which with a Hertz
// normal law is Mindlin's no-slip stiffness 8 G* sqrt(R overlap).

#include "sim/base/error.h"
#include "sim/contact/law_loop.h"
#include "sim/contact/laws/laws.h"

#include <cmath>

namespace sandglass {

namespace {

class SpringTangential final : public LawLoop<SpringTangential> {
public:
  SpringTangential(const LawContext& context, bool mindlin) {
    for (const PairType& t : context.types) {
      Constants<double> c;
      if (t.used) {
        c.friction = t.parameters.number("friction");
        c.ratio = mindlin ? 4.0 * t.effectiveShearModulus / t.effectiveYoungsModulus
                          : t.parameters.number("stiffness_ratio");
        c.damping = t.parameters.number("damping_ratio", mindlin ? std::sqrt(c.ratio) : 0.0);
      }
      table_.push_back(c);
    }
  }

  int historySize() const override { return 3; }
  bool turnsGrains() const override { return true; }

  template <class Real, class Table>
  SANDGLASS_LOOP void loop(ContactBlockOf<Real>& b, int first, const Table& table) const {
    Real *sx = b.history[first], *sy = b.history[first + 1], *sz = b.history[first + 2];
    for (int i = 0; i < b.size; ++i) {
      const auto c = table(i);
      const Real old2 = sx[i] * sx[i] + sy[i] * sy[i] + sz[i] * sz[i];
      const Real along = sx[i] * b.nx[i] + sy[i] * b.ny[i] + sz[i] * b.nz[i];
      Real x = sx[i] - along * b.nx[i], y = sy[i] - along * b.ny[i], z = sz[i] - along * b.nz[i];
      const Real now2 = x * x + y * y + z * z;
      const Real keep = now2 > 0 ? std::sqrt(old2 / now2) : Real(1);
      x = x * keep + b.vtx[i] * b.dt;
      y = y * keep + b.vty[i] * b.dt;
      z = z * keep + b.vtz[i] * b.dt;
      const Real kt = c.ratio * b.stiffness[i], gamma = c.damping * b.damping[i];
      Real fx = -kt * x - gamma * b.vtx[i], fy = -kt * y - gamma * b.vty[i], fz = -kt * z - gamma * b.vtz[i];
      const Real f2 = fx * fx + fy * fy + fz * fz, limit = c.friction * b.contactForce[i];
      const bool slides = f2 > limit * limit;
      const Real scale = slides ? limit / std::sqrt(f2) : Real(1);
      fx *= scale;
      fy *= scale;
      fz *= scale;
      const bool touches = b.overlap[i] > 0;
      const Real compliance = kt > 0 ? 1 / kt : 0;
      x = slides ? -(fx + gamma * b.vtx[i]) * compliance : x;
      y = slides ? -(fy + gamma * b.vty[i]) * compliance : y;
      z = slides ? -(fz + gamma * b.vtz[i]) * compliance : z;
      sx[i] = touches ? x : 0;
      sy[i] = touches ? y : 0;
      sz[i] = touches ? z : 0;
      b.ftx[i] += touches ? fx : 0;
      b.fty[i] += touches ? fy : 0;
      b.ftz[i] += touches ? fz : 0;
    }
  }

  double storedEnergy(const ContactBlock& b, int i, int first) const override {
    double s2 = 0.0;
    for (int k = 0; k < 3; ++k)
      s2 += b.history[first + k][i] * b.history[first + k][i];
    return 0.5 * table_[b.type[i]].ratio * b.stiffness[i] * s2;
  }

  unsigned reads() const override { return 0; }

  template <class Real> struct Constants { Real friction = 0, ratio = 0, damping = 0; };
  std::vector<Constants<double>> table_;
};

/// Frictionless: no history, no torque, no spin.
class NoTangential final : public Law {
public:
  void apply(ContactBlock&, int, KernelWidth) const override {}
};

const ParameterSpec friction{"friction", ParameterType::number, "1", "Coulomb coefficient", {}, false, 0.0,
                             100.0};
const ParameterSpec damping{
    "damping_ratio", ParameterType::number, "1", "share of the normal dashpot", {}, true, 0.0, 100.0};

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
          {friction, ratio, damping},
          [](const LawContext& c) { return std::make_unique<SpringTangential>(c, false); }};
}

LawKind mindlinTangentialLaw() {
  return {"mindlin",
          LawRole::tangential,
          "Mindlin's no-slip stiffness with Coulomb limit",
          true,
          {friction, damping},
          [](const LawContext& c) { return std::make_unique<SpringTangential>(c, true); }};
}

} // namespace sandglass
