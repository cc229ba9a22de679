// A fluid whose velocity is given on the points of an upright grid, as another program computed it or an
// instrument measured it. In between, linear along each direction in turn (trilinear): a velocity that grows
// linearly comes out as it is. Along a direction with one point alone nothing changes.

#include "sim/base/error.h"
#include "sim/base/math.h"
#include "sim/fields/field.h"
#include "sim/fields/field_kinds.h"
#include "sim/scene/from_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sandglass {

namespace {

class GriddedWind final : public Field {
public:
  explicit GriddedWind(const Parameters& p) {
    for (const char* key : {"points", "origin", "spacing", "velocities"})
      if (!p.has(key))
        throw InputError(
            p.has("file")
                ? std::string("its file was not read")
                : fmt::format(
                      "a gridded_wind needs a file, or points, origin, spacing and velocities; '{}' is "
                      "missing",
                      key));
    const std::vector<double>& points = p.numbers("points");
    if (points.size() != 3)
      throw InputError(fmt::format("points must be three numbers, not {}", points.size()));
    double size = 1.0;
    for (int k = 0; k < 3; ++k) {
      if (points[k] < 1.0 || points[k] > 1e6 || points[k] != std::floor(points[k]))
        throw InputError(fmt::format("points must be whole numbers from 1 on, not {}", points[k]));
      count_[k] = static_cast<int>(points[k]);
      size *= points[k];
      spacing_[k] = p.vector("spacing")[k];
      if (!(spacing_[k] > 0.0))
        throw InputError(
            fmt::format("spacing must be above 0, and along {} it is {} m", "xyz"[k], spacing_[k]));
    }
    origin_ = p.vector("origin");
    const std::vector<Vec3>& velocities = p.vectors("velocities");
    if (static_cast<double>(velocities.size()) != size)
      throw InputError(fmt::format("{} x {} x {} points need as many velocities, not {}", count_[0],
                                   count_[1], count_[2], velocities.size()));
    for (const Vec3& v : velocities) {
      if (!v.allFinite()) throw InputError("a velocity is not a finite number");
      velocities_.push_back({v.x(), v.y(), v.z(), 0.0});
    }
    still_ = p.has("outside") && p.text("outside") == "still";
  }

  void apply(FieldBlock& b, double factor) const override {
    for (int i = 0; i < b.size; ++i) {
      const Vec3 u = at({b.x[i], b.y[i], b.z[i]});
      b.flowX[i] += factor * u.x();
      b.flowY[i] += factor * u.y();
      b.flowZ[i] += factor * u.z();
    }
  }

  double topSpeed(const Domain&) const override {
    double most = 0.0;
    for (const Quad& v : velocities_)
      most = std::max(most, v.vec().norm());
    return most;
  }

private:
  Vec3 at(const Vec3& x) const {
    std::size_t low[3], step[3]; // of the lower corner and from there to the upper
    double share[3];             // of the upper
    std::size_t stride = 1;
    for (int k = 0; k < 3; ++k) {
      const double last = count_[k] - 1.0;
      double s = count_[k] > 1 ? (x[k] - origin_[k]) / spacing_[k] : 0.0;
      if (still_ && !(s >= 0.0 && s <= last)) return Vec3::Zero();
      s = s > 0.0 ? s : 0.0; // the velocity of the edge beyond it
      s = s < last ? s : last;
      const int cell = std::min(static_cast<int>(s), std::max(count_[k] - 2, 0));
      share[k] = s - cell;
      low[k] = static_cast<std::size_t>(cell) * stride;
      step[k] = count_[k] > 1 ? stride : 0;
      stride *= static_cast<std::size_t>(count_[k]);
    }
    const Quad* corner = velocities_.data() + low[0] + low[1] + low[2];
    const auto mixed = [](const Vec3& a, const Vec3& b, double t) { return Vec3(a + t * (b - a)); };
    const auto alongX = [&](std::size_t at) {
      return mixed(corner[at].vec(), corner[at + step[0]].vec(), share[0]);
    };
    const auto alongY = [&](std::size_t at) { return mixed(alongX(at), alongX(at + step[1]), share[1]); };
    return mixed(alongY(0), alongY(step[2]), share[2]);
  }

  int count_[3];
  Vec3 origin_, spacing_;
  bool still_;
  std::vector<Quad> velocities_; ///< [m/s] x fastest
};

/// A grid that the tank sticks out of needs a word on what blows there.
std::string objection(const Parameters& p, const Domain& domain) {
  if (p.has("outside")) return {};
  for (int k = 0; k < 3; ++k) {
    const double first = p.vector("origin")[k],
                 last = first + (p.numbers("points")[k] - 1.0) * p.vector("spacing")[k],
                 slack = 1e-9 * (last - first);
    if (p.numbers("points")[k] > 1.0 && (domain.lower[k] < first - slack || domain.upper[k] > last + slack))
      return fmt::format(
          "has a grid from {:.6g} m to {:.6g} m along {}, and the domain reaches from {:.6g} m to "
          "{:.6g} m; say what blows beyond the grid with outside = \"edge\" (the velocity of its "
          "nearest point) or \"still\"",
          first, last, "xyz"[k], domain.lower[k], domain.upper[k]);
  }
  return {};
}

} // namespace

FieldKind griddedWindField() {
  using enum ParameterType;
  return {"gridded_wind",
          FieldRole::flow,
          "a fluid whose velocity is given on a grid, linear in between",
          "eight velocities a grain and step, 32 bytes a point of the grid",
          {{.name = "file",
            .type = text,
            .unit = "1",
            .description =
                "VTK image data, .vti or legacy .vtk, beside the scene; its points become the keys below",
            .optional = true},
           {.name = "array",
            .type = text,
            .unit = "1",
            .description = "name of the velocity in the file; may be left out where it has one vector alone",
            .optional = true},
           fileScale(),
           {.name = "velocity_scale",
            .type = number,
            .unit = "m/s",
            .description = "velocity of one unit of the file; 1 m/s when left out",
            .optional = true},
           fileShift(),
           {.name = "points",
            .type = numbers,
            .unit = "1",
            .description = "instead of a file: numbers of points along x, y and z",
            .optional = true},
           {.name = "origin",
            .type = vector,
            .unit = "m",
            .description = "instead of a file: the first point",
            .optional = true},
           {.name = "spacing",
            .type = vector,
            .unit = "m",
            .description = "instead of a file: distance of points",
            .optional = true},
           {.name = "velocities",
            .type = vectors,
            .unit = "m/s",
            .description = "instead of a file: one a point, x fastest",
            .optional = true},
           {.name = "outside",
            .type = text,
            .unit = "1",
            .description =
                "what blows beyond the grid: the velocity of the nearest point of its edge, or nothing; when "
                "left out, a domain that reaches beyond is refused",
            .optional = true,
            .choices = {"edge", "still"}}},
          [](const Parameters& p) { return std::make_unique<GriddedWind>(p); },
          objection};
}

} // namespace sandglass
