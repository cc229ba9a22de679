#include "sim/scene/check_fills.h"

#include "sim/base/error.h"
#include "sim/grains/fill_region.h"
#include "sim/grains/fills.h"
#include "sim/grains/mixture.h"
#include "sim/scene/check_parts.h"
#include "sim/scene/suggest.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sandglass {

namespace {

std::string pathOf(std::size_t fill) {
  return fmt::format("fill.{}", fill + 1);
}

/// Exactly one of the keys must be given.
void checkOneOf(const Parameters& p, const std::vector<std::string>& keys, const std::string& path,
                FaultList& faults) {
  const auto given =
      std::count_if(keys.begin(), keys.end(), [&](const std::string& key) { return p.has(key); });
  if (given != 1)
    faults.about(path, fmt::format("gives {} of the keys {}; give exactly one",
                                   given == 0 ? "none" : std::to_string(given), joined(keys)));
}

void checkRegion(const Parameters& p, const std::string& path, const Domain& domain, FaultList& faults) {
  const std::string region = p.text("region");
  const std::vector<std::string> box{"lower", "upper"}, cylinder{"base", "axis", "radius", "height"};
  const auto need = [&](const std::vector<std::string>& keys, bool needed) {
    for (const auto& key : keys)
      if (needed && !p.has(key))
        faults.about(path, fmt::format("lacks the key '{}', which a region \"{}\" needs", key, region));
      else if (!needed && p.has(key))
        faults.wrong(path + "." + key, fmt::format("but a region \"{}\" has no such key; remove it", region));
  };
  need(box, region == "box");
  need(cylinder, region == "cylinder");
  if (faults.has(path)) return;
  if (region == "box") checkBox(path, p.vector("lower"), p.vector("upper"), faults);
  if (region == "cylinder") checkDirection(path + ".axis", p.vector("axis"), faults);
}

void checkInside(const Parameters& p, const std::string& path, const Domain& domain, FaultList& faults) {
  if (faults.has(path) || faults.has("domain") || !p.has("lower") || !p.has("upper")) return;
  const Eigen::AlignedBox3d space(domain.lower, domain.upper), box(p.vector("lower"), p.vector("upper"));
  if (!space.intersects(box))
    faults.wrong(path + ".lower", "but the region lies outside the domain as a whole; move it inside");
}

void checkMixture(const Scene& scene, const FillSpec& fill, const std::string& path, FaultList& faults) {
  std::vector<std::string> names;
  for (const auto& s : scene.species)
    names.push_back(s.name);
  double sum = 0;
  for (std::size_t i = 0; i < fill.mixture.size(); ++i) {
    const Share& share = fill.mixture[i];
    sum += share.fraction;
    if (share.species.empty() || std::find(names.begin(), names.end(), share.species) != names.end())
      continue;
    const std::string inMixture = fmt::format("{}.mixture.{}.species", path, i + 1);
    const bool single = fill.mixture.size() == 1 && share.fraction == 1;
    faults.wrong(single ? path + ".species" : inMixture,
                 fmt::format("but the scene has no [[species]] '{}'; {}", share.species,
                             suggestion(share.species, names, "there are")));
  }
  if (!fill.mixture.empty() && !faults.has(path) && std::abs(sum - 1) > 1e-9)
    faults.about(path + ".mixture",
                 fmt::format("has fractions that sum to {}, but they must sum to 1; scale them", sum));
}

/// Lists and lattices are quick to place: what the run would refuse is refused here, with the line.
void tryPlacing(const Scene& scene, std::size_t f, FaultList& faults) {
  const FillSpec& fill = scene.fills[f];
  double largest = 0;
  if (fill.how.kind == "list")
    for (const double d : fill.how.parameters.numbers("diameters"))
      largest = std::max(largest, d);
  else
    largest = Mixture(scene, fill).largest();
  const OpenSpace open(scene, fill.stage);
  PlacementGrid placed(scene.domain, largest, scene.sector());
  const FillContext context{scene, fill, open, placed, 0, pathOf(f)};
  try {
    fill.how.kind == "list" ? fillFromList(context) : fillLattice(context);
  } catch (const InputError& e) {
    for (const auto& phrase : e.sentences())
      faults.about(pathOf(f), phrase);
  }
}

} // namespace

void checkFills(const Scene& scene, FaultList& faults) {
  if (scene.fills.empty() && !faults.has("fill"))
    faults.general("there is no [[fill]], so the run would have no grains; add one");
  std::vector<std::string> stages;
  for (const auto& s : scene.stages)
    stages.push_back(s.name);
  for (std::size_t f = 0; f < scene.fills.size(); ++f) {
    const FillSpec& fill = scene.fills[f];
    const std::string path = pathOf(f);
    const Parameters& p = fill.how.parameters;
    if (!stages.empty() && !faults.has(path + ".stage") &&
        std::find(stages.begin(), stages.end(), fill.stage) == stages.end())
      faults.wrong(path + ".stage", fmt::format("but the scene has no [[stage]] '{}'; {}", fill.stage,
                                                suggestion(fill.stage, stages, "there are")));
    checkMixture(scene, fill, path, faults);
    if (faults.has(path) || fill.how.kind.empty()) continue;
    if (fill.how.kind == "random") {
      checkOneOf(p, {"number", "mass", "solid_fraction"}, path, faults);
      checkRegion(p, path, scene.domain, faults);
    } else if (fill.how.kind == "rain") {
      checkOneOf(p, {"rate", "mass_rate"}, path, faults);
      checkBox(path, p.vector("lower"), p.vector("upper"), faults);
    } else if (fill.how.kind == "lattice") {
      checkBox(path, p.vector("lower"), p.vector("upper"), faults);
    }
    checkInside(p, path, scene.domain, faults);
  }
}

