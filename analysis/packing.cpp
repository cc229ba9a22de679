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

namespace {

RegionOptions containerOptions(const PackingOptions& options) {
  RegionOptions container = options.region;
  container.clearance = 0;
  container.up = options.up.normalized();
  container.freeSurface = false;
  return container;
}

/// Lowest and highest height of a box.
std::pair<double, double> heights(const Eigen::AlignedBox3d& box, const Vec3& up) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (int corner = 0; corner < 8; ++corner) {
    const double h = box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)).dot(up);
    low = std::min(low, h);
    high = std::max(high, h);
  }
  return {low, high};
}

/// The period along `up` where the whole of it is looked at, else 0.
double wholePeriod(const Frame& frame, const PackingOptions& options, const Vec3& up) {
  for (int k = 0; k < 3; ++k)
    if (frame.domain.periodic[k] && std::abs(up[k]) == 1 && std::isinf(options.region.lower[k]) &&
        std::isinf(options.region.upper[k]))
      return frame.domain.upper[k] - frame.domain.lower[k];
  return 0;
}

} // namespace

/// Makes slabs up to `top` at least. The box is cut there, so that no points are spent on empty space above.
void PackingProfile::extend(const Frame& frame, double top) {
  const Vec3 up = options_.up.normalized();
  RegionOptions container = containerOptions(options_);
  const Region whole(frame, container);
  const auto [low, high] = heights(whole.box(), up);
  const double period = wholePeriod(frame, options_, up);
  if (container_.empty()) {
    from_ = low;
    width_ = options_.slabHeight > 0 ? options_.slabHeight : 0.5 * options_.diameter;
    if (period > 0) width_ = period / std::max(1.0, std::round(period / width_));
    regionText_ = whole.description();
  }
  const double needed = period > 0 ? period : std::min(top, high) - from_;
  const auto slabs = static_cast<std::size_t>(std::clamp(std::ceil(needed / width_ - 1e-9), 1.0, 1e6));
  if (slabs <= container_.size()) return;
  if (period == 0)
    for (int k = 0; k < 3; ++k) {
      const double end = from_ + static_cast<double>(slabs) * width_;
      if (up[k] == 1) container.upper[k] = std::min(container.upper[k], end);
      if (up[k] == -1) container.lower[k] = std::max(container.lower[k], -end);
    }
  container_ =
      Region(frame, container).slabVolumes(up, from_, width_, static_cast<int>(slabs), options_.seed);
}

void PackingProfile::add(const Frame& frame) {
  const auto& radius = frame.scalar(quantity::radius);
  if (options_.diameter <= 0) options_.diameter = meanDiameter(frame);
  const Vec3 up = options_.up.normalized();
  double top = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < frame.size(); ++i)
    top = std::max(top, frame.position[i].dot(up) + radius[i]);
  extend(frame, top);
  const double period = wholePeriod(frame, options_, up);
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
      const int slab = period > 0 ? ((s % slabs) + slabs) % slabs : s;
      if (slab >= 0 && slab < slabs)
        solid[slab] += sphereSlabVolume(r, h, from_ + s * width_, from_ + (s + 1) * width_);
    }
  }

  double end = std::numeric_limits<double>::infinity();
  if (period == 0) {
    auto surface = FreeSurface(frame, up, 1.5 * options_.diameter, options_.diameter).heights();
    std::erase_if(surface, [](double h) { return !std::isfinite(h); });
    std::sort(surface.begin(), surface.end());
    end = surface.empty() ? from_ : surface[surface.size() / 10] - 2 * options_.diameter;
  }
  double grains = 0, space = 0;
  for (int s = 0; s < slabs; ++s)
    if (from_ + (s + 1) * width_ <= end) {
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
      phi.push_back(s < solid.size() ? solid[s] / volume : 0);
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
