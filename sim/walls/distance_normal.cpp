#include "sim/walls/distance_normal.h"

namespace sandglass {

namespace {

class DistanceNormal final : public WallShape {
public:
  DistanceNormal(std::shared_ptr<const WallShape> tube, const Vec3& base, const Vec3& axis, double radius,
                 double height)
      : tube_(std::move(tube)), base_(base), axis_(axis.normalized()), radius_(radius), height_(height) {}

  void touches(const Vec3& centre, double reach, Touches& out) const override {
    const double h = (centre - base_).dot(axis_);
    const Vec3 away = centre - base_ - h * axis_;
    const double distance = radius_ - away.norm();
    if (h < 0.0 || h > height_ || distance >= reach) return;
    out.add({distance, -away / centre.norm(), 0});
  }
  bool pushesBack() const override { return true; }
  double signedDistance(const Vec3& x) const override { return tube_->signedDistance(x); }
  /// Wider than the tube, so that grains beyond it are found.
  Eigen::AlignedBox3d bounds() const override {
    Eigen::AlignedBox3d box = tube_->bounds();
    return {box.min() - Vec3::Constant(radius_), box.max() + Vec3::Constant(radius_)};
  }
  TriangleMesh mesh(const Eigen::AlignedBox3d& clip) const override { return tube_->mesh(clip); }

private:
  std::shared_ptr<const WallShape> tube_;
  Vec3 base_, axis_;
  double radius_, height_;
};

} // namespace

std::shared_ptr<const WallShape> withDistanceNormal(std::shared_ptr<const WallShape> tube, const Vec3& base,
                                                    const Vec3& axis, double radius, double height) {
  return std::make_shared<DistanceNormal>(std::move(tube), base, axis, radius, height);
}

} // namespace sandglass