void checkSizes(const Scene& scene, FaultList& faults) {
  static constexpr const char* axes[] = {"x", "y", "z"};
  double largest = 0;
  std::string whose;
  const auto consider = [&](double diameter, const std::string& name) {
    if (diameter > largest) {
      largest = diameter;
      whose = name;
    }
  };
  for (const auto& s : scene.species)
    consider(sizeRange(scene, s).largest, "species." + s.name + ".size");
  for (std::size_t f = 0; f < scene.fills.size(); ++f)
    if (scene.fills[f].how.kind == "list")
      for (const double d : scene.fills[f].how.parameters.numbers("diameters"))
        consider(d, pathOf(f));

  for (std::size_t k = 0; k < 3; ++k) {
    const double period = scene.domain.upper[static_cast<int>(k)] - scene.domain.lower[static_cast<int>(k)];
    if (scene.domain.periodic[k] && largest >= period)
      faults.about(
          whose, fmt::format(
                     "allows a diameter of {:.6g} m, but the domain repeats every {:.6g} m along {}, so that "
                     "such a grain would touch itself; enlarge the domain or take smaller grains",
                     largest, period, axes[k]));
  }
  for (const auto& wall : scene.walls) {
    if (!wall.shape.parameters.has("outlet")) continue;
    const double opening = wall.shape.parameters.number("outlet");
    if (opening > 0 && largest >= opening)
      faults.wrong("wall." + wall.name + ".outlet",
                   fmt::format("but {} allows a diameter of {:.6g} m, which cannot pass; widen the outlet",
                               whose, largest));
  }
}

void checkAmounts(const Scene& scene, FaultList& faults) {
  // Rough: a grain with its neighbours and contacts takes half a kilobyte.
  constexpr double bytesPerGrain = 500, mostGrains = 1e9;
  for (std::size_t f = 0; f < scene.fills.size(); ++f) {
    const FillSpec& fill = scene.fills[f];
    const Parameters& p = fill.how.parameters;
    if (fill.how.kind == "list") {
      tryPlacing(scene, f, faults);
      continue;
    }
    const Mixture mixture(scene, fill);
    const bool lattice = fill.how.kind == "lattice", random = fill.how.kind == "random";
    const double region =
        random ? FillRegion(p, scene.domain).volume() : (scene.domain.upper - scene.domain.lower).prod();
    double count = 0;
    std::string key = pathOf(f);
    for (const char* name : {"number", "mass", "solid_fraction"})
      if (p.has(name)) key = pathOf(f) + "." + name;
    if (p.has("number"))
      count = p.number("number");
    else if (p.has("mass"))
      count = p.number("mass") / mixture.meanMass();
    else if (p.has("solid_fraction"))
      count = p.number("solid_fraction") * region / mixture.meanVolume();
    else if (fill.how.kind == "rain")
      count = static_cast<double>(rainCount(scene, fill));
    else if (lattice)
      count = ((p.vector("upper") - p.vector("lower")) / p.number("spacing")).array().max(1.0).prod();
    if (count > mostGrains) {
      const std::string rule = fmt::format(
          "{:.3g} grains would need about {:.0f} GB of memory; at most {:.0f} are allowed, so bring in fewer",
          count, count * bytesPerGrain / 1e9, mostGrains);
      if (lattice)
        faults.about(key, "asks for too much: " + rule);
      else
        faults.wrong(key, "but " + rule);
      continue;
    }
    if (lattice) tryPlacing(scene, f, faults);
    if (lattice) continue;
    if (!FillRegion(p, scene.domain).holds(mixture.smallest() / 2)) {
      faults.about(pathOf(f),
                   fmt::format("has a region that not even its smallest grain, {:.6g} m in diameter, "
                               "fits into; make the region larger or the grains smaller",
                               mixture.smallest()));
      continue;
    }
    const double openPart = openShare(scene, fill);
    if (openPart <= 0) {
      faults.about(pathOf(f),
                   "has a region in which no point is open to grains; check the walls and the region");
      continue;
    }
    if (!random) continue;
    if (count < 0.5) {
      faults.wrong(
          key, fmt::format("but that is less than one grain (mean mass {:.3g} kg, mean volume {:.3g} m^3)",
                           mixture.meanMass(), mixture.meanVolume()));
      continue;
    }
    const double open = region * openPart, share = count * mixture.meanVolume() / open;
    if (share > jammedSolidFraction && !p.has("solid_fraction"))
      faults.wrong(
          key,
          fmt::format(
              "but these grains would fill {:.2f} of the {:.4g} m^3 that are open in the region, and random "
              "placement without overlap ends at {}; make the region at least {:.4g} m^3 or bring in fewer",
              share, open, jammedSolidFraction, count * mixture.meanVolume() / quickSolidFraction));
    else if (p.number("solid_fraction", 0) > jammedSolidFraction)
      faults.wrong(
          key, fmt::format(
                   "but random placement without overlap ends at {}; ask for less and let the grains settle",
                   jammedSolidFraction));
  }
}

} // namespace sandglass
