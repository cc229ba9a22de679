// The watch that the soft-sphere solver keeps on itself: overlaps, speeds, escapes, free places.

#include "sim/base/error.h"
#include "sim/solvers/dem/dem_solver.h"

#include <fmt/format.h>

#include <cmath>

namespace sandglass {

void DemSolver::checkOverlap(const DeepestOverlap& deepest) const {
  if (deepest.share <= scene_.accuracy.maximumOverlap) return;
  if (deepest.share == DeepestOverlap::crowded)
    throw RunError(fmt::format("at {:.6g} s (step {}) grain {} touches the wall '{}' in more than {} places "
                               "at once, more than can be "
                               "kept; make the mesh coarser or raise its smooth_angle",
                               time(), step_, deepest.idA, walls_[deepest.wall].name,
                               walls_[deepest.wall].shape->mostTouches()));
  if (deepest.share == DeepestOverlap::passing)
    throw RunError(fmt::format(
        "at {:.6g} s (step {}) grain {} overlaps the wall '{}' by more than {:.0f} % of its "
        "radius, whatever maximum_overlap allows grains: once its centre has passed, the wall "
        "would push it out on the other side; stiffen the contact or lower the speeds",
        time(), step_, deepest.idA, walls_[deepest.wall].name, 100 * DeepestOverlap::aboutToPass));
  const std::string partner = deepest.idB >= 0 ? fmt::format("grain {}", deepest.idB)
                                               : fmt::format("wall '{}'", walls_[deepest.wall].name);
  throw RunError(fmt::format(
      "at {:.6g} s (step {}) grain {} and {} overlap by {:.0f} % of the smaller radius, above the {:.0f} % "
      "of maximum_overlap; stiffen the contact, lower the speeds or raise maximum_overlap",
      time(), step_, deepest.idA, partner, 100 * deepest.share, 100 * scene_.accuracy.maximumOverlap));
}

void DemSolver::reportBadMotion() const {
  for (std::int32_t i : idOrder()) {
    const Vec3 v = grains_.motion[i].vec();
    if (!v.allFinite() || !grains_.place[i].vec().allFinite())
      throw RunError(fmt::format(
          "at {:.6g} s (step {}) the position or velocity of grain {} is not a number; the step is too "
          "long or a force has no bound: lower time_step",
          time(), step_, grains_.id[i]));
    if (v.norm() * dt_ > scene_.accuracy.maximumTravel * smallestRadius_)
      throw RunError(fmt::format(
          "at {:.6g} s (step {}) grain {} moves {:.3g} m in one step, more than {:g} times the smallest "
          "radius "
          "({:.3g} m, accuracy.maximum_travel), and could jump over a contact; lower time_step",
          time(), step_, grains_.id[i], v.norm() * dt_, scene_.accuracy.maximumTravel, smallestRadius_));
  }
  throw RunError(
      fmt::format("at {:.6g} s (step {}) the motion of a grain went out of bounds", time(), step_));
}

void DemSolver::checkEscapes() const {
  const Sector& sector = across_.sector();
  for (int k = 0; k < 3; ++k) {
    if (scene_.domain.periodic[k]) continue;
    const double low = scene_.domain.lower[k], high = scene_.domain.upper[k];
    for (std::size_t i = 0; i < grains_.size(); ++i) {
      double x = grains_.place[i].vec()[k];
      if (x >= low && x <= high) continue;
      x = sector.turned(grains_.place[i].vec(), -sector.numberOf(grains_.place[i].vec()))[k];
      if (x >= low && x <= high) continue; // beyond a face of the wedge
      throw RunError(fmt::format(
          "at {:.6g} s (step {}) grain {} left the domain: {} = {:.6g} m is outside {:.6g} ... {:.6g} m; "
          "close the walls, widen the domain or add an outlet",
          time(), step_, grains_.id[i], "xyz"[k], x, low, high));
    }
  }
}

bool DemSolver::isFree(const Vec3& position, double radius) const {
  for (const SolverWall& w : walls_) {
    if (!w.active) continue;
    WallShape::Touches touches;
    w.touches(position, radius, touches);
    if (touches.count > 0 || w.shape->signedDistance(w.pose.toBody(position)) < 0.0) return false;
  }
  const Vec3 extent = scene_.domain.upper - scene_.domain.lower;
  const Sector& sector = across_.sector();
  if (sector.numberOf(position) != 0 || sector.radius(position) < radius * sector.coreRadius()) return false;
  double largest = 0.0;
  for (std::size_t i = 0; i < grains_.size() && !sector.whole(); ++i)
    largest = std::max(largest, grains_.place[i].w + grains_.listed[i].w); // it may be beyond a face
  std::vector<Vec3> images;
  sector.eachImage(position, radius + largest,
                   [&](int turn) { images.push_back(sector.turned(position, turn)); });
  for (std::size_t i = 0; i < grains_.size(); ++i) {
    const Quad& q = grains_.place[i];
    for (const Vec3& image : images)
      if ((q.vec() - image).squaredNorm() < (q.w + radius) * (q.w + radius)) return false;
    Vec3 d = q.vec() - position;
    for (int k = 0; k < 3; ++k)
      if (scene_.domain.periodic[k]) d[k] -= extent[k] * std::round(d[k] / extent[k]);
    const double reach = q.w + radius;
    if (d.squaredNorm() < reach * reach) return false;
  }
  return true;
}

} // namespace sandglass
