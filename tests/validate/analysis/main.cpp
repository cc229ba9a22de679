// The analyses against what is known: lattices, random points, voro++'s own program, and the state map on
// runs whose state is known beforehand. Usage: validate_analysis FOLDER [--quick]; writes FOLDER/analysis.csv
// and analysis.md.

#include "analysis/pair_correlation.h"
#include "analysis/registry.h"
#include "analysis/state_map.h"
#include "analysis/voronoi.h"
#include "sim/base/random.h"
#include "tests/analysis/lattices.h"
#include "tests/validate/analysis/lammps_frames.h"
#include "tests/validate/analysis/state_scenes.h"
#include "tests/validate/verdicts.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <numbers>
#include <sstream>

using namespace sandglass;
using namespace sandglass::analysis;
using namespace sandglass::analysis::test;
using namespace sandglass::validate;

namespace {

Results of(const std::string& name, const Frame& frame, const std::map<std::string, std::string>& knobs) {
  const AnalysisKind& kind = analysisKind(name);
  Parameters values = defaultKnobs(kind);
  for (const auto& [knob, text] : knobs)
    setKnob(values, kind, knob, text);
  return analyze(kind, values, {}, {std::make_shared<Frame>(frame)});
}

const Curve& curve(const Results& r, const std::string& name) {
  for (const auto& c : r.curves)
    if (c.name == name) return c;
  throw std::runtime_error("no curve " + name);
}

void lattices(Report& report) {
  const Frame fcc = faceCentredFrame(5), bcc = bodyCentredFrame(5);
  const Results order = of("order", fcc, {{"cutoff", "1.2"}});
  report.near("lattices", "q4 of fcc", curve(order, "q4").numbers.at("mean"), 0, 0.190941, 1e-5,
              "Steinhardt et al. 1983");
  report.near("lattices", "q6 of fcc", curve(order, "q6").numbers.at("mean"), 0, 0.574524, 1e-5,
              "Steinhardt et al. 1983");
  report.near("lattices", "w6 of fcc", curve(order, "w6").numbers.at("mean"), 0, -0.013161, 1e-4,
              "Steinhardt et al. 1983");
  report.near("lattices", "q6 of bcc, 14 neighbours",
              curve(of("order", bcc, {{"cutoff", "1.3"}}), "q6").numbers.at("mean"), 0, 0.510688, 1e-5,
              "Mickel et al. 2013");
  report.near("lattices", "packing of fcc",
              curve(of("voronoi", fcc, {}), "local_fraction").numbers.at("global_fraction"), 0,
              std::numbers::pi / std::sqrt(18), 1e-10, "Kepler");
  const Results voids = of("voids", fcc, {{"probes", "20000"}, {"v2", "false"}, {"grid", "false"}});
  report.near("lattices", "largest hole of fcc / d", curve(voids, "voids_v3").numbers.at("bulk_largest"), 0,
              (std::sqrt(2.0) - 1) / 2, 1e-9, "octahedral");
  const Results angles = of("bond_angles", fcc, {{"cutoff", "1.2"}});
  report.near("lattices", "bond angles a grain in fcc",
              curve(angles, "bond_angles").numbers.at("angles") / static_cast<double>(fcc.size()), 0, 66,
              1e-12, "12 11 / 2");
}

void uniformPoints(Report& report) {
  // Twelve frames of 4000 points in a cone: g by each estimator that corrects, mean over bins between 1 and 5
  // diameters.
  const FrameWall wall = sceneWall("frustum", {{"base", Vec3(0.5, 0.5, 0)},
                                               {"lower_radius", 0.1},
                                               {"upper_radius", 0.5},
                                               {"height", 1.2},
                                               {"ends", std::string("both")}});
  for (const Estimator e : {Estimator::localShell, Estimator::translation, Estimator::inhomogeneous}) {
    std::vector<double> means;
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
      const Frame frame = uniformFrame(4000, Vec3(1, 1, 1.2), {false, false, false}, 0.03, {wall}, 40 + seed);
      PairCorrelationOptions options;
      options.estimator = e;
      options.rMax = 0.3;
      options.bins = 10;
      options.seed = 1 + seed;
      const auto g = pairCorrelation(frame, options).g.series[0].y;
      double sum = 0;
      for (std::size_t b = 2; b < 10; ++b)
        sum += g[b] / 8;
      means.push_back(sum);
    }
    double mean = 0, square = 0;
    for (const double m : means)
      mean += m / 12;
    for (const double m : means)
      square += (m - mean) * (m - mean) / 11;
    const double half = 2.2 * std::sqrt(square / 12); // Student's t, 11 degrees of freedom, 95 %
    // Three half widths: 0.00004 of all correct programs fail.
    report.between("uniform points in a frustum", fmt::format("g by {}", nameOf(e)), mean, half, 1 - 3 * half,
                   1 + 3 * half, "1");
  }
}

