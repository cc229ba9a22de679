// A fluid that turns as a solid body:  u = omega x (x - p).

#include "sim/fields/field.h"
#include "sim/fields/field_kinds.h"

namespace sandglass {

namespace {

class SolidBodyVortex final : public Field {
public:
  explicit SolidBodyVortex(const Parameters& p)
      : point_(p.vector("point")), spin_(p.number("angular_velocity") * unitAxis(p)) {}

  void apply(FieldBlock& b, double factor) const override {
    const double wx = factor * spin_.x(), wy = factor * spin_.y(), wz = factor * spin_.z();
    const double px = point_.x(), py = point_.y(), pz = point_.z();
    SANDGLASS_GRAINS(i) {
      const double x = b.x[i] - px, y = b.y[i] - py, z = b.z[i] - pz;
      b.flowX[i] += wy * z - wz * y;
      b.flowY[i] += wz * x - wx * z;
      b.flowZ[i] += wx * y - wy * x;
    }
  }

  double topSpeed(const Domain& domain) const override {
    const Eigen::AlignedBox3d box(domain.lower, domain.upper);
    double fastest = 0.0;
    for (int corner = 0; corner < 8; ++corner)
      fastest = std::max(
          fastest,
          spin_.cross(box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)) - point_).norm());
    return fastest;
  }

private:
  Vec3 point_, spin_;
};

} // namespace

FieldKind solidBodyVortexField() {
  return {"solid_body_vortex",
          FieldRole::flow,
          "a fluid that turns as a solid body",
          "a few operations a grain and step",
          {vortexPoint(), vortexAxis(), fieldNumber("angular_velocity", "rad/s", "at which it turns", -1e6)},
          [](const Parameters& p) { return std::make_unique<SolidBodyVortex>(p); }};
}

} // namespace sandglass
