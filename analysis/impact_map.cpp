#include "analysis/impact_map.h"

#include "sim/grains/seeding.h"
#include "sim/solvers/solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace sandglass::analysis {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double startGap = 0.01;        ///< radii, between the surfaces before an impact
constexpr double longestCollision = 200; ///< collision times after which a pair is taken to stick
constexpr double slowMove = 0.002;       ///< diameters in a collision time

struct Impacts {
  std::vector<double> slipBefore, slipAfter, normalAfter; ///< over the incident normal speed
};

/// One lane an angle, side by side along y; impacts along z, slip along x.
class ImpactBench {
public:
  /// `wall`: a material, empty for a sphere of the same species.
  ImpactBench(const Scene& scene, int species, const std::string& wall, const ImpactMapOptions& options)
      : options_(options), species_(species), onWall_(!wall.empty()), bench_(scene) {
    radius_ = 0.5 * sizeRange(scene, scene.species[species]).meanDiameter;
    bench_.gravity = Vec3::Zero();
    bench_.walls.clear();
    bench_.outlets.clear();
    bench_.fills.clear();
    bench_.output = {};
    bench_.output.quantities = {quantity::velocity, quantity::spin};
    if (!onWall_) return;
    WallSpec plane;
    plane.name = "plane";
    plane.material = wall;
    plane.shape.kind = "plane";
    plane.shape.parameters.set("point", Vec3(Vec3::Zero()));
    plane.shape.parameters.set("normal", Vec3(Vec3::UnitZ()));
    bench_.walls.push_back(plane);
  }

  Impacts run(double largestSlip) {
    const int lanes = options_.angles;
    SolverOptions one;
    one.threads = 1;
    const double contact = bench_.accuracy.stepsPerContact * makeSolver(bench_, one)->stepSize();
    if (!(options_.normalSpeed > 0))
      options_.normalSpeed = slowMove * 2 * radius_ / ((1 + largestSlip) * contact);
    const double vn = options_.normalSpeed;
    const double time = startGap * radius_ / vn + longestCollision * contact;
    const double length = vn * (1 + largestSlip) * time + 10 * radius_;
    bench_.domain = {Vec3(-length, -3 * radius_, -length),
                     Vec3(length, (3 * lanes + 3) * radius_, length),
                     {false, false, false}};
    if (onWall_) bench_.domain.lower.z() = -10 * radius_;
    const auto solver = makeSolver(bench_, one);

    Impacts result;
    std::vector<GrainSeed> seeds;
    for (int k = 0; k < lanes; ++k) {
      result.slipBefore.push_back(largestSlip * k / std::max(1, lanes - 1));
      const Vec3 velocity(vn * result.slipBefore.back(), 0, -vn);
      const double gap = startGap * radius_, y = 3 * k * radius_;
      const double aside = -result.slipBefore.back() * gap; // so that they touch right above each other
      if (onWall_) {
        seeds.push_back(grain(Vec3(0, y, radius_ + gap), velocity));
        continue;
      }
      // The pair stays where it is: each has half of the relative velocity.
      seeds.push_back(grain(Vec3(aside / 2, y, radius_ + gap / 2), velocity / 2));
      seeds.push_back(grain(Vec3(-aside / 2, y, -radius_ - gap / 2), -velocity / 2));
    }
    for (std::size_t i = 0; i < seeds.size(); ++i)
      seeds[i].id = static_cast<std::int64_t>(i);
    solver->add(seeds);

    result.slipAfter.assign(lanes, none);
    result.normalAfter.assign(lanes, none);
    while (
        solver->time() < time &&
        std::isnan(*std::max_element(result.slipAfter.begin(), result.slipAfter.end(),
                                     [](double a, double b) { return !std::isnan(a) && std::isnan(b); }))) {
      solver->advance(20);
      collect(*solver->frame(), result);
    }
    return result;
  }

  double normalSpeed() const { return options_.normalSpeed; } ///< [m/s], once run

private:
  GrainSeed grain(const Vec3& position, const Vec3& velocity) const {
    GrainSeed g;
    g.species = species_;
    g.radius = radius_;
    g.position = position;
    g.velocity = velocity;
    return g;
  }

