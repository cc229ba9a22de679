#pragma once
// A wall's shape where its motion has carried it, for frames: whoever draws or measures need not know of
// motion.

#include "sim/walls/wall_pose.h"
#include "sim/walls/wall_shape.h"

namespace sandglass {

class PosedShape final : public WallShape {
public:
  PosedShape(std::shared_ptr<const WallShape> atRest, const WallPose& pose)
      : atRest_(std::move(atRest)), pose_(pose) {}

  int mostTouches() const override { return atRest_->mostTouches(); }
  void touches(const Vec3& centre, double reach, Touches& out) const override;
  double signedDistance(const Vec3& x) const override { return atRest_->signedDistance(pose_.toBody(x)); }
  Eigen::AlignedBox3d bounds() const override;
  TriangleMesh mesh(const Eigen::AlignedBox3d& clip) const override;

private:
  std::shared_ptr<const WallShape> atRest_;
  WallPose pose_;
};

/// The shape itself where the pose is that of rest.
std::shared_ptr<const WallShape> posed(const std::shared_ptr<const WallShape>& shape, const WallPose& pose);

} // namespace sandglass
