// Random sequential insertion. Spheres of one size jam at a solid fraction of 0.38 (Zhang & Torquato, Phys.
// Rev. E 88, 053312, 2013); long before that the tries needed for one grain grow steeply.
#include "sim/grains/fills.h"

#include "sim/base/error.h"
#include "sim/base/random.h"
#include "sim/grains/fill_region.h"
#include "sim/grains/mixture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace sandglass {

namespace {

constexpr std::int64_t mostTriesPerGrain = 2'000; ///< on average over the filling

[[noreturn]] void refuse(std::size_t placed, std::size_t wanted, double volumePlaced, double volumeWanted,
                         double openVolume) {
  throw InputError(
      fmt::format("found room for {} of {} grains, a solid fraction of {:.2f} in the {:.4g} m^3 that are "
                  "open; make the region "
                  "at least {:.4g} m^3 (random placement is quick up to {}) or bring in fewer grains",
                  placed, wanted, volumePlaced / openVolume, openVolume, volumeWanted / quickSolidFraction,
                  quickSolidFraction));
}

} // namespace

double openShare(const Scene& scene, const FillSpec& fill) {
  const FillRegion region(fill.how.parameters, scene.domain);
  const OpenSpace open(scene, fill.stage);
  // Additive recurrence with the powers of the root of x^4 = x + 1: spread more evenly than random points.
  constexpr double g = 1.22074408460575947536;
  constexpr int points = 20'000;
  int inside = 0;
  for (int i = 1; i <= points; ++i) {
    const Vec3 unit(std::fmod(i / g, 1.0), std::fmod(i / (g * g), 1.0), std::fmod(i / (g * g * g), 1.0));
    if (open.admits(open.wrapped(region.centre(unit, 0)), 0)) ++inside;
  }
  return static_cast<double>(inside) / points;
}

std::int64_t randomFillCount(const Scene& scene, const FillSpec& fill) {
  const Parameters& p = fill.how.parameters;
  if (p.has("number")) return p.integer("number");
  const Mixture mixture(scene, fill);
  if (p.has("mass")) return std::llround(p.number("mass") / mixture.meanMass());
  const double open = FillRegion(p, scene.domain).volume() * openShare(scene, fill);
  return std::llround(p.number("solid_fraction") * open / mixture.meanVolume());
}

std::vector<GrainSeed> fillRandomly(const FillContext& context) {
  const Scene& scene = context.scene;
  const Parameters& parameters = context.fill.how.parameters;
  const FillRegion region(parameters, scene.domain);
  const std::int64_t count = randomFillCount(scene, context.fill);
  std::vector<GrainSeed> grains = Mixture(scene, context.fill).draw(scene.seed, context.firstId, count);

  std::vector<std::size_t> order(grains.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return grains[a].radius > grains[b].radius; });

  const std::int64_t triesOfOne = parameters.integer("tries"), restarts = parameters.integer("restarts");
  double volumeWanted = 0, volumePlaced = 0;
  const auto volume = [](const GrainSeed& g) { return 4 * std::numbers::pi / 3 * std::pow(g.radius, 3); };
  for (const auto& g : grains)
    volumeWanted += volume(g);
  const auto giveUp = [&](std::size_t placed) {
    refuse(placed, grains.size(), volumePlaced, volumeWanted,
           region.volume() * openShare(scene, context.fill));
  };

  std::optional<PlacementGrid> before;
  if (restarts > 0) before = context.placed;
  std::int64_t budget = triesOfOne + mostTriesPerGrain * count, attempt = 0;
  for (std::size_t k = 0; k < order.size();) {
    GrainSeed& g = grains[order[k]];
    if (!region.holds(g.radius))
      throw InputError(fmt::format(
          "has a region too small for a grain of diameter {:.4g} m; enlarge the region", 2 * g.radius));
    RandomStream random(scene.seed, RandomPurpose::grainPosition,
                        static_cast<std::uint64_t>(g.id) + (static_cast<std::uint64_t>(attempt) << 48));
    bool found = false;
    for (std::int64_t tries = 0; !found; ++tries) {
      if (tries == triesOfOne || budget-- == 0) break;
      const double x = random.uniform(), y = random.uniform(), z = random.uniform();
      const Vec3 at = context.open.wrapped(region.centre({x, y, z}, g.radius));
      if (!context.placed.isFree(at, g.radius) || !context.open.admits(at, g.radius)) continue;
      g.position = at;
      found = true;
    }
    if (!found) {
      if (attempt == restarts) giveUp(k);
      ++attempt; // all anew, at other places
      context.placed = *before;
      budget = triesOfOne + mostTriesPerGrain * count;
      volumePlaced = 0;
      k = 0;
      continue;
    }
    ++k;
    context.placed.add(g.position, g.radius);
    volumePlaced += volume(g);
    setMotion(g, scene.seed, parameters);
  }
  return grains;
}

} // namespace sandglass
