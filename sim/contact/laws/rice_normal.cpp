// Normal force of soft viscoelastic spheres as Rice writes it (H. E. Rice, Simulation and Phases of
// Macroscopic Particles in Vortex Flow, M.S. thesis, University of Mississippi, 2012),
//   F = kappa max(0, d^(3/2) + A sqrt(d) d'),  kappa = 4/3 E* sqrt(R),
// the law of Kuwabara and Kono that never pulls. Two switches keep what the program behind the thesis did:
//   radius = "doubled":           sqrt(2 R) in place of sqrt(R), so kappa is larger by sqrt(2);
//   overlap_rate = "difference":  d' is the overlap less that of the step before, 0 before the first touch,
//                                 over the step, not minus the relative normal velocity.

#include "sim/contact/law_loop.h"
#include "sim/contact/laws/laws.h"

#include <algorithm>
#include <cmath>

namespace sandglass {

namespace {

class RiceNormal final : public LawLoop<RiceNormal> {
public:
  explicit RiceNormal(const LawContext& context) {
    for (const PairType& t : context.types) {
      Constants<double> c;
      if (t.used) {
        const Parameters& p = t.parameters;
        c.stiffness =
            4.0 / 3.0 * t.effectiveYoungsModulus * (p.text("radius") == "doubled" ? std::sqrt(2.0) : 1.0);
        c.time = p.number("dissipation_time");
        c.difference = p.text("overlap_rate") == "difference" ? 1.0 : 0.0;
        remembers_ = remembers_ || c.difference > 0.0;
      }
      table_.push_back(c);
    }
  }

  int historySize() const override { return remembers_ ? 1 : 0; } ///< the overlap of the step before [m]
  unsigned reads() const override { return unsigned{effectiveRadius}; }

  template <class Real, class Table>
  SANDGLASS_LOOP void loop(ContactBlockOf<Real>& b, int first, const Table& table) const {
    remembers_ ? spring<true>(b, first, table) : spring<false>(b, first, table);
  }

  double storedEnergy(const ContactBlock& b, int i, int) const override {
    const double x = std::max(b.overlap[i], 0.0);
    return 0.4 * table_[b.type[i]].stiffness * std::sqrt(b.effectiveRadius[i] * x) * x * x;
  }

  /// Of the elastic collision, as for Hertz: E* = 3/4 of the stiffness.
  double collisionTime(int type, double mass, double radius, double speed) const override {
    const double E = 0.75 * table_[type].stiffness;
    if (E <= 0.0) return Law::collisionTime(type, mass, radius, speed);
    return 2.8683 * std::pow(mass * mass / (radius * E * E * speed), 0.2);
  }

  template <class Real> struct Constants {
    Real stiffness = 0;  ///< kappa over sqrt(R) [Pa]
    Real time = 0;       ///< A [s]
    Real difference = 0; ///< 1: d' from the overlap of the step before
  };
  std::vector<Constants<double>> table_;

private:
  template <bool remembers, class Real, class Table>
  SANDGLASS_LOOP static void spring(ContactBlockOf<Real>& b, int first, const Table& table) {
    const Real rate = 1 / b.dt;
    SANDGLASS_CONTACTS(i) {
      const Constants<Real> c = table(i);
      const Real x = b.overlap[i] > 0 ? b.overlap[i] : 0;
      Real approach = -b.vn[i];
      if constexpr (remembers) {
        approach = c.difference > 0 ? (x - b.history[first][i]) * rate : approach;
        b.history[first][i] = c.difference > 0 ? x : 0;
      }
      const Real root = c.stiffness * std::sqrt(b.effectiveRadius[i] * x);
      const Real pull = root * (x + c.time * approach);
      const Real force = pull > 0 ? pull : 0;
      b.stiffness[i] += Real(1.5) * root;
      b.damping[i] += c.time * root;
      b.normalForce[i] += force;
      b.contactForce[i] += force;
    }
  }

  bool remembers_ = false;
};

} // namespace

LawKind riceNormalLaw() {
  const auto choice = [](const char* name, const char* description, std::vector<std::string> choices) {
    ParameterSpec spec{name, ParameterType::text, "1", description, ParameterValue(choices.front())};
    spec.choices = std::move(choices);
    return spec;
  };
  return {
      "rice",
      LawRole::normal,
      "viscoelastic Hertz spring that never pulls, with the choices of a program of 2012",
      true,
      {{"dissipation_time", ParameterType::number, "s", "constant A of the material", {}, false, 0.0, 1e30},
       choice("radius", "effective radius in the stiffness: itself, or twice as large as that program had it",
              {"effective", "doubled"}),
       choice("overlap_rate",
              "rate of the overlap: from the velocities, or its difference to the step before as that "
              "program had it",
              {"velocity", "difference"})},
      [](const LawContext& c) { return std::make_unique<RiceNormal>(c); }};
}

} // namespace sandglass
