// Electrostatic force of charged grains (after Bailey, Powder Technol. 37, 71 (1984)). A charge q before an
// uncharged sphere of radius R at a gap z is drawn to the image of itself,
//   F = q^2 / (16 pi eps z^2) (1 - z / sqrt(R^2 + z^2)),
// and two charges act on each other as from their centres, q1 q2 / (4 pi eps r^2), like signs repelling.
// Below the smallest separation, and in contact, the image force keeps the value it has there. Beyond the
// cut-off all is left out; for z >> R the image force falls as z^-4, but the direct one only as r^-2, so with
// like charges on both grains the cut-off loses (distance/cutoff)^2 of the force at that distance. A wall is
// an uncharged plane.

#include "sim/base/error.h"
#include "sim/contact/law_loop.h"
#include "sim/contact/laws/laws.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>

namespace sandglass {

namespace {

constexpr double vacuumPermittivity = 8.8541878128e-12; // [F/m], CODATA 2018

class CoulombGap final : public LawLoop<CoulombGap> {
public:
  explicit CoulombGap(const LawContext& context) {
    std::map<std::string, double> chargeOf;
    for (const PairType& t : context.types) {
      Constants<double> c;
      if (t.used) {
        const Parameters& p = t.parameters;
        const auto& q = p.numbers("charges");
        if (q.size() != 2)
          throw InputError(
              fmt::format("coulomb needs two charges, in the order of 'between'; {} given", q.size()));
        const double a = t.swapped ? q[1] : q[0], b = t.swapped ? q[0] : q[1];
        const double four = 4.0 * std::numbers::pi * vacuumPermittivity * p.number("relative_permittivity");
        for (const auto& [material, charge] : {std::pair{t.materialA, a}, {t.materialB, b}})
          if (const double known = chargeOf.emplace(material, charge).first->second; known != charge)
            throw InputError(
                fmt::format("coulomb gives the material '{}' the charges {:g} C and {:g} C; make "
                            "it the same in all its contacts",
                            material, known, charge));
        c.imageA = a * a / (4.0 * four);
        c.imageB = b * b / (4.0 * four);
        c.direct = a * b / four;
        c.smallest = p.number("smallest_separation");
        c.cutoff = p.number("cutoff");
        if (c.cutoff <= c.smallest)
          throw InputError("the cutoff of coulomb must be above its smallest_separation");
        range_ = std::max(range_, c.cutoff);
      }
      table_.push_back(c);
    }
  }

  double range() const override { return range_; }
  unsigned reads() const override { return radii | masses; }

  template <class Real, class Table>
  SANDGLASS_LOOP void loop(ContactBlockOf<Real>& b, int, const Table& table) const {
    SANDGLASS_CONTACTS(i) {
      const auto c = table(i);
      const bool wall = b.inverseMassB[i] == 0;
      const Real z = std::max(-b.overlap[i], c.smallest);
      const Real ra = b.radiusA[i], rb = b.radiusB[i];
      const Real beforeB = wall ? Real(1) : 1 - z / std::sqrt(rb * rb + z * z);
      const Real beforeA = wall ? Real(0) : 1 - z / std::sqrt(ra * ra + z * z);
      const Real distance = ra + rb - b.overlap[i];
      const Real direct = wall ? Real(0) : c.direct / (distance * distance);
      const Real force = direct - (c.imageA * beforeB + c.imageB * beforeA) / (z * z);
      b.normalForce[i] += -b.overlap[i] < c.cutoff ? force : 0;
    }
  }

  double storedEnergy(const ContactBlock& b, int i, int) const override {
    const auto& c = table_[b.type[i]];
    if (-b.overlap[i] >= c.cutoff) return 0.0;
    const bool wall = b.inverseMassB[i] == 0.0;
    const double z = std::max(-b.overlap[i], c.smallest), inside = z + b.overlap[i];
    const double ra = b.radiusA[i], rb = b.radiusB[i];
    // Integral of (1 - z / sqrt(R^2 + z^2)) / z^2 from z to the cut-off, and on to where the grains are.
    const auto image = [&](double R, bool plane) {
      const double work = 1.0 / z - 1.0 / c.cutoff;
      if (plane) return work + inside / (z * z);
      return work - (std::asinh(R / z) - std::asinh(R / c.cutoff)) / R +
             inside / (z * z) * (1.0 - z / std::sqrt(R * R + z * z));
    };
    const double direct =
        wall ? 0.0 : c.direct * (1.0 / (ra + rb - b.overlap[i]) - 1.0 / (ra + rb + c.cutoff));
    return direct - c.imageA * image(rb, wall) - (wall ? 0.0 : c.imageB * image(ra, false));
  }

  std::string truncation(int type, double radius, bool wall) const override {
    const auto& c = table_[type];
    const double R = 2.0 * radius; // of either grain
    const auto image = [&](double z) {
      return wall ? c.imageA / (z * z)
                  : (c.imageA + c.imageB) / (z * z) * (1.0 - z / std::sqrt(R * R + z * z));
    };
    std::string text;
    if (image(c.smallest) > 0.0)
      text = fmt::format("image force of up to {:.3g} N, of which the cut-off at {:.3g} m leaves out up to "
                         "{:.2g} %",
                         image(c.smallest), c.cutoff, 100 * image(c.cutoff) / image(c.smallest));
    if (!wall && c.direct != 0.0) {
      const auto direct = [&](double z) { return std::abs(c.direct) / ((2 * R + z) * (2 * R + z)); };
      text += fmt::format("; direct force of up to {:.3g} N, of which it leaves out up to {:.2g} %",
                          direct(0.0), 100 * direct(c.cutoff) / direct(0.0));
    }
    return text;
  }

  template <class Real> struct Constants {
    Real imageA = 0, imageB = 0; ///< [N m^2] charge of a before b, of b before a
    Real direct = 0;             ///< [N m^2]
    Real smallest = 1, cutoff = 0;
  };
  std::vector<Constants<double>> table_;

private:
  double range_ = 0.0;
};

} // namespace

LawKind coulombLaw() {
  const ParameterSpec charges{
      "charges", ParameterType::numbers, "C",
      "charge of a grain of either material, in the order of 'between'; a wall counts as an uncharged plane"};
  const ParameterSpec permittivity{"relative_permittivity",
                                   ParameterType::number,
                                   "1",
                                   "of what is between the grains",
                                   ParameterValue(1.0),
                                   false,
                                   1.0,
                                   1000.0};
  const ParameterSpec smallest{"smallest_separation",
                               ParameterType::number,
                               "m",
                               "gap below which, and in contact, the image force stays constant",
                               {},
                               false,
                               0.0,
                               1.0,
                               true};
  const ParameterSpec cutoff{
      "cutoff", ParameterType::number, "m", "gap beyond which the force is left out", {}, false, 0.0, 1.0,
      true};
  return {"coulomb",
          LawRole::gap,
          "charged grains: image forces and direct ones",
          false,
          {charges, permittivity, smallest, cutoff},
          [](const LawContext& c) { return std::make_unique<CoulombGap>(c); }};
}

} // namespace sandglass