  /// Takes down the lanes that have parted since.
  void collect(const Frame& frame, Impacts& result) const {
    const auto& velocity = frame.vector(quantity::velocity);
    const auto spin = [&](std::size_t i) -> Vec3 {
      return frame.has(quantity::spin) ? frame.vector(quantity::spin)[i] : Vec3::Zero();
    };
    for (std::size_t k = 0; k < result.slipAfter.size(); ++k) {
      if (!std::isnan(result.slipAfter[k])) continue;
      const std::size_t a = onWall_ ? k : 2 * k, b = a + 1;
      Vec3 apart = frame.position[a], relative = velocity[a], spins = radius_ * spin(a);
      double surface = frame.position[a].z() - radius_;
      Vec3 normal = Vec3::UnitZ();
      if (!onWall_) {
        apart -= frame.position[b];
        relative -= velocity[b];
        spins += radius_ * spin(b);
        surface = apart.norm() - 2 * radius_;
        normal = apart.normalized();
      }
      if (surface <= 0 || relative.dot(normal) <= 0) continue; // touches, or is on its way
      // Surface of a against that of b: v + w x (-r n) for a, likewise for b.
      const Vec3 slip = relative - relative.dot(normal) * normal - spins.cross(normal);
      const Vec3 along = Vec3::UnitX() - normal.x() * normal;
      result.slipAfter[k] = slip.dot(along.normalized()) / options_.normalSpeed;
      result.normalAfter[k] = relative.dot(normal) / options_.normalSpeed;
    }
  }

  ImpactMapOptions options_;
  int species_;
  bool onWall_;
  Scene bench_;
  double radius_ = 0;
};

void addPair(const Scene& scene, int species, const std::string& wall, const ImpactMapOptions& options,
             Curve& curve) {
  const std::string& material = scene.species[species].material;
  const ContactSpec& contact = scene.contact(material, wall.empty() ? material : wall);
  const double friction = contact.tangential.parameters.number("friction", 0);
  // Sliding begins at (7/2) mu (1 + e) or, with a weak tangential spring, somewhat above.
  const double largest = options.largestSlip > 0 ? options.largestSlip
                         : friction > 0          ? 1.5 * 7 * friction
                                                 : 5.0;
  ImpactBench bench(scene, species, wall, options);
  const Impacts impacts = bench.run(largest);
  const std::string name =
      fmt::format("{} on {}", scene.species[species].name, wall.empty() ? scene.species[species].name : wall);
  curve.series.push_back({name, impacts.slipBefore, impacts.slipAfter, {}});
  const double restitution = impacts.normalAfter.front();
  curve.numbers[name + " restitution"] = restitution;
  curve.numbers[name + " friction"] = friction;
  curve.numbers[name + " normal_speed"] = bench.normalSpeed();
  if (!(friction > 0) || std::isnan(restitution)) return;
  const double lost = 3.5 * friction * (1 + restitution);
  if (lost < largest) curve.series.push_back({name + ", sliding", {lost, largest}, {0, largest - lost}, {}});
}

} // namespace

Curve impactMap(const Scene& scene, const ImpactMapOptions& options) {
  Curve curve;
  curve.name = "impact_map";
  curve.title = "Impact map";
  curve.definition =
      "slip velocity after over normal velocity before, against slip over normal velocity before; single "
      "impacts without spin; sliding: psi1 - (7/2) mu (1 + e)";
  curve.x = {"psi1", ""};
  curve.y = {"psi2", ""};
  std::set<std::string> walls;
  for (const auto& wall : scene.walls)
    walls.insert(wall.material);
  for (std::size_t s = 0; s < scene.species.size(); ++s) {
    addPair(scene, static_cast<int>(s), "", options, curve);
    for (const auto& wall : walls)
      addPair(scene, static_cast<int>(s), wall, options, curve);
  }
  curve.marks.push_back({"", 0, false});
  curve.provenance = {{"scene", sceneHash(scene)}};
  return curve;
}

} // namespace sandglass::analysis
