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

constexpr double seriesEnd = 0.1;
constexpr double inverses[] = {1.0,     1.0,     1.0 / 2, 1.0 / 3, 1.0 / 4,  1.0 / 5,
                               1.0 / 6, 1.0 / 7, 1.0 / 8, 1.0 / 9, 1.0 / 10, 1.0 / 11};

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
    FieldBlock::Column q, share{};
    SANDGLASS_GRAINS(i) {
      const double r = b.radius[i];
      q[i] = (given + stokes * (r * r * r)) * rate * b.inverseMass[i] / (r * r);
    }
    if (!explicit_) SANDGLASS_GRAINS(i) {
        // (1 - e^-q) / q by its series: to 1e-16 for small q, where the difference would lose digits
        const double x = -q[i];
        double sum = 1.0;
        for (int k = 11; k >= 2; --k)
          sum = 1.0 + sum * (x * inverses[k]);
        share[i] = sum;
      }
    bool far = false;
    for (int i = 0; i < FieldBlock::capacity && !explicit_; ++i)
      far = far || q[i] > seriesEnd;
    if (far) SANDGLASS_GRAINS(i) {
        const double exact = (1.0 - exponential(-q[i])) / (q[i] > seriesEnd ? q[i] : 1.0);
        share[i] = q[i] > seriesEnd ? exact : share[i];
      }
    const bool plain = explicit_;
    SANDGLASS_GRAINS(i) {
      // The source turns with the contacts' torque first and damps what comes out: 1 - q of it.
      const double keep = plain ? 1.0 - q[i] : share[i], damp = plain ? q[i] : q[i] * share[i];
      const double back = damp / (rate * b.inverseMass[i]);
      b.turnX[i] = keep * b.turnX[i] - b.rollX[i] * back;
      b.turnY[i] = keep * b.turnY[i] - b.rollY[i] * back;
      b.turnZ[i] = keep * b.turnZ[i] - b.rollZ[i] * back;
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
