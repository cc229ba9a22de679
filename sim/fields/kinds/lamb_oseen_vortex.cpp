// The vortex of Lamb and Oseen, a line of vorticity that viscosity widens (H. Lamb, Hydrodynamics, 6th ed.,
// section 334a):  u_t = Gamma / (2 pi r) (1 - exp(-r^2 / a^2)),  a^2 = a_0^2 + 4 nu t.

#include "sim/fields/field.h"
#include "sim/fields/field_kinds.h"
#include "sim/math/exponential.h"

#include <numbers>

namespace sandglass {

namespace {

class LambOseenVortex final : public Field {
public:
  explicit LambOseenVortex(const Parameters& p)
      : point_(p.vector("point")), axis_(unitAxis(p)), circulation_(p.number("circulation")),
        core_(p.number("core_radius")), viscosity_(p.number("kinematic_viscosity")) {}

  void apply(FieldBlock& b, double factor) const override {
    const double inverse = 1.0 / (core_ * core_ + 4.0 * viscosity_ * b.time);
    const double middle = factor * circulation_ / (2.0 * std::numbers::pi) * inverse; // rate at the axis
    const double nx = axis_.x(), ny = axis_.y(), nz = axis_.z();
    const double px = point_.x(), py = point_.y(), pz = point_.z();
    SANDGLASS_GRAINS(i) {
      const double x = b.x[i] - px, y = b.y[i] - py, z = b.z[i] - pz;
      const double tx = ny * z - nz * y, ty = nz * x - nx * z, tz = nx * y - ny * x; // length r
      const double s = (tx * tx + ty * ty + tz * tz) * inverse;
      // (1 - e^-s) / s, by its series near the axis, where the difference would lose digits
      const double near = 1.0 - s * (1.0 / 2) * (1.0 - s * (1.0 / 3) * (1.0 - s * (1.0 / 4)));
      const double far = (1.0 - exponential(-s)) / (s > 1e-3 ? s : 1.0);
      const double turn = middle * (s > 1e-3 ? far : near);
      b.flowX[i] += turn * tx;
      b.flowY[i] += turn * ty;
      b.flowZ[i] += turn * tz;
    }
  }

  /// The maximum of (1 - exp(-q^2)) / q is 0.638, at q = 1.121.
  double topSpeed(const Domain&) const override {
    return 0.6382 * std::abs(circulation_) / (2.0 * std::numbers::pi * core_);
  }

private:
  Vec3 point_, axis_;
  double circulation_, core_, viscosity_;
};

} // namespace

FieldKind lambOseenVortexField() {
  return {"lamb_oseen_vortex",
          FieldRole::flow,
          "a vortex that viscosity widens as time goes on",
          "an exponential a grain and step",
          {vortexPoint(), vortexAxis(), fieldNumber("circulation", "m^2/s", "around all of it", -1e12),
           fieldNumber("core_radius", "m", "a, at the start of the run", 0, true),
           fieldNumber("kinematic_viscosity", "m^2/s", "of the fluid; 0: the core stays", 0, false, 0.0)},
          [](const Parameters& p) { return std::make_unique<LambOseenVortex>(p); }};
}

} // namespace sandglass
