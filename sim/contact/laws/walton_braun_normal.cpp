// Partially latching spring (Walton, Braun, J. Rheol. 30, 949 (1986)): loading along K1, unloading and
// reloading along the stiffer K2 towards a residual overlap d0 that grows with the deepest overlap,
//   F = min(K1 d, max(0, K2 (d - d0))),  d0 = d_max (1 - K1/K2),
// one closed form, so that nothing jumps when the motion turns round inside a contact. d0 is kept until the
// grains part (overlap <= 0): forgetting it at zero force would let a recompression start from K1 d and gain
// energy. No dashpot; for a pair of reduced mass m
//   e = sqrt(K1/K2) at every speed,  t_c = pi/2 sqrt(m) (1/sqrt(K1) + 1/sqrt(K2)).
// Tangential laws are given K1 as the normal stiffness, whatever branch the contact is on: a ratio
// k_t/K1 = 2/7 makes tangential and normal loading periods of solid spheres equal; K_0/K1 = 2(1-nu)/(2-nu)
// is the elastic value.

#include "sim/base/error.h"
#include "sim/contact/law_loop.h"
#include "sim/contact/laws/law_options.h"
#include "sim/contact/laws/laws.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sandglass {

namespace {

class WaltonBraunNormal final : public LawLoop<WaltonBraunNormal> {
public:
  explicit WaltonBraunNormal(const LawContext& context) {
    for (const PairType& t : context.types) {
      Constants<double> c;
      if (t.used) {
        const Parameters& p = t.parameters;
        const bool byUnloading =
            requireOne(p, "a walton_braun contact", "unloading_stiffness", "restitution");
        const bool byStiffness = requireOne(p, "a walton_braun contact", "stiffness", "collision_time");
        if (byUnloading && !byStiffness)
          throw InputError("a walton_braun contact with collision_time needs restitution, not "
                           "unloading_stiffness");
        const double e = byUnloading ? 1.0 : p.number("restitution");
        if (byStiffness) {
          c.loading = p.number("stiffness");
        } else {
          const double w = 0.5 * std::numbers::pi * (1.0 + e) / p.number("collision_time");
          c.loading = t.referenceMass * w * w;
        }
        c.unloading = byUnloading ? p.number("unloading_stiffness") : c.loading / (e * e);
        if (c.unloading < c.loading)
          throw InputError(fmt::format("unloading_stiffness {} N/m is below the loading stiffness {} N/m and "
                                       "would create energy; raise it",
                                       c.unloading, c.loading));
        c.residual = 1.0 - c.loading / c.unloading;
      }
      table_.push_back(c);
    }
  }

  int historySize() const override { return 1; } // d0 [m]

  template <class Real, class Table>
  SANDGLASS_LOOP void loop(ContactBlockOf<Real>& b, int first, const Table& table) const {
    Real* residual = b.history[first];
    SANDGLASS_CONTACTS(i) {
      const auto c = table(i);
      const Real x = std::max(b.overlap[i], Real(0));
      const Real kept = std::max(residual[i], c.residual * x);
      const Real force = std::min(c.loading * x, std::max(c.unloading * (x - kept), Real(0)));
      residual[i] = x > 0 ? kept : 0;
      b.stiffness[i] += c.loading;
      b.normalForce[i] += force;
      b.contactForce[i] += force;
    }
  }

  /// What unloading gives back: 1/2 K2 (d - d0)^2.
  double storedEnergy(const ContactBlock& b, int i, int first) const override {
    const double x = std::max(b.overlap[i] - b.history[first][i], 0.0);
    return b.overlap[i] > 0 ? 0.5 * table_[b.type[i]].unloading * x * x : 0.0;
  }

  /// Half a period of the stiffer spring, which is what a step must resolve; a whole collision takes
  /// (1 + 1/e) / 2 times as long.
  double collisionTime(int type, double mass, double, double) const override {
    return std::numbers::pi * std::sqrt(mass / table_[type].unloading);
  }

  unsigned reads() const override { return 0; }

  template <class Real> struct Constants {
    Real loading = 0, unloading = 0; ///< K1, K2 [N/m]
    Real residual = 0;               ///< 1 - K1/K2
  };
  std::vector<Constants<double>> table_;
};

} // namespace

LawKind waltonBraunNormalLaw() {
  const auto positive = [](const char* name, const char* unit, const char* description, double largest) {
    return ParameterSpec{name, ParameterType::number, unit, description, {}, true, 0.0, largest, true};
  };
  return {"walton_braun",
          LawRole::normal,
          "partially latching spring: soft on loading, stiff on unloading",
          false,
          {positive("stiffness", "N/m", "spring constant of loading", 1e30),
           positive("collision_time", "s", "duration of a collision of two mean grains, instead of stiffness",
                    1e30),
           positive("unloading_stiffness", "N/m", "spring constant of unloading and reloading", 1e30),
           positive("restitution", "1", "coefficient of restitution, instead of unloading_stiffness", 1.0)},
          [](const LawContext& c) { return std::make_unique<WaltonBraunNormal>(c); }};
}

} // namespace sandglass
