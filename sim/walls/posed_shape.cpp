#include "sim/walls/posed_shape.h"

#include <limits>

namespace sandglass {

namespace {

using Box = Eigen::AlignedBox3d;

/// Box around a box that is carried along; without bounds where it is turned and had none.
template <class Carry> Box carried(const Box& box, bool turned, Carry&& carry) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  if (!box.min().allFinite() || !box.max().allFinite()) {
    if (turned) return {Vec3::Constant(-inf), Vec3::Constant(inf)};
    const Vec3 shift = carry(Vec3::Zero());
    return {box.min() + shift, box.max() + shift};
  }
  Box all;
  for (int corner = 0; corner < 8; ++corner)
    all.extend(carry(box.corner(static_cast<Box::CornerType>(corner))));
  return all;
}

} // namespace

void PosedShape::touches(const Vec3& centre, double reach, Touches& out) const {
  const int first = out.count;
  atRest_->touches(pose_.toBody(centre), reach, out);
  for (int k = first; k < out.count; ++k)
    out.at[k].normal = pose_.directionToSpace(out.at[k].normal);
}

Box PosedShape::bounds() const {
  return carried(atRest_->bounds(), pose_.turned, [&](const Vec3& x) { return pose_.toSpace(x); });
}

TriangleMesh PosedShape::mesh(const Box& clip) const {
  TriangleMesh mesh =
      atRest_->mesh(carried(clip, pose_.turned, [&](const Vec3& x) { return pose_.toBody(x); }));
  for (Vec3& p : mesh.points)
    p = pose_.toSpace(p);
  return mesh;
}

std::shared_ptr<const WallShape> posed(const std::shared_ptr<const WallShape>& shape, const WallPose& pose) {
  if (pose.atRest()) return shape;
  return std::make_shared<PosedShape>(shape, pose);
}

} // namespace sandglass
