// Incremental friction with partial slip (Walton, Braun, J. Rheol. 30, 949 (1986), after Mindlin,
// Deresiewicz, J. Appl. Mech. 20, 327 (1953)). The force T is kept as a vector, turned into the present
// tangent plane at unchanged length. With t along T and ds = -v_t dt split into a part along t and a rest,
//   T <- T + K_T ds_parallel t + K_0 ds_perpendicular,   |T| <= mu F_n,
//   K_T = K_0 [(mu F_n - T) / (mu F_n - T*)]^gamma   while T rises,
//   K_T = K_0 [(mu F_n + T) / (mu F_n + T*)]^gamma   while T falls,
// T* the value of T at the last change between rising and falling (0 at first), scaled with F_n as the load
// changes. gamma = 1/3 is nearest to Mindlin's solution; 1 and 2 yield earlier. Once T has passed zero the
// branch goes on: direction, T* and the sense of loading change sign together. K_0 is given, or a share of
// the normal law's (loading) stiffness; 2 (1 - nu) / (2 - nu) is the elastic value.

#include "sim/base/math.h"
#include "sim/contact/law_loop.h"
#include "sim/contact/laws/law_options.h"
#include "sim/contact/laws/laws.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sandglass {

namespace {

enum class Exponent { third, one, two, any };

template <Exponent exponent> SANDGLASS_LOOP double powerOf(double base, double gamma) {
  if constexpr (exponent == Exponent::third) return cubeRoot(base);
  if constexpr (exponent == Exponent::one) return base;
  if constexpr (exponent == Exponent::two) return base * base;
  return powerOfShare(base, gamma);
}

class WaltonTangential final : public LawLoop<WaltonTangential> {
public:
  explicit WaltonTangential(const LawContext& context) {
    bool first = true;
    for (const PairType& t : context.types) {
      Constants<double> c;
      if (t.used) {
        const Parameters& p = t.parameters;
        c.friction = p.number("friction");
        if (requireOne(p, "a walton tangential law", "stiffness", "stiffness_ratio"))
          c.stiffness = p.number("stiffness");
        else
          c.ratio = p.number("stiffness_ratio");
        c.exponent = p.number("exponent");
        const Exponent form = std::abs(c.exponent - 1.0 / 3.0) < 1e-4 ? Exponent::third
                              : c.exponent == 1.0                     ? Exponent::one
                              : c.exponent == 2.0                     ? Exponent::two
                                                                      : Exponent::any;
        form_ = first || form == form_ ? form : Exponent::any;
        first = false;
        fullArm_.take(readsFullRadiusArm(p));
      }
      table_.push_back(c);
    }
  }

  int historySize() const override { return 5; } // T [N]; T* [N]; F_n [N], negative while T falls
  std::vector<int> historyVectors() const override { return {0}; }
  bool turnsGrains() const override { return true; }
  bool fullRadiusArm() const override { return fullArm_.value(); }
  unsigned reads() const override { return 0; }

  /// A stiffness of its own has a time scale of its own: a period of solid spheres that turn and slide on it
  /// (2/7 of their reduced mass). That of the normal spring is as long up to 8/7 of its stiffness.
  double collisionTime(int type, double mass, double, double) const override {
    return 2.0 * std::numbers::pi * std::sqrt(2.0 / 7.0 * mass / table_[type].stiffness); // infinite without
  }

  template <class Real, class Table>
  SANDGLASS_LOOP void loop(ContactBlockOf<Real>& b, int first, const Table& table) const {
    switch (form_) {
    case Exponent::third:
      return slip<Exponent::third>(b, first, table);
    case Exponent::one:
      return slip<Exponent::one>(b, first, table);
    case Exponent::two:
      return slip<Exponent::two>(b, first, table);
    case Exponent::any:
      return slip<Exponent::any>(b, first, table);
    }
  }

  /// What T would give back on its way to zero: the integral of T dT / K_T along the falling branch.
  double storedEnergy(const ContactBlock& b, int i, int first) const override {
    const auto& c = table_[b.type[i]];
    const double k = c.stiffness + c.ratio * b.stiffness[i], limit = c.friction * b.contactForce[i];
    const double T = std::sqrt(b.history[first][i] * b.history[first][i] +
                               b.history[first + 1][i] * b.history[first + 1][i] +
                               b.history[first + 2][i] * b.history[first + 2][i]);
    if (k <= 0.0 || limit <= 0.0 || T == 0.0) return 0.0;
    const double turn = b.history[first + 4][i] < 0.0 ? std::max(T, b.history[first + 3][i]) : T;
    constexpr int pieces = 32; // Simpson
    double sum = 0.0;
    for (int q = 0; q <= pieces; ++q) {
      const double x = T * q / pieces;
      const double weight = q == 0 || q == pieces ? 1 : q % 2 ? 4 : 2;
      sum += weight * x / (k * std::pow((limit + x) / (limit + turn), c.exponent));
    }
    return sum * T / (3 * pieces);
  }

