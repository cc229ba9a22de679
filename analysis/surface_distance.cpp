#include "analysis/surface_distance.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace sandglass::analysis {

SurfaceDistance::SurfaceDistance(const Frame& frame, double diameter, double reach)
    : domain_(frame.domain), grid_(frame.position, frame.domain, 0.75 * diameter), reach_(reach) {
  const auto* radii = frame.has(quantity::radius) ? &frame.scalar(quantity::radius) : nullptr;
  double least = diameter;
  for (std::size_t s = 0; s < grid_.size(); ++s) {
    radius_.push_back(radii ? (*radii)[grid_.original(s)] : 0.5 * diameter);
    largest_ = std::max(largest_, radius_.back());
    least = std::min(least, radius_.back());
  }
  equal_ = grid_.size() == 0 || largest_ - least < 1e-6 * largest_;
  for (const auto& wall : frame.walls)
    if (wall.active) walls_.push_back(wall.shape);
}

Vec3 SurfaceDistance::wrapped(Vec3 x) const {
  for (int k = 0; k < 3; ++k)
    if (domain_.periodic[k]) {
      const double length = domain_.upper[k] - domain_.lower[k];
      x[k] -= length * std::floor((x[k] - domain_.lower[k]) / length);
    }
  return x;
}

SurfaceDistance::Nearest SurfaceDistance::toGrains(const Vec3& point, double enough) const {
  const Vec3 x = wrapped(point);
  const auto axes = grid_.axes();
  const std::array<double, 3> c{x[axes[0]], x[axes[1]], x[axes[2]]};
  const double *px = grid_.coordinates(0), *py = grid_.coordinates(1), *pz = grid_.coordinates(2);
  Nearest nearest{reach_, Vec3::Zero()};
  // A small ball first: most points of a packing have a surface within 0.4 radii. Then as far as a larger
  // grain may still have a nearer surface.
  for (double search = std::min(1.4 * largest_, largest_ + reach_);;) {
    double best = reach_;
    std::array<double, 3> away{};
    grid_.around(c, search, -1, [&](std::size_t begin, std::size_t end, const auto& shift) {
      if (best < enough) return;
      const double cx = c[0] - shift[0], cy = c[1] - shift[1], cz = c[2] - shift[2];
      for (std::size_t s = begin; s < end; ++s) {
        const double dx = cx - px[s], dy = cy - py[s], dz = cz - pz[s];
        const double d2 = dx * dx + dy * dy + dz * dz, most = best + radius_[s];
        if (d2 >= most * most) continue;
        best = std::sqrt(d2) - radius_[s];
        away = {dx, dy, dz};
      }
    });
    const double needed = std::min(best, reach_) + largest_;
    if (best < enough || needed <= search * (1 + 1e-12)) {
      nearest.distance = best;
      if (best < reach_)
        for (int k = 0; k < 3; ++k)
          nearest.away[axes[k]] = away[k];
      if (nearest.away.squaredNorm() > 0) nearest.away.normalize();
      return nearest;
    }
    search = best < reach_ ? needed : std::min(2 * search, largest_ + reach_);
  }
}

void SurfaceDistance::grainsAbout(const Vec3& point, double reach,
                                  std::vector<std::array<double, 4>>& grains) const {
  grains.clear();
  const Vec3 x = wrapped(point);
  const auto axes = grid_.axes();
  const std::array<double, 3> c{x[axes[0]], x[axes[1]], x[axes[2]]};
  grid_.around(c, reach, -1, [&](std::size_t begin, std::size_t end, const auto& shift) {
    for (std::size_t s = begin; s < end; ++s) {
      Vec3 apart;
      for (int k = 0; k < 3; ++k)
        apart[axes[k]] = grid_.coordinates(k)[s] + shift[k] - c[k];
      if (apart.squaredNorm() > reach * reach) continue;
      const Vec3 centre = point + apart;
      grains.push_back({centre.x(), centre.y(), centre.z(), radius_[s]});
    }
  });
}

double SurfaceDistance::toWalls(const Vec3& point) const {
  double distance = reach_;
  if (walls_.empty()) return distance;
  const Vec3 x = wrapped(point);
  for (const auto& wall : walls_)
    distance = std::min(distance, wall->signedDistance(x));
  return distance;
}

