// The sample runs in full, each against what it should come to. The glass hopper has a validation of its own.
// Usage: validate_samples SAMPLES_FOLDER FOLDER; writes FOLDER/samples.csv and the conical hopper's curve.

#include "analysis/beverloo.h"
#include "analysis/discharge.h"
#include "analysis/packing.h"
#include "sim/run/run.h"
#include "tests/validate/verdicts.h"
#include "vis/chart.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <numbers>

using namespace sandglass;
using namespace sandglass::validate;

namespace {

/// A run in full; keeps the last saved frame and the samples of one probe.
struct Full {
  FramePtr last, atRest; ///< at the end; when the stage `settle` ended
  std::vector<ProbeSample> samples;
  RunSummary summary;

  Full(const std::string& scene, const std::string& probe) {
    RunOptions options;
    Run run(readScene(scene), options);
    run.onSavedFrame = [&](FramePtr f) {
      if (f->stage == "settle") atRest = f;
      last = f;
    };
    run.onSample = [&](const ProbeSample& s) {
      if (s.probe == probe) samples.push_back(s);
    };
    run.execute();
    summary = run.summary();
    std::cerr << fmt::format("{}: {} steps, {:.0f} s\n", scene, summary.steps, summary.wallSeconds);
  }
};

void twoGrains(const std::string& scene, std::vector<Row>& rows) {
  const Full run(scene, "energy");
  const auto& v = run.last->vector(quantity::velocity);
  const double e = (v.at(1) - v.at(0)).norm() / 0.2;
  rows.push_back({"two_grains",
                  "restitution",
                  e,
                  0,
                  "0.9",
                  "1 %",
                  "the scene's own law",
                  std::abs(e / 0.9 - 1) < 0.01,
                  {}});
  const double p = (v[0] + v[1]).norm() / 0.1;
  rows.push_back(
      {"two_grains", "momentum over that of one grain", p, 0, "0", "1e-12", "conservation", p < 1e-12});
}

void settlingBox(const std::string& scene, std::vector<Row>& rows) {
  const Full run(scene, "weight");
  double weight = 0;
  for (const double m : run.last->scalar(quantity::mass))
    weight += m * 9.81;
  const double load = -run.samples.back().values.at("force.z");
  rows.push_back({"settling_box", "load on the box over the weight of the grains", load / weight, 0, "1",
                  "1 %", "equilibrium", std::abs(load / weight - 1) < 0.01});
  analysis::PackingProfile packing{{}};
  packing.add(*run.last);
  const analysis::Curve profile = packing.result();
  const double bulk = profile.numbers.at("packing_bulk");
  // Two sizes fill better than one; walls ten grains apart loosen the bed.
  rows.push_back({"settling_box", "packing fraction below the surface", bulk, 0, "0.55 ... 0.68", "",
                  "between random loose packing of one size (Onoda and Liniger 1990) and dense packing of "
                  "two sizes 1:1.7",
                  bulk > 0.55 && bulk < 0.68});
}

void hopperConical(const std::string& scene, const std::filesystem::path& folder, std::vector<Row>& rows) {
  const Full run(scene, "outflow");
  const Flow& flow = run.summary.flow;
  double present = 0;
  for (const double r : run.last->scalar(quantity::radius))
    present += 4.0 / 3.0 * std::numbers::pi * r * r * r * 2500.0;
  const double missing = (flow.massEntered - flow.massDischarged - present) / flow.massEntered;
  rows.push_back({"hopper_conical", "mass neither discharged nor present", missing, 0, "0", "1e-10",
                  "conservation", std::abs(missing) < 1e-10});
  rows.push_back(
      {"hopper_conical", "share of the grains discharged",
       static_cast<double>(flow.grainsDischarged) / static_cast<double>(flow.grainsEntered), 0, "> 0.99", "",
       "a 30 degree cone empties",
       static_cast<double>(flow.grainsDischarged) > 0.99 * static_cast<double>(flow.grainsEntered)});

  analysis::DischargeData data;
  for (const auto& s : run.samples) {
    data.time.push_back(s.time);
    data.mass.push_back(s.values.at("mass"));
  }
  analysis::DischargeOptions options;
  options.totalMass = flow.massEntered;
  const analysis::DischargeFit fit = analysis::fitDischarge(data, options);
  // Circular outlet with the cone's factor of Rose and Tanaka (1959): (tan(angle) tan(phi))^-0.35, phi = 45
  // degrees; bulk density with the solid fraction of a settled bed, 0.6.
  const double law = analysis::circularRate(0.6 * 2500, 9.81, 2e-2, 2.1e-3, 1.4) *
                     std::pow(std::tan(std::numbers::pi / 6), -0.35);
  rows.push_back({"hopper_conical", "rate over Beverloo's law (C 0.58, k 1.4, Rose-Tanaka for the cone)",
                  fit.rate / law, fit.halfWidth / law, "1", "25 %",
                  "Beverloo et al. 1961; Rose and Tanaka 1959", std::abs(fit.rate / law - 1) < 0.25});
  vis::writeChart(analysis::dischargeCurve(data, fit, options), folder / "hopper_conical_discharge.png");
}

} // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: validate_samples SAMPLES_FOLDER FOLDER\n";
    return 2;
  }
  const std::string samples = argv[1];
  const std::filesystem::path folder = argv[2];
  std::filesystem::create_directories(folder);
  std::vector<Row> rows;
  try {
    twoGrains(samples + "/two_grains/scene.toml", rows);
    settlingBox(samples + "/settling_box/scene.toml", rows);
    hopperConical(samples + "/hopper_conical/scene.toml", folder, rows);
  } catch (const std::exception& e) {
    std::cerr << "validate_samples: " << e.what() << "\n";
    return 1;
  }
  std::ofstream(folder / "samples.csv") << csv(rows);
  std::cout << csv(rows);
  return allOk(rows) ? 0 : 1;
}
