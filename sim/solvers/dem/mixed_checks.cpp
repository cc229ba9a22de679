#include "sim/solvers/dem/mixed_checks.h"

#include "sim/base/error.h"
#include "sim/contact/mixed/mixed_loops.h"
#include "sim/contact/mixed/mixed_records.h"
#include "sim/grains/seeding.h"

#include <fmt/format.h>

#include <algorithm>

namespace sandglass {

void checkMixedPrecision(const Scene& scene, const LawStack& laws) {
  if (laws.sumsOverlaps())
    throw InputError(
        "precision = \"mixed\" is not possible with a field that sums overlaps (overlap_lift); use "
        "precision = \"double\"");
  double smallest = 1e300, largest = 0.0;
  for (const Species& s : scene.species) {
    const SizeRange range = sizeRange(scene, s);
    smallest = std::min(smallest, range.smallest);
    largest = std::max(largest, range.largest);
    if (s.material != scene.species.front().material)
      throw InputError(fmt::format("{} (grains of '{}' and of '{}')", LawStack::mixedRule,
                                   scene.species.front().material, s.material));
  }
  int material = 0;
  while (scene.materials[material].name != scene.species.front().material)
    ++material;
  const FusedLaws fused = laws.fused(material);
  if (!mixedLoopPlain(fused)) {
    std::string names;
    for (const LawStack::Entry& entry : laws.entries())
      names += (names.empty() ? "" : ", ") + entry.name;
    throw InputError(fmt::format("{} (the laws are {})", LawStack::mixedRule, names));
  }
  if (fused.normal == FusedLaws::Normal::hertz && smallest != largest)
    throw InputError(
        fmt::format("{} (diameters from {:.3g} m to {:.3g} m)", LawStack::mixedRule, smallest, largest));
  // Squares of forces and of histories must be numbers of single precision, 1e-38 to 1e38.
  if (smallest < 1e-6 || largest > 1e3)
    throw InputError(
        fmt::format("precision = \"mixed\" is for grains of 1 um to 1 km, these are of {:.3g} m to "
                    "{:.3g} m; use precision = \"double\"",
                    smallest, largest));
  if (scene.accuracy.skin > MixedRecords::largestSkin)
    throw InputError(fmt::format("precision = \"mixed\" needs a skin of at most {}, not {}; lower it or use "
                                 "precision = \"double\"",
                                 MixedRecords::largestSkin, scene.accuracy.skin));
  const double reach =
      std::max(scene.domain.lower.cwiseAbs().maxCoeff(), scene.domain.upper.cwiseAbs().maxCoeff());
  if (reach > MixedRecords::farthest * largest)
    throw InputError(
        fmt::format("precision = \"mixed\" reaches {:.3g} m from the origin with grains of {:.3g} m, "
                    "the domain {:.3g} m; move it or use precision = \"double\"",
                    MixedRecords::farthest * largest, largest, reach));
}

} // namespace sandglass