namespace {

/// Fourteen directions, turned a little more at each try, so that in the end every direction is tried.
class Compass {
public:
  Compass() {
    int n = 0;
    for (int k = 0; k < 3; ++k)
      for (const double s : {-1.0, 1.0})
        direction_[static_cast<std::size_t>(n++)] = s * Vec3::Unit(k);
    for (int k = 0; k < 8; ++k)
      direction_[static_cast<std::size_t>(n++)] =
          Vec3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1) / std::sqrt(3.0);
  }
  const std::array<Vec3, 14>& next() {
    static const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(0.7, Vec3(0.3, 0.5, 0.81).normalized()).toRotationMatrix();
    for (Vec3& d : direction_)
      d = turn * d;
    return direction_;
  }

private:
  std::array<Vec3, 14> direction_;
};

/// The distance to the grains in a small place, for many looks there: a list of the grains about.
class Vicinity {
public:
  Vicinity(const SurfaceDistance& distance, const Vec3& about, double diameter)
      : distance_(distance), about_(about), reach_(1.6 * diameter) {
    distance_.grainsAbout(about, reach_, grains_);
  }
  SurfaceDistance::Nearest toGrains(const Vec3& x, double enough = 0) const {
    double best = distance_.reach();
    const std::array<double, 4>* nearest = nullptr;
    for (const auto& grain : grains_) {
      const double dx = x[0] - grain[0], dy = x[1] - grain[1], dz = x[2] - grain[2];
      const double d2 = dx * dx + dy * dy + dz * dz, most = best + grain[3];
      if (d2 >= most * most) continue;
      best = std::sqrt(d2) - grain[3];
      nearest = &grain;
      if (best < enough) break;
    }
    // No grain beyond the list may be nearer.
    const bool known =
        nearest && (best < enough || (x - about_).norm() + best + distance_.largestRadius() <= reach_);
    if (!known) return distance_.toGrains(x, enough);
    const Vec3 away(x[0] - (*nearest)[0], x[1] - (*nearest)[1], x[2] - (*nearest)[2]);
    return {best, away.normalized()};
  }

private:
  const SurfaceDistance& distance_;
  Vec3 about_;
  double reach_;
  std::vector<std::array<double, 4>> grains_;
};

/// Uphill from x while the sphere contains `inside` (anything, when there is none).
EmptySphere ascend(const SurfaceDistance& distance, const Region& region, Vec3 x, const Vec3* inside,
                   double firstStep, double tolerance) {
  Compass compass;
  const Vicinity vicinity(distance, x, 2 * distance.largestRadius());
  double value = distance(x), step = firstStep;
  Vec3 away = distance.toGrains(x).away;
  const auto tryAt = [&](const Vec3& c, double most) {
    // A try that is no better than what there is need not be known exactly.
    const double v = std::min(vicinity.toGrains(c, most).distance, distance.toWalls(c));
    return v > most && region.contains(c) && (!inside || (c - *inside).squaredNorm() <= v * v) ? v : most;
  };
  // The distance has kinks, and that is where its maxima are: directions are tried, and steps halved when
  // none of two sets helps.
  for (int failed = 0; step > tolerance;) {
    Vec3 best = x;
    double most = value;
    const auto attempt = [&](const Vec3& c) {
      if (const double v = tryAt(c, most); v > most) most = v, best = c;
    };
    attempt(x + step * away);
    if (inside && (x - *inside).squaredNorm() > 0) attempt(x + step * (x - *inside).normalized());
    if (most == value)
      for (const Vec3& d : compass.next())
        attempt(x + step * d);
    if (most > value) {
      x = best;
      value = most;
      away = vicinity.toGrains(x).away;
      failed = 0;
    } else if (++failed == 2) {
      step *= 0.5;
      failed = 0;
    }
  }
  return {distance.wrapped(x), value, distance.toWalls(x) <= distance.toGrains(x).distance + 4 * tolerance};
}

} // namespace

EmptySphere climb(const SurfaceDistance& distance, const Region& region, const Vec3& x, double firstStep,
                  double tolerance) {
  return ascend(distance, region, x, nullptr, firstStep, tolerance);
}

EmptySphere climbAbout(const SurfaceDistance& distance, const Region& region, const Vec3& inside,
                       double firstStep, double tolerance) {
  return ascend(distance, region, inside, &inside, firstStep, tolerance);
}

} // namespace sandglass::analysis
