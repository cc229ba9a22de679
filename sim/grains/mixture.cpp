#include "sim/grains/mixture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace sandglass {

Mixture::Mixture(const Scene& scene, const FillSpec& fill)
    : smallest_(std::numeric_limits<double>::infinity()) {
  double all = 0;
  std::vector<double> volumes, densities;
  for (const auto& share : fill.mixture) {
    const auto it = std::find_if(scene.species.begin(), scene.species.end(),
                                 [&](const Species& s) { return s.name == share.species; });
    const Species& species = scene.speciesNamed(share.species);
    Part part{static_cast<int>(it - scene.species.begin()), 0,
              makeSizeDistribution(species.size.kind, species.size.parameters)};
    const double volume = std::numbers::pi / 6 * part.sizes->meanCube();
    const double density = scene.material(species.material).density;
    part.numberShare = fill.byMass ? share.fraction / (volume * density) : share.fraction;
    all += part.numberShare;
    if (share.fraction > 0) {
      largest_ = std::max(largest_, part.sizes->largest());
      smallest_ = std::min(smallest_, part.sizes->smallest());
    }
    volumes.push_back(volume);
    densities.push_back(density);
    parts_.push_back(std::move(part));
  }
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    parts_[i].numberShare /= all;
    meanVolume_ += parts_[i].numberShare * volumes[i];
    meanMass_ += parts_[i].numberShare * volumes[i] * densities[i];
  }
}

GrainSeed Mixture::grain(std::uint64_t seed, std::int64_t id, const Part& part) const {
  RandomStream random(seed, RandomPurpose::grainSize, static_cast<std::uint64_t>(id));
  GrainSeed g;
  g.id = id;
  g.species = part.species;
  g.radius = part.sizes->draw(random) / 2;
  return g;
}

std::vector<GrainSeed> Mixture::draw(std::uint64_t seed, std::int64_t firstId, std::int64_t count) const {
  // Largest remainder: floors first, what is left goes to the largest fractions.
  std::vector<std::int64_t> counts;
  std::vector<std::pair<double, std::size_t>> remainders;
  std::int64_t given = 0;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const double exact = parts_[i].numberShare * static_cast<double>(count);
    counts.push_back(static_cast<std::int64_t>(exact));
    remainders.emplace_back(static_cast<double>(counts.back()) - exact, i);
    given += counts.back();
  }
  std::sort(remainders.begin(), remainders.end());
  for (std::size_t k = 0; given < count; ++k, ++given)
    ++counts[remainders[k % remainders.size()].second];

  std::vector<std::size_t> order;
  order.reserve(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < parts_.size(); ++i)
    order.insert(order.end(), static_cast<std::size_t>(counts[i]), i);
  if (parts_.size() > 1) { // Fisher-Yates
    RandomStream random(seed, RandomPurpose::speciesChoice, static_cast<std::uint64_t>(firstId));
    for (std::size_t i = order.size(); i > 1; --i)
      std::swap(order[i - 1], order[static_cast<std::size_t>(random.uniform() * static_cast<double>(i))]);
  }
  std::vector<GrainSeed> grains;
  grains.reserve(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    grains.push_back(grain(seed, firstId + static_cast<std::int64_t>(i), parts_[order[i]]));
  return grains;
}

GrainSeed Mixture::drawOne(std::uint64_t seed, std::int64_t id) const {
  RandomStream random(seed, RandomPurpose::speciesChoice, static_cast<std::uint64_t>(id));
  double left = random.uniform();
  for (const auto& part : parts_) {
    if (left < part.numberShare) return grain(seed, id, part);
    left -= part.numberShare;
  }
  return grain(seed, id, parts_.back());
}

void setMotion(GrainSeed& grain, std::uint64_t seed, const Parameters& parameters) {
  const Vec3 spread = parameters.vector("velocity_spread");
  const double spin = parameters.number("spin_spread");
  grain.velocity = parameters.vector("velocity");
  RandomStream velocities(seed, RandomPurpose::grainVelocity, static_cast<std::uint64_t>(grain.id));
  RandomStream spins(seed, RandomPurpose::grainSpin, static_cast<std::uint64_t>(grain.id));
  for (int k = 0; k < 3; ++k) {
    grain.velocity[k] += velocities.uniform(-spread[k], spread[k]);
    grain.spin[k] = spins.uniform(-spin, spin);
  }
}

} // namespace sandglass
