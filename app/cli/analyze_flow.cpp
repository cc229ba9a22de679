#include "app/cli/analyze_flow.h"

#include "analysis/contact_statistics.h"
#include "analysis/heap_angle.h"
#include "analysis/impact_map.h"
#include "analysis/outflow.h"
#include "analysis/residence.h"
#include "analysis/statistics.h"
#include "app/cli/scene_files.h"
#include "sim/base/error.h"
#include "sim/base/version.h"
#include "sim/io/series.h"

#include <fmt/format.h>

namespace sandglass::cli {

using namespace analysis;

namespace {

/// --frames, else the last frame.
std::pair<std::size_t, std::size_t> framesOrLast(const Source& source, const AnalyzeOptions& options) {
  if (!options.frames.empty()) return framesFor(source, options);
  return {source.frames->size() - 1, source.frames->size() - 1};
}

std::filesystem::path dischargedFile(const Source& source) {
  const auto file = source.path / "discharged.csv";
  if (!std::filesystem::exists(file))
    throw InputError(fmt::format("{}: there is no discharged.csv: give an outlet of the scene record = true",
                                 source.path.string()));
  return file;
}

/// Of a slot hopper as its scene says; else the middle of all places where grains left.
OutletFrame outletOf(const Source& source, const SeriesColumns& rows) {
  OutletFrame outlet;
  if (source.facts.wayOut) outlet.down = *source.facts.wayOut;
  if (source.facts.slot) {
    outlet.centre = source.facts.slot->centre;
    outlet.across = source.facts.slot->across;
    return outlet;
  }
  for (int k = 0; k < 3; ++k)
    if (const auto at = rows.find(std::string(1, "xyz"[k])); at != rows.end() && !at->second.value.empty())
      outlet.centre[k] = mean(at->second.value);
  return outlet;
}

} // namespace

void analyzeContacts(const Source& source, const AnalyzeOptions& options, ResultFiles& files) {
  const auto [from, to] = framesFor(source, options);
  const FramePtr first = source.frames->load(from);
  ContactStatistics statistics({options.bins / 2 > 0 ? options.bins / 2 : 1, diameterFor(options, *first)});
  for (std::size_t f = from; f <= to; ++f)
    statistics.add(*source.frames->load(f));
  for (Curve curve : {statistics.overlaps(), statistics.forces()}) {
    curve.provenance["frame_indices"] = fmt::format("{}:{}", from, to);
    stamp(curve, source, *first);
    files.write(curve, source.prefix);
    for (const char* kind : {"grain", "wall"}) {
      const auto number = [&](const char* name) {
        const auto it = curve.numbers.find(fmt::format("{}_{}", kind, name));
        return it == curve.numbers.end() ? 0.0 : it->second;
      };
      if (number("contacts") == 0) continue;
      if (curve.name == "overlaps")
        fmt::print("{}overlaps with a {}: mean {:.3g} d, greatest {:.3g} d, {} contacts\n", source.prefix,
                   kind, number("mean"), number("greatest"), number("contacts"));
      else
        fmt::print("{}contact forces with a {}: mean {:.4g} N, greatest {:.3g} means\n", source.prefix, kind,
                   number("mean_force"), number("greatest_over_mean"));
    }
  }
}

void analyzeResidence(const Source& source, const AnalyzeOptions&, ResultFiles& files) {
  const auto file = dischargedFile(source);
  Curve curve = residenceTimes(readSeries(file), 50, file.string());
  stamp(curve, source, *source.frames->load(0));
  files.write(curve, source.prefix);
  fmt::print("{}residence time: mean {:.4g} s, standard deviation {:.3g} s, median {:.4g} s, {} grains\n",
             source.prefix, curve.numbers["mean"], curve.numbers["standard_deviation"],
             curve.numbers["median"], curve.numbers["grains"]);
}

void analyzeOutflow(const Source& source, const AnalyzeOptions&, ResultFiles& files) {
  const auto file = dischargedFile(source);
  const SeriesColumns rows = readSeries(file);
  const OutletFrame outlet = outletOf(source, rows);
  const FramePtr first = source.frames->load(0);
  const auto write = [&](Curve curve) {
    stamp(curve, source, *first);
    files.write(curve, source.prefix);
    return curve;
  };
  const Curve places = write(outletPositions(rows, outlet, file.string()));
  const Curve speeds = write(outletVelocities(rows, outlet, file.string()));
  fmt::print("{}outflow: {} grains, {:.4g} m/s on the mean (standard deviation {:.3g} m/s)\n", source.prefix,
             places.numbers.at("grains"), speeds.numbers.at("mean_speed"),
             speeds.numbers.at("speed_deviation"));
  try {
    const Curve mixture = write(dischargeSegregation(rows, source.facts.densities, file.string()));
    const auto& n = mixture.numbers;
    fmt::print(
        "{}segregation of the discharge: SI {:.3f}, of a perfect mixture {:.3f}; slope {:.3f} +- {:.3f}\n",
        source.prefix, n.at("SI"), n.at("floor"), n.at("slope"), n.at("slope_error"));
  } catch (const InputError& e) { // grains of one size, or few of them
    fmt::print("{}segregation of the discharge left out: {}\n", source.prefix, e.what());
  }
}

void analyzeHeap(const Source& source, const AnalyzeOptions& options, ResultFiles& files) {
  if (!source.facts.slot)
    throw InputError(
        fmt::format("{}: the scene has no slot hopper (a wall of the kind wedge), whose heaps could be "
                    "looked at",
                    source.path.string()));
  const auto [from, to] = framesOrLast(source, options);
  const FramePtr frame = source.frames->load(to);
  Curve curve = heapAngle(*frame, {*source.facts.slot, diameterFor(options, *frame)});
  curve.provenance["frame_indices"] = fmt::format("{}", to);
  stamp(curve, source, *frame);
  files.write(curve, source.prefix);
  fmt::print("{}heap angle: {:.3g} +- {:.2g} deg (left {:.3g}, right {:.3g}) at {:.4g} s\n", source.prefix,
             curve.numbers["angle"], curve.numbers["angle_error"], curve.numbers["angle_left"],
             curve.numbers["angle_right"], frame->time);
}

void analyzeImpacts(const AnalyzeOptions& options, ResultFiles& files) {
  const auto located = locateScene(options.impactMap, false, {});
  const Scene scene = readScene(located.scene);
  Curve curve = impactMap(scene, {options.impactSpeed});
  curve.provenance["version"] = programVersion();
  curve.provenance["source"] = located.scene;
  files.write(curve);
  for (const auto& [name, value] : curve.numbers)
    if (name.ends_with(" restitution")) fmt::print("impacts of {}: {:.4f}\n", name, value);
}

} // namespace sandglass::cli
