#include "sim/scene/check_flow.h"

#include "sim/grains/fills.h"
#include "sim/grains/seeding.h"
#include "sim/scene/check_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sandglass {

namespace {

bool recycles(const Scene& scene) {
  return std::any_of(scene.outlets.begin(), scene.outlets.end(),
                     [](const OutletSpec& o) { return o.recycle.has_value(); });
}

/// The most mass that a filling can bring in; infinite for rain that has no number.
double largestMass(const Scene& scene, const FillSpec& fill) {
  const Parameters& p = fill.how.parameters;
  const auto sphere = [&](const std::string& species, double diameter) {
    return scene.material(scene.speciesNamed(species).material).density * std::numbers::pi / 6 * diameter *
           diameter * diameter;
  };
  if (fill.how.kind == "list") {
    double mass = 0;
    const auto& names = p.texts("species");
    for (std::size_t i = 0; i < names.size(); ++i)
      mass += sphere(names[i], p.numbers("diameters")[i]);
    return mass;
  }
  double heaviest = 0;
  for (const auto& share : fill.mixture)
    heaviest = std::max(heaviest,
                        sphere(share.species, sizeRange(scene, scene.speciesNamed(share.species)).largest));
  if (fill.how.kind == "rain" && !p.has("number")) return HUGE_VAL;
  const double count =
      fill.how.kind == "random" ? static_cast<double>(randomFillCount(scene, fill))
      : fill.how.kind == "rain"
          ? p.number("number")
          : ((p.vector("upper") - p.vector("lower")) / p.number("spacing")).array().max(1.0).prod() *
                std::numbers::sqrt2; // closest packing has sqrt 2 centres in a spacing cubed
  return count * heaviest;
}

} // namespace

void checkRecycling(const Scene& scene, FaultList& faults) {
  for (std::size_t i = 0; i < scene.outlets.size(); ++i) {
    const OutletSpec& outlet = scene.outlets[i];
    if (!outlet.recycle) continue;
    const RecycleSpec& box = *outlet.recycle;
    const std::string path = partPath("outlet", outlet.name, i) + ".recycle";
    checkBox(path, box.lower, box.upper, faults);
    if (faults.has(path)) continue;
    if (!(scene.gravity.norm() > 0))
      faults.about(path, "puts grains over the bed, but without gravity there is no over; give the scene "
                         "gravity or let the grains leave");
    double largest = 0;
    for (const auto& s : scene.species)
      largest = std::max(largest, sizeRange(scene, s).largest);
    for (int k = 0; k < 3; ++k) {
      const double size = box.upper[k] - box.lower[k], period = scene.domain.upper[k] - scene.domain.lower[k];
      const bool whole = scene.domain.periodic[static_cast<std::size_t>(k)] && size >= period * (1 - 1e-12);
      if (size < largest && !whole)
        faults.about(path, fmt::format("is {:.6g} m wide along {}, but grains are up to {:.6g} m; widen it",
                                       size, "xyz"[k], largest));
      if (!scene.domain.periodic[static_cast<std::size_t>(k)] &&
          (box.lower[k] < scene.domain.lower[k] || box.upper[k] > scene.domain.upper[k]))
        faults.about(path, fmt::format("reaches out of the domain along {}; move it inside", "xyz"[k]));
    }
    // A corner beyond the outlet: what is put there would leave at once.
    for (const auto& other : scene.outlets)
      for (int c = 0; c < 8 && !faults.has(path); ++c) {
        const Vec3 corner((c & 1 ? box.upper : box.lower).x(), (c & 2 ? box.upper : box.lower).y(),
                          (c & 4 ? box.upper : box.lower).z());
        if ((corner - other.point).dot(other.normal) > 0)
          faults.about(path, fmt::format("reaches beyond the outlet '{}', where grains are taken out again; "
                                         "move it back",
                                         other.name));
      }
  }
}

void checkEvents(const Scene& scene, FaultList& faults) {
  std::int64_t before = 0;
  for (std::size_t i = 0; i < scene.events.size(); ++i) {
    const EventSpec& event = scene.events[i];
    const std::string path = partPath("event", "", i);
    if (event.step < before)
      faults.wrong(path + ".step",
                   fmt::format("but the event before it is at step {}; order events by step", before));
    before = event.step;
    for (const auto& name : event.removeWalls)
      if (std::none_of(scene.walls.begin(), scene.walls.end(),
                       [&](const WallSpec& w) { return w.name == name; }))
        faults.wrong(path + ".remove_walls", fmt::format("but the scene has no [[wall]] '{}'", name));
    for (const auto& name : event.paceWalls)
      if (std::none_of(scene.walls.begin(), scene.walls.end(),
                       [&](const WallSpec& w) { return w.name == name && !w.motion.kind.empty(); }))
        faults.wrong(path + ".pace_walls",
                     fmt::format("but the scene has no [[wall]] '{}' with a motion", name));
    if (event.pace.has_value() == event.paceWalls.empty())
      faults.about(path, "changes the pace of walls by pace and pace_walls together; give both or neither");
    if (!event.gravity && !event.drag && event.removeWalls.empty() && event.fields.empty() &&
        event.paceWalls.empty() && !event.endStage)
      faults.about(path,
                   "changes nothing; give it gravity, drag, remove_walls, fields, pace_walls or end_stage");
  }
}

void checkEndings(const Scene& scene, FaultList& faults) {
  double mass = 0;
  for (std::size_t i = 0; i < scene.stages.size(); ++i) {
    const StageSpec& stage = scene.stages[i];
    const std::string path = partPath("stage", stage.name, i);
    bool endless = false;
    for (const auto& fill : scene.fills)
      if (fill.stage == stage.name) {
        mass += largestMass(scene, fill);
        endless = endless || (fill.how.kind == "rain" && !fill.how.parameters.has("number"));
      }
    const bool ends = stage.duration || stage.massDischarged || stage.quietTime || stage.recirculations;
    if (endless && !ends)
      faults.about(path,
                   "waits for rest or emptiness while a rain without 'number' goes on for ever; give the "
                   "rain a number or the stage a duration");
    if (stage.recirculations && !recycles(scene))
      faults.wrong(path + ".until.recirculations",
                   "but no [[outlet]] puts grains back; give one recycle = { lower = […], upper = […] }");
    if (stage.massDischarged && !recycles(scene) && *stage.massDischarged > mass)
      faults.wrong(path + ".until.mass_discharged",
                   fmt::format("but the fillings up to here bring in {:.6g} kg at most; lower it", mass));
  }
}

} // namespace sandglass