  template <class Real> struct Constants {
    Real friction = 0, stiffness = 0, ratio = 0, exponent = 0; ///< 1, [N/m], of the normal one, gamma
  };
  std::vector<Constants<double>> table_;

private:
  template <Exponent exponent, class Real, class Table>
  SANDGLASS_LOOP static void slip(ContactBlockOf<Real>& b, int first, const Table& table) {
    Real *tx = b.history[first], *ty = b.history[first + 1], *tz = b.history[first + 2];
    Real *turn = b.history[first + 3], *load = b.history[first + 4];
    SANDGLASS_CONTACTS(i) {
      const auto c = table(i);
      const Real old2 = tx[i] * tx[i] + ty[i] * ty[i] + tz[i] * tz[i];
      const Real along = tx[i] * b.nx[i] + ty[i] * b.ny[i] + tz[i] * b.nz[i];
      const Real px = tx[i] - along * b.nx[i], py = ty[i] - along * b.ny[i], pz = tz[i] - along * b.nz[i];
      const Real now2 = px * px + py * py + pz * pz;
      const Real dx = -b.vtx[i] * b.dt, dy = -b.vty[i] * b.dt, dz = -b.vtz[i] * b.dt;
      // Direction of the force so far; at first touch that of the slip.
      const bool fresh = !(now2 > 0);
      const Real ux = fresh ? dx : px, uy = fresh ? dy : py, uz = fresh ? dz : pz;
      const Real u2 = ux * ux + uy * uy + uz * uz;
      const Real inverse = u2 > 0 ? 1 / std::sqrt(u2) : Real(0);
      const Real ex = ux * inverse, ey = uy * inverse, ez = uz * inverse;
      const Real T = fresh ? Real(0) : std::sqrt(old2);
      const Real ds = dx * ex + dy * ey + dz * ez;

      const Real limit = c.friction * b.contactForce[i];
      const Real before = std::abs(load[i]);
      const Real kept = before > 0 && !fresh ? turn[i] * (b.contactForce[i] / before) : Real(0);
      const bool rose = load[i] >= 0 || fresh;
      const bool rises = ds > 0 || (rose && ds == 0);
      const Real from = rises == rose ? kept : T;
      const Real above = rises ? limit - T : limit + T, whole = rises ? limit - from : limit + from;
      const Real share = above > 0 && whole > 0 ? std::min(above / whole, Real(1)) : Real(0);

      const Real k0 = c.stiffness + c.ratio * b.stiffness[i];
      const Real kt = k0 * Real(powerOf<exponent>(share, c.exponent));
      const Real parallel = T + kt * ds;
      Real fx = parallel * ex + k0 * (dx - ds * ex), fy = parallel * ey + k0 * (dy - ds * ey),
           fz = parallel * ez + k0 * (dz - ds * ez);
      const Real f2 = fx * fx + fy * fy + fz * fz;
      const Real scale = f2 > limit * limit ? limit / std::sqrt(f2) : Real(1);
      fx *= scale;
      fy *= scale;
      fz *= scale;
      const bool touches = b.overlap[i] > 0, passed = parallel < 0;
      const bool falls = rises == passed; // as seen along the new direction
      tx[i] = touches ? fx : 0;
      ty[i] = touches ? fy : 0;
      tz[i] = touches ? fz : 0;
      turn[i] = touches ? (passed ? -from : from) : 0;
      load[i] = touches ? (falls ? -b.contactForce[i] : b.contactForce[i]) : 0;
      b.ftx[i] += touches ? fx : 0;
      b.fty[i] += touches ? fy : 0;
      b.ftz[i] += touches ? fz : 0;
    }
  }

  Exponent form_ = Exponent::one;
  SharedChoice fullArm_{"arm"};
};

} // namespace

LawKind waltonTangentialLaw() {
  const ParameterSpec friction{"friction", ParameterType::number, "1", "Coulomb coefficient", {}, false, 0.0,
                               100.0};
  const ParameterSpec stiffness{
      "stiffness", ParameterType::number, "N/m", "initial tangential stiffness", {}, true, 0.0, 1e30, true};
  const ParameterSpec ratio{"stiffness_ratio",
                            ParameterType::number,
                            "1",
                            "the same over the normal (loading) stiffness, instead of stiffness",
                            {},
                            true,
                            0.0,
                            10.0,
                            true};
  const ParameterSpec exponent{"exponent",
                               ParameterType::number,
                               "1",
                               "gamma: 1/3 as Mindlin, 1 or 2 yield earlier",
                               ParameterValue(1.0 / 3.0),
                               false,
                               0.0,
                               10.0,
                               true};
  return {"walton",
          LawRole::tangential,
          "incremental friction with partial slip and turning points",
          false,
          {friction, stiffness, ratio, exponent, contactArm()},
          [](const LawContext& c) { return std::make_unique<WaltonTangential>(c); }};
}

} // namespace sandglass
