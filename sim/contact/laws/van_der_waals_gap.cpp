// Attraction of two spheres at a gap z much smaller than their radii (Israelachvili, Intermolecular and
// Surface Forces; Lifshitz constant h, Hamaker constant 3 h / 4 pi):
//   F = h / (8 pi z^2) R1 R2 / (R1 + R2),
// a wall counting as R2 = infinite. Below the smallest separation, and in contact, the force keeps the value
// it has there (0.4 nm by default: distance of closest approach of molecules, 0.165 to 0.4 nm). Beyond the
// cut-off it is left out: at most (smallest/cutoff)^2 of the contact force, and smallest/cutoff of the work
// of separation (default: 1e-4 and 1 %).

#include "sim/base/error.h"
#include "sim/contact/law_loop.h"
#include "sim/contact/laws/laws.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace sandglass {

namespace {

class VanDerWaals final : public LawLoop<VanDerWaals> {
public:
  explicit VanDerWaals(const LawContext& context) {
    for (const PairType& t : context.types) {
      Constants<double> c;
      if (t.used) {
        c.strength = t.parameters.number("lifshitz_constant") / (8.0 * std::numbers::pi);
        c.smallest = t.parameters.number("smallest_separation");
        c.cutoff = t.parameters.number("cutoff");
        if (c.cutoff <= c.smallest)
          throw InputError("the cutoff of van_der_waals must be above its smallest_separation");
        range_ = std::max(range_, c.cutoff);
      }
      table_.push_back(c);
    }
  }

  double range() const override { return range_; }
  unsigned reads() const override { return effectiveRadius; }

  template <class Real, class Table>
  SANDGLASS_LOOP void loop(ContactBlockOf<Real>& b, int, const Table& table) const {
    SANDGLASS_CONTACTS(i) {
      const auto c = table(i);
      const Real z = std::max(-b.overlap[i], c.smallest);
      b.normalForce[i] -= z < c.cutoff ? c.strength * b.effectiveRadius[i] / (z * z) : 0;
    }
  }

  double storedEnergy(const ContactBlock& b, int i, int) const override {
    const auto& c = table_[b.type[i]];
    const double z = std::max(-b.overlap[i], c.smallest);
    if (z >= c.cutoff) return 0.0;
    const double strength = c.strength * b.effectiveRadius[i];
    const double inside = z + b.overlap[i]; // how far below the smallest separation
    return -strength * (1.0 / z - 1.0 / c.cutoff) - strength / (z * z) * inside;
  }

  std::string truncation(int type, double radius, bool) const override {
    const auto& c = table_[type];
    const double share = c.smallest / c.cutoff;
    return fmt::format("up to {:.3g} N; the cut-off at {:.3g} m leaves out forces of up to {:.2g} % of that "
                       "and {:.2g} % of the work of separation",
                       c.strength * radius / (c.smallest * c.smallest), c.cutoff, 100 * share * share,
                       100 * share);
  }

  template <class Real> struct Constants {
    Real strength = 0, smallest = 1, cutoff = 0; ///< h / 8 pi [J], [m], [m]
  };
  std::vector<Constants<double>> table_;

private:
  double range_ = 0.0;
};

} // namespace

LawKind vanDerWaalsLaw() {
  const ParameterSpec h{"lifshitz_constant",
                        ParameterType::number,
                        "J",
                        "Lifshitz-van der Waals constant, 4 pi / 3 of Hamaker's",
                        {},
                        false,
                        0.0,
                        1.0,
                        true};
  const ParameterSpec smallest{"smallest_separation",
                               ParameterType::number,
                               "m",
                               "gap below which, and in contact, the force stays constant",
                               ParameterValue(4e-10),
                               false,
                               0.0,
                               1.0,
                               true};
  const ParameterSpec cutoff{
      "cutoff",
      ParameterType::number,
      "m",
      "gap beyond which the force is left out: (smallest/cutoff)^2 of its largest value",
      ParameterValue(4e-8),
      false,
      0.0,
      1.0,
      true};
  return {"van_der_waals",
          LawRole::gap,
          "van der Waals attraction of close spheres",
          false,
          {h, smallest, cutoff},
          [](const LawContext& c) { return std::make_unique<VanDerWaals>(c); }};
}

} // namespace sandglass
