// sandglass analyze: runs and frame files to curves and numbers.

#include "analysis/beverloo.h"
#include "analysis/discharge.h"
#include "analysis/fill_height.h"
#include "analysis/hopper_angle.h"
#include "analysis/packing.h"
#include "analysis/series_data.h"
#include "analysis/whole_circle.h"
#include "app/cli/analyze_flow.h"
#include "app/cli/analyze_kinds.h"
#include "app/cli/analyze_options.h"
#include "app/cli/analyze_source.h"
#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "app/cli/result_files.h"
#include "sim/base/error.h"
#include "sim/io/frame_segment.h"
#include "sim/scene/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <numbers>

namespace sandglass::cli {

namespace {

namespace fs = std::filesystem;
using namespace analysis;

void analyzePacking(const Source& source, const AnalyzeOptions& options, ResultFiles& files) {
  if (!source.facts.up)
    throw InputError(fmt::format("{}: without gravity there is no height, so no packing fraction by height",
                                 source.path.string()));
  const auto [from, to] = framesFor(source, options);
  const FramePtr first = source.frames->load(from);
  PackingOptions o;
  o.up = *source.facts.up;
  o.diameter = diameterFor(options, *first);
  o.region = limitsFor(source, options, o.diameter);
  PackingProfile profile(o);
  WholeCircle circle(source.facts.sector);
  for (std::size_t f = from; f <= to; ++f) {
    const FramePtr frame = source.frames->load(f);
    if (source.facts.sector.whole())
      profile.add(*frame);
    else
      profile.add(circle.add(*frame));
  }
  Curve curve = profile.result();
  curve.provenance["frame_indices"] = fmt::format("{}:{}", from, to);
  stamp(curve, source, *first);
  files.write(curve, source.prefix);
  if (curve.numbers.contains("packing_bulk"))
    fmt::print("{}packing fraction of the bulk: {:.4f} +- {:.1g} ({} frame{} from {:.4g} s)\n", source.prefix,
               curve.numbers.at("packing_bulk"), curve.numbers.at("packing_bulk_error"), curve.frames,
               curve.frames == 1 ? "" : "s", first->time);
  else
    fmt::print("{}packing fraction: the bed is too shallow for a bulk value\n", source.prefix);
}

/// From the flow_rate probe where there is one, else from the masses of the frames.
DischargeData dischargeDataOf(const Source& source, const AnalyzeOptions& options) {
  const fs::path series = source.path / "series.csv";
  const std::string probe = options.probe.empty() ? source.facts.flowProbe : options.probe;
  if (!probe.empty() && fs::exists(series)) return dischargeOf(readSeries(series), probe, series.string());
  if (!options.probe.empty())
    throw InputError(
        fmt::format("{}: there is no series.csv with the probe '{}'", source.path.string(), probe));
  return dischargeOf(*source.frames, source.facts.grainDensity);
}

std::pair<DischargeFit, Curve> dischargeFor(const Source& source, const AnalyzeOptions& options) {
  const DischargeData data = dischargeDataOf(source, options);
  DischargeOptions o;
  if (!options.shares.empty()) o.shares = shareRange(options.shares);
  o.depth =
      !options.depth.empty() ? lengthOption("--depth", options.depth, 0) : source.facts.slotDepth.value_or(0);
  const DischargeFit fit = fitDischarge(data, o);
  return {fit, dischargeCurve(data, fit, o)};
}

double flowingDensity(const Source& source, const AnalyzeOptions& options) {
  if (!options.flowingDensity.empty()) return parseQuantity(options.flowingDensity, "kg/m^3");
  if (!(source.facts.grainDensity > 0))
    throw InputError(fmt::format(
        "{}: the density of the grains is unknown, which Beverloo's law needs: give --flowing-density",
        source.path.string()));
  return 0.59 * source.facts.grainDensity;
}

/// The law beside one run's rate, per depth for a slot.
void compareWithBeverloo(const Source& source, const AnalyzeOptions& options, Curve& curve) {
  if (!source.facts.shape || !(source.facts.gravity > 0)) return;
  const double d = diameterFor(options, *source.frames->load(settledFrame(source))),
               rho = flowingDensity(source, options);
  const bool slot = *source.facts.shape == OutletShape::slot;
  if (slot && !curve.numbers.contains("depth")) return;
  const double depth = slot ? curve.numbers.at("depth") : 1;
  const double law = slot ? slotRate(rho, source.facts.gravity, depth, source.facts.outlet, d, 1.5)
                          : circularRate(rho, source.facts.gravity, source.facts.outlet, d);
  curve.numbers["beverloo_rate"] = law;
  curve.numbers["beverloo_ratio"] = curve.numbers.at("rate") / law;
  // Both corrections are printed: they disagree below 45 degrees.
  const double angle = source.facts.halfAngle, stagnant = std::numbers::pi / 4;
  curve.numbers["brown_richards_factor"] = brownRichards(angle, *source.facts.shape);
  curve.numbers["rose_tanaka_factor"] = roseTanaka(angle, stagnant);
  fmt::print("{}  Beverloo's law (k = 1.5, C = {}, flowing density {:.5g} kg/m^3): {:.4g} kg/s; the run has "
             "{:.3f} of it; the half-angle of {:.3g} deg is to give {:.3f} (Brown & Richards) or {:.3f} "
             "(Rose & Tanaka)\n",
             source.prefix, slot ? 1.03 : 0.58, rho, law, curve.numbers.at("beverloo_ratio"),
             angle * 180 / std::numbers::pi, curve.numbers.at("brown_richards_factor"),
             curve.numbers.at("rose_tanaka_factor"));
}

/// Where the scene says where the outlet is and there are frames enough.
void writeRateByFillHeight(const Source& source, const AnalyzeOptions& options, ResultFiles& files) {
  if (!source.facts.up || !source.facts.outletCentre) return;
  const FramePtr first = source.frames->load(0);
  const double d = diameterFor(options, *source.frames->load(settledFrame(source)));
  std::vector<FillSample> samples;
  for (std::size_t f = 0; f < source.frames->size(); ++f) {
    const FramePtr frame = source.frames->load(f);
    samples.push_back({frame->time, fillHeight(*frame, *source.facts.up, *source.facts.outletCentre, d)});
  }
  try {
    Curve curve = rateByFillHeight(dischargeDataOf(source, options), samples, source.facts.outlet);
    stamp(curve, source, *first);
    files.write(curve, source.prefix);
  } catch (const InputError& e) {
    fmt::print("{}{}\n", source.prefix, e.what());
  }
}

void analyzeDischarge(const Source& source, const AnalyzeOptions& options, ResultFiles& files) {
  auto [fit, curve] = dischargeFor(source, options);
  fmt::print("{}discharge rate: {:.5g} +- {:.2g} kg/s (95 %), from {:.4g} s to {:.4g} s", source.prefix,
             fit.rate, fit.halfWidth, fit.startTime, fit.endTime);
  if (curve.numbers.contains("depth")) {
    const double depth = curve.numbers.at("depth");
    // 1 kg/(m s) is 10 g/(cm s).
    fmt::print("; per depth {:.5g} +- {:.2g} kg/(m s) = {:.4g} +- {:.2g} g/(cm s)", fit.rate / depth,
               fit.halfWidth / depth, 10 * fit.rate / depth, 10 * fit.halfWidth / depth);
  }
  fmt::print("\n");
  compareWithBeverloo(source, options, curve);
  stamp(curve, source, *source.frames->load(0));
  files.write(curve, source.prefix);
  writeRateByFillHeight(source, options, files);
}

void analyzeEnergies(const Source& source, const AnalyzeOptions&, ResultFiles& files) {
  const fs::path series = source.path / "series.csv";
  if (source.facts.energyProbe.empty() || !fs::exists(series))
    throw InputError(
        fmt::format("{}: the run has no energies probe: add one to its scene", source.path.string()));
  Curve curve = energyCurve(readSeries(series), source.facts.energyProbe, series.string());
  stamp(curve, source, *source.frames->load(0));
  files.write(curve, source.prefix);
  fmt::print("{}energies: {} samples of {} kinds\n", source.prefix, curve.series[0].x.size(),
             curve.series.size());
}

void analyzeBeverloo(const std::vector<Source>& sources, const AnalyzeOptions& options, ResultFiles& files) {
  std::vector<OutletRate> points;
  for (const auto& source : sources) {
    if (!source.facts.shape || source.facts.shape != sources[0].facts.shape)
      throw InputError(
          fmt::format("{}: Beverloo's fit needs runs that all have a wedge or all a cone_hopper wall",
                      source.path.string()));
    const auto [fit, curve] = dischargeFor(source, options);
    const bool slot = *source.facts.shape == OutletShape::slot;
    if (slot && !curve.numbers.contains("depth"))
      throw InputError(
          fmt::format("{}: the depth of the slot is unknown, since it is not periodic: give --depth",
                      source.path.string()));
    const double depth = slot ? curve.numbers.at("depth") : 1;
    points.push_back({source.facts.outlet, fit.rate / depth, fit.standardError / depth});
  }
  const Source& first = sources[0];
  const FramePtr frame = first.frames->load(settledFrame(first));
  const double d = diameterFor(options, *frame), rho = flowingDensity(first, options);
  const BeverlooFit fit = fitBeverloo(points, *first.facts.shape, d, rho, first.facts.gravity);
  Curve curve = beverlooCurve(points, fit, *first.facts.shape, d, rho, first.facts.gravity);
  stamp(curve, first, *frame);
  curve.provenance.erase("source");
  for (std::size_t i = 0; i < sources.size(); ++i)
    curve.provenance[fmt::format("source_{}", i + 1)] = sources[i].path.string();
  files.write(curve);
  fmt::print("Beverloo's law from {} runs: k = {:.3g} +- {:.2g}, C = {:.4g} +- {:.2g}, R^2 = {:.5f}\n",
             points.size(), fit.k, fit.kError, fit.c, fit.cError, fit.r2);
}

int analyze(AnalyzeOptions options) {
  if (options.list) {
    printAnalysisKinds();
    return 0;
  }
  if (options.folder.empty()) throw InputError("name a folder for the results: -o DIR");
  const bool chosen = !options.kinds.empty() || options.packing || options.discharge || options.energies ||
                      options.beverloo || options.contacts || options.residence || options.outflow ||
                      options.heap || !options.impactMap.empty();
  if (!chosen) options.all = true;
  if (options.sources.empty() && options.impactMap.empty())
    throw InputError("name a run folder or a frame file to analyse");
  std::vector<Source> sources;
  std::map<std::string, int> used;
  for (const auto& text : options.sources) {
    sources.push_back(openSource(text, options.sources.size() > 1, options));
    // Two runs called "run" in different folders must not overwrite each other's files.
    std::string& prefix = sources.back().prefix;
    if (const int before = used[prefix]++; before > 0) prefix = fmt::format("{}{}_", prefix, before + 1);
  }
  ResultFiles files(options.folder, options.csvOnly);

  // What was asked for by name is an error when it cannot be had; what --all tries is left out with the
  // reason.
  const auto attempt = [&](bool wanted, const char* name, const std::string& prefix, auto&& work) {
    if (!wanted && !options.all) return;
    try {
      work();
    } catch (const InputError& e) {
      if (wanted) throw;
      fmt::print("{}{} left out: {}\n", prefix, name, e.what());
    }
  };
  if (!options.impactMap.empty()) analyzeImpacts(options, files);
  for (const auto& source : sources) {
    attempt(options.discharge, "discharge", source.prefix, [&] { analyzeDischarge(source, options, files); });
    attempt(options.energies, "energies", source.prefix, [&] { analyzeEnergies(source, options, files); });
    attempt(options.packing, "packing", source.prefix, [&] { analyzePacking(source, options, files); });
    attempt(options.contacts, "contacts", source.prefix, [&] { analyzeContacts(source, options, files); });
    attempt(options.residence, "residence times", source.prefix,
            [&] { analyzeResidence(source, options, files); });
    attempt(options.outflow, "outflow", source.prefix, [&] { analyzeOutflow(source, options, files); });
    attempt(options.heap, "heap angle", source.prefix, [&] { analyzeHeap(source, options, files); });
    for (const auto& kind : analysisKinds())
      attempt(std::find(options.kinds.begin(), options.kinds.end(), kind.name) != options.kinds.end(),
              kind.title.c_str(), source.prefix, [&] { analyzeKind(kind, source, options, files); });
  }
  if (options.beverloo || sources.size() > 1)
    attempt(options.beverloo, "Beverloo's fit", "", [&] { analyzeBeverloo(sources, options, files); });
  for (const auto& source : sources)
    printRemarks(*source.frames);
  fmt::print("results in {}\n", options.folder);
  return 0;
}

} // namespace

void addAnalyze(CLI::App& app, Action& action) {
  auto options = std::make_shared<AnalyzeOptions>();
  AnalyzeOptions& o = *options;
  CLI::App* command =
      app.add_subcommand("analyze", "Curves and numbers from runs or frame files: CSV, JSON, charts");
  command
      ->add_option(
          "source", o.sources,
          "run folders, .vtkhdf files, files of other programs, patterns such as 'dump.*' (one sequence)")
      ->type_name("RUN|FILE");
  command->add_option("-o,--output", o.folder, "folder for the results")->type_name("DIR");
  for (const auto& kind : analysisKinds())
    command->add_flag_callback(
        optionOf(kind), [&o, &kind] { o.kinds.push_back(kind.name); }, kind.description);
  command
      ->add_option("--knob", o.knobs, "knob of an analysis, such as gr.bins=400; may be repeated; see --list")
      ->type_name("NAME.KNOB=VALUE")
      ->allow_extra_args(false);
  command->add_flag("--list", o.list, "the analyses with what they need and their knobs, and nothing else");
  command->add_option("--up", o.up, "direction against gravity, where frames have no scene: 0,0,1")
      ->type_name("X,Y,Z");
  command->add_flag("--packing", o.packing, "packing fraction by height");
  command->add_flag("--discharge", o.discharge, "mass discharged against time and its rate");
  command->add_flag("--energies", o.energies, "energies against time");
  command->add_flag("--beverloo", o.beverloo, "Beverloo's law through the rates of several runs");
  command->add_flag("--contacts", o.contacts, "distributions of overlaps and contact forces");
  command->add_flag("--residence", o.residence, "residence times of the grains that an outlet recorded");
  command->add_flag("--outflow", o.outflow,
                    "where and how fast recorded grains left, and the mixture that came");
  command->add_flag("--heap", o.heap, "angle of the heaps that a slot hopper keeps");
  command
      ->add_option("--impact-map", o.impactMap,
                   "rebound slip against incident slip of single impacts with the laws of this scene")
      ->type_name("SCENE");
  command
      ->add_option("--impact-speed", o.impactSpeed,
                   "normal speed of these impacts in m/s (default: so slow that it hardly matters)")
      ->check(CLI::PositiveNumber);
  command->add_flag("--all", o.all, "everything that the input allows (the default)");
  command->add_option("--r-max", o.rMax, "largest distance of g(r): 5d or \"12 mm\"")
      ->capture_default_str()
      ->type_name("LENGTH");
  command->add_option("--bins", o.bins, "bins of g(r)")->capture_default_str()->check(CLI::Range(1, 1000000));
  command
      ->add_option("--estimator", o.estimator,
                   "E0 (none), E1 (guard zone), E2 (translation), E3 (local shell volume) or E4 "
                   "(inhomogeneous)")
      ->capture_default_str();
  command
      ->add_option("--heights", o.heights,
                   "heights of the profiles of --fields across the flow, along up from the origin: \"8 "
                   "cm,12 cm\" or 5d,10d (default: three)")
      ->type_name("LENGTH,...");
  command
      ->add_option("--radii", o.radii,
                   "distances from the axis of the profiles of --fields up the flow: \"0,1 cm\" or 0,5d "
                   "(default: 0)")
      ->type_name("LENGTH,...");
  command
      ->add_option("--frames", o.frames,
                   "indices for g(r) and packing, both ends used: 10:20, 10:, :, 10 (default: the last frame "
                   "before a gate opens, or the last)")
      ->type_name("A:B");
  command->add_option("--margin", o.margin, "distance of g(r) from the free surface (default 2d)")
      ->type_name("LENGTH");
  command->add_option("--limit", o.limits, "side to keep, such as \"y<5cm\"; may be repeated")
      ->type_name("PLANE")
      ->allow_extra_args(false);
  command->add_option("--diameter", o.diameter, "grain diameter, where frames have no radii")
      ->type_name("LENGTH");
  command
      ->add_option("--range", o.shares,
                   "fit the discharge between these shares of the mass, 0.1:0.5 (default: the even range)")
      ->type_name("A:B");
  command->add_option("--depth", o.depth, "depth of a slot, for the rate per depth (default: its period)")
      ->type_name("LENGTH");
  command->add_option("--probe", o.probe, "flow_rate probe of the discharge (default: the first)")
      ->type_name("NAME");
  command
      ->add_option("--flowing-density", o.flowingDensity,
                   "for Beverloo's law (default: 0.59 of the grains' density)")
      ->type_name("DENSITY");
  command->add_flag("--csv-only", o.csvOnly, "no JSON, no charts");
  addImportOptions(*command, o.import);
  command->callback([options, &action] { action = [options] { return analyze(*options); }; });
}

} // namespace sandglass::cli
