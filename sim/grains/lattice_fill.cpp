#include "sim/grains/fills.h"

#include "sim/base/error.h"
#include "sim/base/random.h"
#include "sim/grains/mixture.h"

#include <fmt/format.h>

#include <cmath>

namespace sandglass {

namespace {

/// A rectangular cell and the points in it, for nearest centres 1 apart.
struct UnitCell {
  Vec3 size;
  std::vector<Vec3> points; ///< in shares of the cell
};

UnitCell unitCell(const std::string& structure) {
  if (structure == "sc") return {Vec3(1, 1, 1), {Vec3(0, 0, 0)}};
  if (structure == "fcc") {
    const double a = std::sqrt(2.0); // nearest centres are half a face diagonal apart
    return {Vec3(a, a, a), {Vec3(0, 0, 0), Vec3(.5, .5, 0), Vec3(.5, 0, .5), Vec3(0, .5, .5)}};
  }
  // hcp, layers along z: ABAB with the ideal height sqrt(2/3) between layers.
  return {Vec3(1, std::sqrt(3.0), std::sqrt(8.0 / 3)),
          {Vec3(0, 0, 0), Vec3(.5, .5, 0), Vec3(.5, 5.0 / 6, .5), Vec3(0, 1.0 / 3, .5)}};
}

/// Points with lower <= x < upper along each axis, up to rounding, in the order of the axes z, y, x.
std::vector<Vec3> latticePoints(const Parameters& p) {
  const UnitCell cell = unitCell(p.text("structure"));
  const Vec3 size = cell.size * p.number("spacing");
  const Vec3 lower = p.vector("lower"), extent = p.vector("upper") - lower;
  constexpr double slack = 1e-9; // a box of exactly n cells holds n, however its ends were rounded
  std::array<int, 3> cells{};
  for (int k = 0; k < 3; ++k)
    cells[static_cast<std::size_t>(k)] = static_cast<int>(std::ceil(extent[k] / size[k] - slack));
  std::vector<Vec3> points;
  for (int z = 0; z < cells[2]; ++z)
    for (int y = 0; y < cells[1]; ++y)
      for (int x = 0; x < cells[0]; ++x)
        for (const Vec3& point : cell.points) {
          const Vec3 at = (Vec3(x, y, z) + point).cwiseProduct(size);
          if (((at - extent).array() < -slack * size.array()).all()) points.push_back(lower + at);
        }
  return points;
}

} // namespace

std::vector<GrainSeed> fillLattice(const FillContext& context) {
  const Scene& scene = context.scene;
  const Parameters& p = context.fill.how.parameters;
  const Mixture mixture(scene, context.fill);
  const double jitter = p.number("jitter");
  std::vector<Vec3> sites;
  // Rounding may bring spheres one spacing apart closer by a few units in the last place.
  constexpr double rounding = 1e-9;
  for (const Vec3& point : latticePoints(p)) {
    const Vec3 site = context.open.wrapped(point);
    if (context.open.admits(site, mixture.largest() / 2 + jitter * std::sqrt(3.0), rounding))
      sites.push_back(site);
  }
  auto grains = mixture.draw(scene.seed, context.firstId, static_cast<std::int64_t>(sites.size()));
  for (std::size_t i = 0; i < grains.size(); ++i) {
    GrainSeed& g = grains[i];
    RandomStream random(scene.seed, RandomPurpose::grainPosition, static_cast<std::uint64_t>(g.id));
    g.position = sites[i];
    for (int k = 0; k < 3; ++k)
      g.position[k] += random.uniform(-jitter, jitter);
    g.position = context.open.wrapped(g.position);
    if (context.placed.overlap(g.position, g.radius) > rounding)
      throw InputError(
          fmt::format("makes grains overlap: a spacing of {:.4g} m with a jitter of {:.4g} m is too tight "
                      "for diameters up to {:.4g} m, or the region meets itself or another filling; "
                      "widen the spacing or change the region",
                      p.number("spacing"), jitter, mixture.largest()));
    context.placed.add(g.position, g.radius);
    setMotion(g, scene.seed, p);
  }
  return grains;
}

} // namespace sandglass
