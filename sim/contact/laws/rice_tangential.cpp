// Friction of Rice (M.S. thesis, University of Mississippi, 2012) and what it should have been.
//   slip = "surface":  F_t = -min(g m |v_t|, mu F_n) v_t / |v_t|, m the reduced mass, v_t the full slip,
//     torque by the contact arm: the viscous force with Coulomb's limit whose rate g is the share of the slip
//     that the program took away in a step, over the step;
//   slip = "spin":  as the program had it. Spins alone make slip, nothing limits the force, and the torque is
//     not that of the force:
//       F_t = g m_a r_a (w_a + w_b) x n,   T = -g I_a (w_a + w_b)_k (1 - |n_k|)  component by component,
//     the same torque on both grains. It keeps neither energy nor angular momentum.

#include "sim/contact/law_loop.h"
#include "sim/contact/laws/law_options.h"
#include "sim/contact/laws/laws.h"

#include <cmath>
#include <numbers>

namespace sandglass {

namespace {

class RiceTangential final : public LawLoop<RiceTangential> {
public:
  explicit RiceTangential(const LawContext& context) {
    for (const PairType& t : context.types) {
      Constants<double> c;
      if (t.used) {
        c.rate = t.parameters.number("slip_rate");
        c.friction = t.parameters.number("friction");
        spin_.take(t.parameters.text("slip") == "spin");
        fullArm_.take(readsFullRadiusArm(t.parameters));
      }
      table_.push_back(c);
    }
  }

  bool turnsGrains() const override { return true; }
  bool readsSpin() const override { return spin_.value(); }
  bool ownTorque() const override { return spin_.value(); }
  bool fullRadiusArm() const override { return fullArm_.value(); }
  unsigned reads() const override {
    return spin_.value() ? unsigned{radii} | masses : unsigned{effectiveMass};
  }
  double collisionTime(int type, double mass, double radius, double speed) const override {
    const double rate = table_[type].rate;
    return rate > 0.0 ? std::numbers::pi / rate : Law::collisionTime(type, mass, radius, speed);
  }

  template <class Real, class Table>
  SANDGLASS_LOOP void loop(ContactBlockOf<Real>& b, int, const Table& table) const {
    spin_.value() ? spins(b, table) : slides(b, table);
  }

  template <class Real> struct Constants {
    Real rate = 0, friction = 0; ///< [1/s], 1
  };
  std::vector<Constants<double>> table_;

private:
  template <class Real, class Table>
  SANDGLASS_LOOP static void slides(ContactBlockOf<Real>& b, const Table& table) {
    SANDGLASS_CONTACTS(i) {
      const auto c = table(i);
      const Real gamma = c.rate * b.effectiveMass[i];
      const Real speed = std::sqrt(b.vtx[i] * b.vtx[i] + b.vty[i] * b.vty[i] + b.vtz[i] * b.vtz[i]);
      const Real limit = c.friction * b.contactForce[i];
      const Real factor = gamma * speed > limit ? limit / speed : gamma;
      const bool touches = b.overlap[i] > 0;
      b.ftx[i] -= touches ? factor * b.vtx[i] : 0;
      b.fty[i] -= touches ? factor * b.vty[i] : 0;
      b.ftz[i] -= touches ? factor * b.vtz[i] : 0;
    }
  }

  template <class Real, class Table>
  SANDGLASS_LOOP static void spins(ContactBlockOf<Real>& b, const Table& table) {
    SANDGLASS_CONTACTS(i) {
      const bool touches = b.overlap[i] > 0;
      const Real r = b.radiusA[i], push = (touches ? table(i).rate : 0) / b.inverseMassA[i] * r;
      const Real turn = Real(0.4) * push * r;
      const Real nx = b.nx[i], ny = b.ny[i], nz = b.nz[i], wx = b.wx[i], wy = b.wy[i], wz = b.wz[i];
      b.ftx[i] += push * (wy * nz - wz * ny);
      b.fty[i] += push * (wz * nx - wx * nz);
      b.ftz[i] += push * (wx * ny - wy * nx);
      b.mx[i] -= turn * wx * (1 - std::abs(nx));
      b.my[i] -= turn * wy * (1 - std::abs(ny));
      b.mz[i] -= turn * wz * (1 - std::abs(nz));
    }
  }

  SharedChoice spin_{"slip"}, fullArm_{"arm"};
};

} // namespace

LawKind riceTangentialLaw() {
  ParameterSpec slip{
      "slip", ParameterType::text, "1",
      "what slips: the surfaces with all their motion, or the spins alone as a program of 2012 had it",
      ParameterValue(std::string("surface"))};
  slip.choices = {"surface", "spin"};
  return {
      "rice",
      LawRole::tangential,
      "viscous force over the mass with Coulomb limit, or that of a program of 2012",
      false,
      {{"slip_rate", ParameterType::number, "1/s", "force over slip velocity and mass", {}, false, 0.0, 1e30},
       {"friction",
        ParameterType::number,
        "1",
        "Coulomb coefficient; without effect with slip = \"spin\"",
        {},
        false,
        0.0,
        100.0},
       slip,
       contactArm()},
      [](const LawContext& c) { return std::make_unique<RiceTangential>(c); }};
}

} // namespace sandglass
