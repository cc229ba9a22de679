// Torque of the fluid on a turning grain,  T = -k omega:  k given, or 8 pi eta r^3 (Stokes). The step takes
// the exact solution for the torque C of the contacts held fixed: with q = k dt / I,
//   omega' = omega e^-q + C dt / I (1 - e^-q) / q,
// which is stable for any k. Written as a torque for the loop's own update, which adds dt / I times it.

#include "sim/base/error.h"
#include "sim/fields/field.h"
#include "sim/fields/field_kinds.h"
#include "sim/math/exponential.h"

#include <numbers>

namespace sandglass {

namespace {

class SpinDrag final : public Field {
public:
  explicit SpinDrag(const Parameters& p) : explicit_(p.text("update") == "explicit") {
    if (p.has("coefficient") == p.has("viscosity"))
      throw InputError("a spin_drag needs either coefficient or viscosity");
    if (p.has("coefficient"))
      given_ = p.number("coefficient");
    else
      stokes_ = 8.0 * std::numbers::pi * p.number("viscosity");
  }

  void apply(FieldBlock& b, double factor) const override {
    const double given = factor * given_, stokes = factor * stokes_, rate = 2.5 * b.dt;
    const bool plain = explicit_;
    SANDGLASS_GRAINS(i) {
      const double r = b.radius[i];
      const double q = (given + stokes * (r * r * r)) * rate * b.inverseMass[i] / (r * r);
      const double near = 1.0 - q * (1.0 / 2) * (1.0 - q * (1.0 / 3) * (1.0 - q * (1.0 / 4)));
      const double far = (1.0 - exponential(-q)) / (q > 1e-3 ? q : 1.0);
      const double share = q > 1e-3 ? far : near; // (1 - e^-q) / q
      // The source turns with the contacts' torque first and damps what comes out: 1 - q of it.
      const double keep = plain ? 1.0 - q : share, damp = plain ? q : q * share;
      const double back = 1.0 / (rate * b.inverseMass[i]);
      b.turnX[i] = keep * b.turnX[i] - damp * b.rollX[i] * back;
      b.turnY[i] = keep * b.turnY[i] - damp * b.rollY[i] * back;
      b.turnZ[i] = keep * b.turnZ[i] - damp * b.rollZ[i] * back;
    }
  }

private:
  bool explicit_;
  double given_ = 0, stokes_ = 0;
};

} // namespace

FieldKind spinDragField() {
  ParameterSpec update{
      .name = "update",
      .type = ParameterType::text,
      .unit = "1",
      .description = "the decay of a step: exact, or its first order, which a small grain makes unstable",
      .fallback = std::string("exact"),
      .choices = {"exact", "explicit"}};
  return {
      "spin_drag",
      FieldRole::spin,
      "a torque of the fluid that lessens spins",
      "an exponential a grain and step",
      {optionalNumber("coefficient", "N*m*s", "torque over spin, the same for all grains", 0, true),
       optionalNumber("viscosity", "Pa*s", "of the fluid, for the torque of Stokes on each grain", 0, true),
       update},
      [](const Parameters& p) { return std::make_unique<SpinDrag>(p); }};
}

} // namespace sandglass
