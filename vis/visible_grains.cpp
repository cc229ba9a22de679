#include "vis/visible_grains.h"

#include "analysis/selection.h"
#include "sim/base/error.h"
#include "vis/clip.h"
#include "vis/periodic_images.h"
#include "vis/superellipsoid.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_set>

namespace sandglass::vis {

namespace {

double substituteRadius(const Frame& frame) {
  if (frame.position.empty()) return 0;
  Eigen::AlignedBox3d box;
  for (const auto& p : frame.position)
    box.extend(p);
  const Vec3 size = box.sizes().cwiseMax(1e-3 * box.sizes().maxCoeff());
  const double spacing = std::cbrt(size.prod() / static_cast<double>(frame.size()));
  return spacing > 0 ? spacing / 2 : 1;
}

/// Index into the frame's shapes for each grain, -1 for spheres; empty when all are spheres.
std::vector<std::int32_t> shapesOf(const Frame& frame) {
  if (frame.shapes.empty() || frame.size() == 0) return {};
  std::vector<std::int32_t> result(frame.size(), 0);
  const auto found = frame.scalars.find(quantity::shape);
  const auto last = static_cast<double>(frame.shapes.size()) - 1;
  for (std::size_t i = 0; found != frame.scalars.end() && i < frame.size(); ++i) {
    const double value = found->second[i];
    if (!(value >= -1 && value <= last))
      throw InputError(
          fmt::format("grain {} has the shape {:g}; the frame knows the shapes 0 to {:g}, and -1 "
                      "for a sphere",
                      frame.id[i], value, last));
    result[i] = static_cast<std::int32_t>(value);
  }
  return result;
}

/// One for each chosen grain, zero for the others; empty where nothing is chosen.
std::vector<std::uint8_t> chosenGrains(const Frame& frame, const Selection& selection,
                                       const History* history) {
  std::vector<std::uint8_t> chosen;
  if (!selection.expression.empty())
    chosen = analysis::selectGrains(frame, selection.expression, [&](const std::string& name) {
      return quantityValues(frame, name, history);
    });
  if (selection.grains.empty()) return chosen;
  chosen.resize(frame.size(), 1);
  const std::unordered_set<std::int64_t> named(selection.grains.begin(), selection.grains.end());
  for (std::size_t i = 0; i < chosen.size(); ++i)
    if (!named.contains(i < frame.id.size() ? frame.id[i] : static_cast<std::int64_t>(i))) chosen[i] = 0;
  return chosen;
}

} // namespace

std::vector<double> drawnRadii(const Frame& frame) {
  const auto known = frame.scalars.find(quantity::radius);
  std::vector<double> radii = known != frame.scalars.end()
                                  ? known->second
                                  : std::vector<double>(frame.size(), substituteRadius(frame));
  const auto shape = shapesOf(frame);
  for (std::size_t i = 0; i < shape.size(); ++i)
    if (shape[i] >= 0) radii[i] = surroundingRadius(frame.shapes[static_cast<std::size_t>(shape[i])]);
  return radii;
}

VisibleGrains visibleGrains(const Frame& frame, const View& view, const History* history) {
  VisibleGrains result;
  if (!view.grains) return result;
  const std::vector<std::uint8_t> chosen = chosenGrains(frame, view.selection, history);
  const auto use = view.selection.use;
  const auto isShown = [&](std::size_t i) {
    return chosen.empty() || use == Selection::Use::highlight ||
           (use == Selection::Use::only) == (chosen[i] != 0);
  };
  const std::vector<double> radius = drawnRadii(frame);
  const auto shape = shapesOf(frame);
  result.shapes = frame.shapes;
  for (GrainShape& s : result.shapes)
    s.semiAxes *= view.grainScale;
  const std::vector<Vec3> shifts = imageShifts(frame.domain, view);
  result.index.reserve(shifts.size() * frame.size());
  result.id.reserve(shifts.size() * frame.size());
  result.position.reserve(shifts.size() * frame.size());
  result.radius.reserve(shifts.size() * frame.size());
  for (const Vec3& shift : shifts)
    for (std::size_t i = 0; i < frame.size(); ++i) {
      const Vec3 place = frame.position[i] + shift;
      if (!place.allFinite() || !(radius[i] > 0) || !isShown(i) || isClipped(view, place)) continue;
      result.index.push_back(i);
      result.id.push_back(i < frame.id.size() ? frame.id[i] : static_cast<std::int64_t>(i));
      result.position.push_back(place);
      result.radius.push_back(radius[i] * view.grainScale);
      if (!chosen.empty() && use == Selection::Use::highlight) result.pale.push_back(chosen[i] == 0);
      if (shape.empty()) continue;
      result.shape.push_back(shape[i]);
      result.orientation.push_back(frame.orientation.empty() ? Eigen::Quaterniond::Identity()
                                                             : frame.orientation[i].normalized());
    }
  return result;
}

std::vector<std::size_t> evenSubset(std::size_t size, int count) {
  const std::size_t kept = count > 0 ? std::min(size, static_cast<std::size_t>(count)) : size;
  std::vector<std::size_t> result(kept);
  for (std::size_t k = 0; k < kept; ++k)
    result[k] = k * size / kept;
  return result;
}

} // namespace sandglass::vis
