#include "analysis/region.h"

#include "analysis/quasi_random.h"
#include "sim/base/error.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace sandglass::analysis {

namespace {
constexpr int shifts = 16;
constexpr std::uint64_t pointsPerShift = 65536;
} // namespace

Region::Region(const Frame& frame, const RegionOptions& options) : domain_(frame.domain), options_(options) {
  for (const auto& wall : frame.walls)
    if (wall.active) walls_.push_back(wall.shape);
  if (options.up && options.freeSurface) {
    if (!(options.diameter > 0))
      throw InputError("the free surface needs the mean grain diameter, which is 0: give a diameter");
    const double width = options.columnWidth > 0 ? options.columnWidth : 1.5 * options.diameter;
    surface_ = std::make_shared<FreeSurface>(frame, *options.up, width, options.diameter);
  }

  // Non-periodic domain bounds merely enclose what is there; walls with finite extents and the user narrow
  // them.
  Vec3 lower = domain_.lower.cwiseMax(options.lower), upper = domain_.upper.cwiseMin(options.upper);
  if (surface_) {
    // Cut the box at the surface where up is a coordinate axis.
    for (int k = 0; k < 3; ++k) {
      const double along = surface_->axes().up[k];
      if (domain_.periodic[k] || std::abs(along) != 1) continue;
      const double top = surface_->highest() - options.surfaceMargin;
      // Without any surface (no grain at rest on others) the box is empty.
      if (along > 0)
        upper[k] = std::max(lower[k], std::min(upper[k], top));
      else
        lower[k] = std::min(upper[k], std::max(lower[k], -top));
    }
  }
  if (options.up && options.closeGates) {
    const Vec3 up = options.up->normalized();
    for (const auto& wall : frame.walls) {
      const bool gate =
          std::find(options.gates.begin(), options.gates.end(), wall.name) != options.gates.end();
      if (wall.active && !gate) continue;
      const Eigen::AlignedBox3d bounds = wall.shape->bounds();
      for (int k = 0; k < 3; ++k) {
        if (std::abs(up[k]) != 1) continue;
        // From the gate's highest point on, and as far from it as from other walls.
        const double floor = (up[k] > 0 ? bounds.max()[k] : -bounds.min()[k]) + options.clearance;
        if (!std::isfinite(floor)) continue;
        if (up[k] > 0)
          lower[k] = std::max(lower[k], floor);
        else
          upper[k] = std::min(upper[k], -floor);
      }
    }
  }
  upper = upper.cwiseMax(lower);
  if (!lower.allFinite() || !upper.allFinite())
    throw InputError(
        "the frame's domain has no finite bounds, so the volume open to grains is unknown: give limits");
  box_ = Eigen::AlignedBox3d(lower, upper);
}

Vec3 Region::wrapped(Vec3 x) const {
  for (int k = 0; k < 3; ++k)
    if (domain_.periodic[k]) {
      const double length = domain_.upper[k] - domain_.lower[k];
      x[k] -= length * std::floor((x[k] - domain_.lower[k]) / length);
    }
  return x;
}

bool Region::insideBox(const Vec3& x) const {
  const Vec3 w = wrapped(x);
  return (w.array() >= box_.min().array()).all() && (w.array() <= box_.max().array()).all();
}

bool Region::insideWalls(const Vec3& x, double clearance) const {
  if (walls_.empty()) return true;
  const Vec3 w = wrapped(x);
  for (const auto& wall : walls_)
    if (wall->signedDistance(w) < clearance) return false;
  return true;
}

bool Region::belowSurface(const Vec3& x) const {
  return !surface_ || x.dot(surface_->axes().up) <= surface_->heightAt(x) - options_.surfaceMargin;
}

bool Region::containsGrain(const Vec3& x, double radius, double slack) const {
  const double clearance = options_.clearance > 0 ? std::min(radius, options_.clearance) * (1 - slack) : 0;
  return insideBox(x) && insideWalls(x, clearance) && belowSurface(x);
}

double Region::depthInside(const Vec3& x, double reach) const {
  const Vec3 w = wrapped(x);
  double depth = reach;
  for (int k = 0; k < 3; ++k) {
    const bool whole =
        domain_.periodic[k] && box_.min()[k] <= domain_.lower[k] && box_.max()[k] >= domain_.upper[k];
    if (!whole) depth = std::min({depth, w[k] - box_.min()[k], box_.max()[k] - w[k]});
  }
  for (const auto& wall : walls_)
    depth = std::min(depth, wall->signedDistance(w) - options_.clearance);
  if (surface_ && depth > 0)
    depth =
        std::min(depth, surface_->lowestNear(w, depth) - options_.surfaceMargin - w.dot(surface_->axes().up));
  return depth;
}

Volume Region::volume(std::uint64_t seed) const {
  if (walls_.empty() && !surface_) return {box_.volume(), 0};
  const Vec3 up = Vec3::UnitX();
  const double from = box_.min().x(), length = box_.max().x() - from;
  return slabVolumes(up, from, length > 0 ? length : 1, 1, seed).front();
}

std::vector<Volume> Region::slabVolumes(const Vec3& up, double from, double width, int slabs,
                                        std::uint64_t seed) const {
  const Vec3 size = box_.sizes();
  std::vector<std::vector<std::uint64_t>> hits(shifts, std::vector<std::uint64_t>(slabs));
  tbb::parallel_for(0, shifts, [&](int s) {
    const QuasiRandom3 sequence(seed, 0x766f6cULL + s); // items apart from those of shells
    for (std::uint64_t n = 0; n < pointsPerShift; ++n) {
      const auto u = sequence(n);
      const Vec3 x = box_.min() + size.cwiseProduct(Vec3(u[0], u[1], u[2]));
      const double slab = std::floor((x.dot(up) - from) / width);
      // The last slab is closed, so that rounding at the box's end loses nothing.
      const int index = slab == slabs && x.dot(up) <= from + slabs * width * (1 + 1e-12)
                            ? slabs - 1
                            : static_cast<int>(slab);
      if (index >= 0 && index < slabs && contains(x)) ++hits[s][index];
    }
  });
  std::vector<Volume> volumes(slabs);
  for (int b = 0; b < slabs; ++b) {
    std::uint64_t sum = 0;
    for (int s = 0; s < shifts; ++s)
      sum += hits[s][b];
    const double average = static_cast<double>(sum) / shifts;
    double spread = 0;
    for (int s = 0; s < shifts; ++s)
      spread += std::pow(static_cast<double>(hits[s][b]) - average, 2);
    const double unit = size.prod() / static_cast<double>(pointsPerShift);
    volumes[b] = {average * unit, std::sqrt(spread / (shifts - 1) / shifts) * unit};
  }
  return volumes;
}

std::string Region::description() const {
  std::string text = options_.clearance > 0
                         ? fmt::format("centres at least {:.4g} m from walls", options_.clearance)
                         : std::string("the space inside the walls");
  if (surface_) text += fmt::format(", {:.4g} m or more below the free surface", options_.surfaceMargin);
  for (int k = 0; k < 3; ++k) {
    if (std::isfinite(options_.lower[k]))
      text += fmt::format(", {} >= {:.4g} m", "xyz"[k], options_.lower[k]);
    if (std::isfinite(options_.upper[k]))
      text += fmt::format(", {} <= {:.4g} m", "xyz"[k], options_.upper[k]);
  }
  return text;
}

} // namespace sandglass::analysis
