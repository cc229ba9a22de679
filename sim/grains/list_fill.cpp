#include "sim/grains/fills.h"

#include "sim/base/error.h"

#include <fmt/format.h>

#include <algorithm>

namespace sandglass {

std::vector<GrainSeed> fillFromList(const FillContext& context) {
  const Scene& scene = context.scene;
  const Parameters& p = context.fill.how.parameters;
  const auto& names = p.texts("species");
  const double mayOverlap = scene.accuracy.maximumOverlap;
  std::vector<GrainSeed> grains;
  std::vector<std::string> faults;
  for (std::size_t i = 0; i < names.size(); ++i) {
    GrainSeed g;
    g.id = context.firstId + static_cast<std::int64_t>(i);
    const auto species = std::find_if(scene.species.begin(), scene.species.end(),
                                      [&](const Species& s) { return s.name == names[i]; });
    g.species = static_cast<int>(species - scene.species.begin());
    g.radius = p.numbers("diameters")[i] / 2;
    g.position = context.open.wrapped(p.vectors("positions")[i]);
    g.velocity = p.vectors("velocities")[i];
    g.spin = p.vectors("spins")[i];
    const auto fault = [&](const std::string& what, const char* remedy = "move it") {
      faults.push_back(fmt::format("has grain {} at ({:.6g}, {:.6g}, {:.6g}) m {}; {}", i + 1, g.position.x(),
                                   g.position.y(), g.position.z(), what, remedy));
    };
    if (const std::string obstacle = context.open.obstacle(g.position, g.radius, mayOverlap);
        !obstacle.empty())
      fault("in or beyond " + obstacle);
    else if (const double overlap = context.placed.overlap(g.position, g.radius); overlap > mayOverlap)
      fault(fmt::format(
          "overlapping another grain by {:.3g} of the smaller radius, more than maximum_overlap = {}",
          overlap, mayOverlap));
    else if (const std::string wall = context.open.squeezedBy(g.position, g.radius); !wall.empty())
      fault(fmt::format("of a diameter of {:.6g} m, which the space at the wall '{}' is too narrow for",
                        2 * g.radius, wall),
            "move it, make it smaller or widen the space");
    context.placed.add(g.position, g.radius);
    grains.push_back(g);
  }
  constexpr std::size_t mostFaults = 20;
  if (faults.size() > mostFaults) faults.resize(mostFaults);
  if (!faults.empty()) throw InputError(faults);
  return grains;
}

} // namespace sandglass
