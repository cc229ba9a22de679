#include "sim/grains/seeding.h"

#include "sim/base/error.h"
#include "sim/grains/fills.h"
#include "sim/grains/mixture.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

namespace sandglass {

namespace {

double largestDiameter(const Scene& scene, const std::vector<GrainSeed>& present) {
  double largest = 0;
  for (const auto& g : present)
    largest = std::max(largest, 2 * g.radius);
  for (const auto& fill : scene.fills) {
    if (fill.how.kind == "list")
      for (const double d : fill.how.parameters.numbers("diameters"))
        largest = std::max(largest, d);
    for (const auto& share : fill.mixture)
      largest = std::max(largest, sizeRange(scene, scene.speciesNamed(share.species)).largest);
  }
  return largest;
}

std::vector<GrainSeed> place(const FillContext& context) {
  const std::string& kind = context.fill.how.kind;
  try {
    return kind == "random"    ? fillRandomly(context)
           : kind == "lattice" ? fillLattice(context)
                               : fillFromList(context);
  } catch (const InputError& e) {
    std::vector<std::string> sentences;
    for (const auto& phrase : e.sentences())
      sentences.push_back(fmt::format("{}: {} {}", context.scene.file, context.name, phrase));
    throw InputError(std::move(sentences));
  }
}

} // namespace

std::vector<GrainSeed> placeGrains(const Scene& scene, const std::string& stage, std::int64_t firstId,
                                   const std::vector<GrainSeed>& present, const Log& log) {
  const OpenSpace open(scene, stage);
  PlacementGrid placed(scene.domain, largestDiameter(scene, present), scene.sector());
  for (const auto& g : present)
    placed.add(open.wrapped(g.position), g.radius);
  std::vector<GrainSeed> all;
  for (std::size_t f = 0; f < scene.fills.size(); ++f) {
    const FillSpec& fill = scene.fills[f];
    if (fill.stage != stage || fill.how.kind == "rain") continue;
    const FillContext context{scene, fill, open, placed, firstId, fmt::format("fill.{}", f + 1)};
    const auto grains = place(context);
    report(log, LogLevel::info,
           fmt::format("{} ({}): {} grains placed", context.name, fill.how.kind, grains.size()));
    firstId += static_cast<std::int64_t>(grains.size());
    all.insert(all.end(), grains.begin(), grains.end());
  }
  return all;
}

SizeRange sizeRange(const Scene& scene, const Species& species) {
  const auto sizes = makeSizeDistribution(species.size.kind, species.size.parameters);
  return {sizes->smallest(), sizes->largest(), sizes->mean(),
          std::numbers::pi / 6 * sizes->meanCube() * scene.material(species.material).density};
}

std::int64_t expectedGrains(const Scene& scene) {
  std::int64_t count = 0;
  for (const auto& fill : scene.fills) {
    const Parameters& p = fill.how.parameters;
    if (fill.how.kind == "random")
      count += randomFillCount(scene, fill);
    else if (fill.how.kind == "rain")
      count += rainCount(scene, fill);
    else if (fill.how.kind == "list")
      count += static_cast<std::int64_t>(p.texts("species").size());
    else {
      const OpenSpace open(scene, fill.stage);
      PlacementGrid placed(scene.domain, largestDiameter(scene, {}), scene.sector());
      count += static_cast<std::int64_t>(fillLattice({scene, fill, open, placed, 0, "fill"}).size());
    }
  }
  return count;
}

} // namespace sandglass
