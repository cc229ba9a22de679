#include "sim/io/import/grain_shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace sandglass {

namespace {

/// Volume of |x/a|.. as in GrainShape: 2 a b c e1 e2 B(e1/2 + 1, e1) B(e2/2, e2/2), from Jaklic, Leonardis
/// and Solina, "Segmentation and Recovery of Superquadrics" (2000), doi:10.1007/978-94-015-9456-1, eq. 2.60.
double shapeVolume(const GrainShape& s) {
  return 2 * s.semiAxes.prod() * s.e1 * s.e2 * std::beta(s.e1 / 2 + 1, s.e1) * std::beta(s.e2 / 2, s.e2 / 2);
}

/// LIGGGHTS' own columns are semi-axes and come with quat1 or blockiness1; LAMMPS computes whole axes.
bool looksLikeLiggghts(const RawFrame& raw) {
  return std::any_of(raw.columns.begin(), raw.columns.end(), [](const RawColumn& c) {
    return c.name == "quat1" || c.name == "blockiness1" || c.name == "roundness1";
  });
}

/// Semi-axes [m]; none where no column tells them.
std::vector<Vec3> takeAxes(ColumnSet& columns, const RawFrame& raw, const ImportSettings& settings,
                           std::vector<std::string>& notes) {
  if (columns.hasTriple("shape")) return columns.takeTriple("shape", settings.length);
  if (columns.hasTriple("shape_diameter")) return columns.takeTriple("shape_diameter", settings.length / 2);
  if (!columns.hasTriple("shape_unknown")) return {};
  const bool semi = settings.shape.empty() ? looksLikeLiggghts(raw) : settings.shape == "semi-axes";
  if (settings.shape.empty())
    notes.push_back(
        fmt::format("shapex, shapey and shapez are taken for {}; [grains] shape in the file of --columns "
                    "says otherwise",
                    semi ? "semi-axes, as LIGGGHTS writes them" : "whole axes, as LAMMPS writes them"));
  return columns.takeTriple("shape_unknown", semi ? settings.length : settings.length / 2);
}

std::vector<double> takeExponents(ColumnSet& columns, std::size_t rows, const char* e,
                                  const char* blockiness) {
  std::vector<double> values(rows, 1.0);
  if (const auto* given = columns.take(e))
    values = *given;
  else if (const auto* n = columns.take(blockiness))
    for (std::size_t k = 0; k < rows; ++k)
      values[k] = 2 / (*n)[k];
  return values;
}

void check(const GrainShape& shape, std::size_t row, const FramePlace& place) {
  const Vec3& a = shape.semiAxes;
  if (!(a.minCoeff() > 0))
    place.failAt(row, fmt::format("found the semi-axes {} {} {}, but all are above 0", a.x(), a.y(), a.z()));
  if (!(shape.e1 > 0 && shape.e1 <= 2 && shape.e2 > 0 && shape.e2 <= 2))
    place.failAt(row,
                 fmt::format("found a shape with the exponents {} and {}, but those of a convex grain are "
                             "above 0 and at most 2 (blockiness at least 1)",
                             shape.e1, shape.e2));
}

bool isSphere(const GrainShape& s) {
  return s.e1 == 1 && s.e2 == 1 && s.semiAxes.x() == s.semiAxes.y() && s.semiAxes.y() == s.semiAxes.z();
}

} // namespace

std::vector<double> takeShapes(ColumnSet& columns, const RawFrame& raw, const ImportSettings& settings,
                               const FramePlace& place, Frame& frame, std::vector<std::string>& notes) {
  const std::vector<Vec3> axes = takeAxes(columns, raw, settings, notes);
  const auto e1 = takeExponents(columns, raw.rows, "e1", "blockiness1"),
             e2 = takeExponents(columns, raw.rows, "e2", "blockiness2");
  if (axes.empty()) return {};
  std::map<std::tuple<double, double, double, double, double>, double> known;
  std::vector<double> number(raw.rows, -1), radius(raw.rows);
  for (std::size_t k = 0; k < raw.rows; ++k) {
    const GrainShape shape{axes[k], e1[k], e2[k]};
    check(shape, k, place);
    if (isSphere(shape)) {
      radius[k] = axes[k].x();
      continue;
    }
    radius[k] = std::cbrt(shapeVolume(shape) * 3 / (4 * std::numbers::pi));
    if (!(radius[k] > 0 && std::isfinite(radius[k])))
      place.failAt(k, "its shape has no volume that can be told");
    const auto [it, fresh] = known.try_emplace({axes[k].x(), axes[k].y(), axes[k].z(), shape.e1, shape.e2},
                                               static_cast<double>(frame.shapes.size()));
    if (fresh) frame.shapes.push_back(shape);
    number[k] = it->second;
  }
  if (!frame.shapes.empty()) frame.scalars[quantity::shape] = std::move(number);
  return radius;
}

void takeOrientations(ColumnSet& columns, const FramePlace& place, Frame& frame) {
  if (!columns.hasTriple(quantity::orientation) || !columns.has("orientation.w")) return;
  const auto& w = *columns.take("orientation.w");
  const auto v = columns.takeTriple(quantity::orientation, 1);
  for (std::size_t k = 0; k < v.size(); ++k) {
    const Eigen::Quaterniond q(w[k], v[k].x(), v[k].y(), v[k].z());
    const double norm = q.norm();
    // Six digits as text leave 1e-5 or so; far from 1 it is another convention or no quaternion.
    constexpr double allowed = 0.01;
    if (!(std::abs(norm - 1) < allowed))
      place.failAt(
          k, fmt::format("found an orientation of length {}, but a quaternion of length 1 is due", norm));
    frame.orientation.push_back(q.normalized());
  }
}

} // namespace sandglass