/// Radical cells of random spheres by voro++'s own program.
void otherProgram(Report& report) {
  const std::string name = "radical Voronoi beside voro++",
                    quantity = "largest difference of a cell's volume, relative";
  if (std::system("command -v voro++ >/dev/null 2>&1") != 0) {
    report.recorded(name, quantity, 0, 0, "0", "voro++ command line", "voro++ is not installed");
    return;
  }
  const auto folder = std::filesystem::temp_directory_path() / "sandglass-voropp";
  std::filesystem::create_directories(folder);
  const auto file = folder / "points";
  Frame frame = uniformFrame(3000, Vec3::Ones(), {true, true, true}, 0.01, {}, 5);
  RandomStream random(2, RandomPurpose::test, 0);
  std::ofstream out(file);
  for (std::size_t i = 0; i < frame.size(); ++i) {
    frame.scalars[quantity::radius][i] = random.uniform(0.01, 0.02);
    out << fmt::format("{} {} {} {} {}\n", i, frame.position[i].x(), frame.position[i].y(),
                       frame.position[i].z(), frame.scalars[quantity::radius][i]);
  }
  out.close();
  if (std::system(
          fmt::format("cd '{}' && voro++ -r -p -c '%i %v' 0 1 0 1 0 1 points", folder.string()).c_str()) != 0)
    throw std::runtime_error("voro++ failed");
  const VoronoiCells cells = voronoiCells(frame, {});
  std::ifstream in(folder / "points.vol");
  double worst = 0;
  std::size_t i = 0, read = 0;
  for (double v = 0; in >> i >> v; ++read)
    worst = std::max(worst, std::abs(v / cells.volume[i] - 1));
  std::filesystem::remove_all(folder);
  report.between(name, "cells compared", static_cast<double>(read), 0, 2990, 3000, "voro++ command line");
  report.between(name, quantity, worst, 0, 0, 1e-4, "voro++ command line, six digits");
}

/// An inertial number that owes nothing to the map's kernel: velocities of layers one bead thick, averaged
/// over all frames, and the weight above them.
std::map<int, double> layerInertia(const std::vector<FramePtr>& frames) {
  constexpr double d = 0.002, area = 0.015 * 0.015;
  std::map<int, double> velocity, count, mass;
  for (const auto& f : frames)
    for (std::size_t i = 0; i < f->size(); ++i) {
      const int layer = static_cast<int>(f->position[i].z() / d);
      velocity[layer] += f->vector(quantity::velocity)[i].x();
      count[layer] += 1;
      mass[layer] += f->scalar(quantity::mass)[i] / static_cast<double>(frames.size());
    }
  const double weight = -gravityOf(KnownState::shear).z();
  std::map<int, double> inertia;
  for (const auto& [layer, n] : count) {
    if (!count.contains(layer - 1) || !count.contains(layer + 1)) continue;
    double above = 0.5 * mass[layer];
    for (const auto& [other, m] : mass)
      if (other > layer) above += m;
    const double rate =
        std::abs(velocity[layer + 1] / count[layer + 1] - velocity[layer - 1] / count[layer - 1]) / (2 * d);
    inertia[layer] = rate * d * std::sqrt(2500 / (above * weight / area));
  }
  return inertia;
}

