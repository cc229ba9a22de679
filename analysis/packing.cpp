#include "analysis/packing.h"

#include "analysis/grain_sizes.h"
#include "analysis/statistics.h"
#include "sim/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace sandglass::analysis {

double sphereSlabVolume(double radius, double h, double low, double high) {
  // Integral of pi (R^2 - z^2) over the slab's part of [-R, R].
  const double a = std::clamp(low - h, -radius, radius), b = std::clamp(high - h, -radius, radius);
  return std::numbers::pi * (radius * radius * (b - a) - (b * b * b - a * a * a) / 3);
}

void PackingProfile::add(const Frame& frame) {
  const auto& radius = frame.scalar(quantity::radius);
  if (options_.diameter <= 0) options_.diameter = meanDiameter(frame);
  const Vec3 up = options_.up.normalized();
  RegionOptions regionOptions = options_.region;
  regionOptions.clearance = 0;
  regionOptions.up = up;
  regionOptions.freeSurface = false;
  regionOptions.diameter = options_.diameter;
  const Region region(frame, regionOptions);

  // Heights of the container.
  double low = std::numeric_limits<double>::infinity(), high = -low, period = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const double h = region.box().corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)).dot(up);
    low = std::min(low, h);
    high = std::max(high, h);
  }
  for (int k = 0; k < 3; ++k)
    if (frame.domain.periodic[k] && std::abs(up[k]) == 1 && std::isinf(options_.region.lower[k]) &&
        std::isinf(options_.region.upper[k]))
      period = high - low;

  if (container_.empty()) {
    const double wish = options_.slabHeight > 0 ? options_.slabHeight : 0.5 * options_.diameter;
    const int slabs = std::clamp(static_cast<int>(std::lround((high - low) / wish)), 1, 100000);
    from_ = low;
    width_ = (high - low) / slabs;
    container_ = region.slabVolumes(up, from_, width_, slabs, options_.seed);
    regionText_ = region.description();
  }
  const int slabs = static_cast<int>(container_.size());

  std::vector<double> solid(slabs);
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const double h = frame.position[i].dot(up), r = radius[i];
    bool inside = true;
    for (int k = 0; k < 3; ++k)
      if (std::abs(up[k]) != 1)
        inside = inside && frame.position[i][k] >= options_.region.lower[k] &&
                 frame.position[i][k] <= options_.region.upper[k];
    if (!inside) continue;
    const int first = static_cast<int>(std::floor((h - r - from_) / width_));
    const int last = static_cast<int>(std::floor((h + r - from_) / width_));
    for (int s = first; s <= last; ++s) {
      int slab = s;
      if (period > 0) slab = ((s % slabs) + slabs) % slabs;
      if (slab < 0 || slab >= slabs) continue;
      solid[slab] += sphereSlabVolume(r, h, from_ + s * width_, from_ + (s + 1) * width_);
    }
  }

  double top = high;
  if (period == 0) {
    auto heights = FreeSurface(frame, up, 1.5 * options_.diameter, options_.diameter).heights();
    std::erase_if(heights, [](double h) { return !std::isfinite(h); });
    std::sort(heights.begin(), heights.end());
    top = heights.empty() ? low : heights[heights.size() / 10] - 2 * options_.diameter;
  }
  double grains = 0, space = 0;
  for (int s = 0; s < slabs; ++s)
    if (from_ + (s + 1) * width_ <= top + 1e-9 * width_) {
      grains += solid[s];
      space += container_[s].value;
    }
  bulk_.push_back(space > 0 ? grains / space : std::numeric_limits<double>::quiet_NaN());
  solid_.push_back(std::move(solid));
}

Curve PackingProfile::result() const {
  if (solid_.empty()) throw InputError("the packing fraction needs at least one frame");
  Curve curve;
  curve.name = "packing";
  curve.title = "Packing fraction by height";
  curve.x = {"height", "m"};
  curve.y = {"packing fraction", ""};
  curve.frames = solid_.size();
  curve.definition = fmt::format("exact volumes of sphere slices in slabs of {:.4g} m over the container's; "
                                 "{}; bulk: to 2 diameters below the surface",
                                 width_, regionText_);
  Series series{"packing", {}, {}, {}};
  double spaceError = 0, space = 0;
  for (std::size_t s = 0; s < container_.size(); ++s) {
    const double volume = container_[s].value;
    if (!(volume > 0)) continue;
    std::vector<double> phi;
    for (const auto& solid : solid_)
      phi.push_back(solid[s] / volume);
    const double value = mean(phi), sampling = value * container_[s].error / volume;
    series.x.push_back(from_ + (static_cast<double>(s) + 0.5) * width_);
    series.y.push_back(value);
    series.error.push_back(phi.size() >= 4 ? std::hypot(sampling, blockedStandardError(phi)) : sampling);
    space += volume;
    spaceError = std::hypot(spaceError, container_[s].error);
  }
  curve.series.push_back(std::move(series));

  std::vector<double> bulk;
  for (const double b : bulk_)
    if (std::isfinite(b)) bulk.push_back(b);
  curve.numbers["diameter"] = options_.diameter;
  if (!bulk.empty()) {
    const double value = mean(bulk), sampling = value * spaceError / space;
    curve.numbers["packing_bulk"] = value;
    curve.numbers["packing_bulk_error"] =
        bulk.size() >= 4 ? std::hypot(sampling, blockedStandardError(bulk)) : sampling;
    curve.marks.push_back({"bulk", value, false});
  }
  return curve;
}

} // namespace sandglass::analysis
