// Rankine's vortex: a core that turns as a solid body, free of vorticity outside (W. J. M. Rankine, A Manual
// of Applied Mechanics, 1858):  u_t = omega r for r < a,  omega a^2 / r beyond.

#include "sim/fields/field.h"
#include "sim/fields/field_kinds.h"

namespace sandglass {

namespace {

class RankineVortex final : public Field {
public:
  explicit RankineVortex(const Parameters& p)
      : point_(p.vector("point")), axis_(unitAxis(p)), rate_(p.number("angular_velocity")),
        core_(p.number("core_radius")) {}

  void apply(FieldBlock& b, double factor) const override {
    const double rate = factor * rate_, core = core_ * core_;
    const double nx = axis_.x(), ny = axis_.y(), nz = axis_.z();
    const double px = point_.x(), py = point_.y(), pz = point_.z();
    SANDGLASS_GRAINS(i) {
      const double x = b.x[i] - px, y = b.y[i] - py, z = b.z[i] - pz;
      const double tx = ny * z - nz * y, ty = nz * x - nx * z, tz = nx * y - ny * x; // length r
      const double square = tx * tx + ty * ty + tz * tz;
      const double turn = square > core ? rate * core / square : rate;
      b.flowX[i] += turn * tx;
      b.flowY[i] += turn * ty;
      b.flowZ[i] += turn * tz;
    }
  }

  double topSpeed(const Domain&) const override { return std::abs(rate_) * core_; }

private:
  Vec3 point_, axis_;
  double rate_, core_;
};

} // namespace

FieldKind rankineVortexField() {
  return {"rankine_vortex",
          FieldRole::flow,
          "a vortex with a core that turns as a solid body and a flow free of vorticity outside",
          "a few operations a grain and step",
          {vortexPoint(), vortexAxis(), fieldNumber("angular_velocity", "rad/s", "of its core", -1e6),
           fieldNumber("core_radius", "m", "radius of its core", 0, true)},
          [](const Parameters& p) { return std::make_unique<RankineVortex>(p); }};
}

} // namespace sandglass