void stateMap(Report& report, const std::vector<std::uint64_t>& seeds) {
  const std::map<KnownState, std::string> names{{KnownState::bed, "settled bed"},
                                                {KnownState::gas, "cooling gas"},
                                                {KnownState::shear, "shear at I = 0.03"}};
  const std::array<const char*, 3> states{"solid", "liquid", "gas"};
  for (const auto& [known, name] : names) {
    std::array<double, 3> all{};
    double grains = 0;
    std::map<std::string, std::array<double, 3>> moved;
    double motionCount = 0;
    for (const std::uint64_t seed : seeds) {
      const auto frames = runOf(known, seed);
      StateOptions options;
      options.diameter = 0.002;
      options.density = 2500;
      options.gravity = gravityOf(known).norm();
      if (options.gravity > 0) options.up = Vec3(-gravityOf(known) / options.gravity);
      StateMap map(options);
      const auto inertia = known == KnownState::shear ? layerInertia(frames) : std::map<int, double>{};
      for (std::size_t f = 0; f < frames.size(); ++f) {
        map.add(*frames[f]);
        if (f < 3) continue; // the memory has to fill
        for (std::size_t i = 0; i < frames[f]->size(); ++i) {
          if (known != KnownState::gas && frames[f]->scalar(quantity::species)[i] != 0)
            continue; // the rough floor
          if (known == KnownState::shear) {
            const auto it = inertia.find(static_cast<int>(frames[f]->position[i].z() / 0.002));
            if (it == inertia.end() || it->second < 0.02 || it->second > 0.045) continue;
          }
          all[static_cast<std::size_t>(map.states()[i])] += 1;
          grains += 1;
          StateThresholds base;
          const auto tally = [&](const std::string& what, const StateThresholds& limits) {
            moved[what][static_cast<std::size_t>(stateOf(map.motion()[i], limits))] += 1;
          };
          tally("", base);
          for (const double factor : {0.8, 1.2})
            for (const auto& [what, member] : {std::pair{"solid inertia", &StateThresholds::solidInertia},
                                               {"gas inertia", &StateThresholds::gasInertia},
                                               {"gas fraction", &StateThresholds::gasFraction},
                                               {"gas contacts", &StateThresholds::gasContacts},
                                               {"rearrangement", &StateThresholds::rearranged}}) {
              StateThresholds limits = base;
              limits.*member *= factor;
              tally(fmt::format("{} x {}", what, factor), limits);
            }
          motionCount += 1;
        }
      }
    }
    const std::size_t expected = known == KnownState::bed ? 0 : known == KnownState::shear ? 1 : 2;
    report.between("state map: " + name, fmt::format("share {}", states[expected]), all[expected] / grains, 0,
                   known == KnownState::shear ? 0.9 : 0.95, 1, "the state is known");
    for (std::size_t s = 0; s < 3; ++s)
      if (s != expected)
        report.recorded("state map: " + name, fmt::format("share {}", states[s]), all[s] / grains, 0, "0",
                        "confusion matrix", "recorded");
    double worst = 0;
    for (const auto& [what, share] : moved)
      for (std::size_t s = 0; s < 3; ++s)
        worst = std::max(worst, std::abs(share[s] - moved[""][s]) / motionCount);
    report.between("state map: " + name, "largest move of a share when a threshold moves by 20 %", worst, 0,
                   0, 0.05, "asked for");
  }
}

} // namespace

int main(int argc, char** argv) {
  CLI::App app{"the analyses against what is known"};
  std::string folder;
  bool quick = false;
  app.add_option("folder", folder, "where results go")->required();
  app.add_flag("--quick", quick, "one seed a state");
  CLI11_PARSE(app, argc, argv);
  try {
    Report report;
    lattices(report);
    uniformPoints(report);
    otherProgram(report);
    lammpsFrames(report);
    stateMap(report, quick ? std::vector<std::uint64_t>{1} : std::vector<std::uint64_t>{1, 2, 3});
    writeReport(report, folder, "analysis", "The analyses against what is known",
                "Exact values of lattices, random points in a container, voro++'s own program, LAMMPS' computes on the same frame, and the state "
                "map on small runs "
                "whose state is known: its rows are the confusion matrix. The sheared grains are those of "
                "layers whose inertial "
                "number, from mean velocities and the weight above, is between 0.02 and 0.045.\n",
                quick ? "seed 1" : "seeds 1 to 3");
    std::cout << csv(report.rows);
    return allOk(report.rows) ? 0 : 1;
  } catch (const std::exception& e) {
    std::cerr << "validate_analysis: " << e.what() << "\n";
    return 1;
  }
}
