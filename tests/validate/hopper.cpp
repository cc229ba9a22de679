// Discharge of the dry slot hopper against Anand (PhD thesis, University of Florida, 2009): the base rate
// with three seeds, and the rate against the outlet width. Usage: validate_hopper SCENE FOLDER Writes
// FOLDER/hopper.csv (verdicts), hopper_rates.csv (every run), hopper_width.csv/.png, hopper_discharge.png.

#include "analysis/beverloo.h"
#include "analysis/discharge.h"
#include "analysis/statistics.h"
#include "sim/run/run.h"
#include "tests/validate/verdicts.h"
#include "vis/chart.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <thread>

using namespace sandglass;
using namespace sandglass::validate;

namespace {

constexpr double depth = 0.56e-2, diameter = 2.24e-3, gravity = 9.81, glass = 2500.0;

struct Case {
  std::uint64_t seed = 1;
  double outlet = 2.5e-2; ///< [m]
  analysis::DischargeData data;
  double totalMass = 0, rate = 0, error = 0; ///< [kg], [kg/(m s)], half width of the 95 % interval
};

std::string cm(double metres) {
  return fmt::format("{:.6g} cm", 100 * metres);
}

/// One run, one thread, nothing written. The rate is the slope of discharged mass between 10 and 50 %.
void execute(const std::string& file, Case& c) {
  // Bin, fill and number as in the base case; the lip grows with the outlet as in the source.
  std::vector<std::string> set{
      fmt::format("seed={}", c.seed),
      fmt::format("wall.hopper.outlet=\"{}\"", cm(c.outlet)),
      fmt::format("wall.hopper.lip=\"{}\"", cm(0.17 * c.outlet + 0.025e-2)),
      fmt::format("wall.gate.length=\"{}\"", cm(c.outlet)),
      fmt::format("probe.outflow.point=[\"0\", \"{}\", \"0\"]", cm(-0.17 * c.outlet - 0.025e-2)),
      "stage.discharge.until.mass_discharged=\"58 g\""};
  Scene scene = readScene(file, set);
  RunOptions options;
  options.threads = 1;
  Run run(scene, options);
  run.onSample = [&](const ProbeSample& s) {
    if (s.probe != "outflow") return;
    c.data.time.push_back(s.time);
    c.data.mass.push_back(s.values.at("mass"));
  };
  run.execute();
  c.totalMass = run.summary().flow.massEntered;
  analysis::DischargeOptions fit;
  fit.shares = {0.1, 0.5};
  fit.totalMass = c.totalMass;
  const analysis::DischargeFit result = analysis::fitDischarge(c.data, fit);
  c.rate = result.rate / depth;
  c.error = result.halfWidth / depth;
  std::cerr << fmt::format("seed {} outlet {}: {:.2f} +- {:.2f} g/(cm s)\n", c.seed, cm(c.outlet),
                           c.rate * 10, c.error * 10);
}

void write(const std::filesystem::path& file, const std::string& text) {
  if (!(std::ofstream(file) << text)) throw std::runtime_error("cannot write " + file.string());
}

} // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: validate_hopper SCENE FOLDER\n";
    return 2;
  }
  const std::filesystem::path folder = argv[2];
  std::filesystem::create_directories(folder);

  std::vector<Case> cases;
  for (const std::uint64_t seed : {1, 2, 3})
    cases.push_back({seed, 2.5e-2, {}, 0, 0, 0});
  for (const double outlet : {1.5e-2, 2.0e-2, 3.0e-2, 3.5e-2})
    cases.push_back({1, outlet, {}, 0, 0, 0});

  // Single-threaded runs side by side use the cores best.
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex guard;
  std::vector<std::jthread> workers;
  for (unsigned w = 0; w < std::max(1u, std::thread::hardware_concurrency()); ++w)
    workers.emplace_back([&] {
      for (std::size_t k; (k = next++) < cases.size();)
        try {
          execute(argv[1], cases[k]);
        } catch (...) {
          const std::lock_guard lock(guard);
          failure = std::current_exception();
        }
    });
  workers.clear();
  if (failure) try {
      std::rethrow_exception(failure);
    } catch (const std::exception& e) {
      std::cerr << "validate_hopper: " << e.what() << "\n";
      return 1;
    }

  std::vector<Row> rows;
  double mean = 0, spread = 0;
  for (int k = 0; k < 3; ++k)
    mean += cases[k].rate / 3;
  for (int k = 0; k < 3; ++k)
    spread += std::pow(cases[k].rate - mean, 2) / 2;
  spread = std::sqrt(spread);
  // Student's t for two degrees of freedom at 95 %: 4.303.
  rows.push_back({"V5 base rate", "rate per depth [g/(cm s)], mean of 3 seeds", 10 * mean,
                  10 * 4.303 * spread / std::sqrt(3.0), "140", "8 %",
                  "simulation 140.4, experiment 139.4 +- 16.7 (Anand 2009, table 4-2)",
                  std::abs(10 * mean / 140 - 1) < 0.08});
  for (int k = 0; k < 3; ++k)
    rows.push_back({"V5 base rate", fmt::format("rate per depth [g/(cm s)], seed {}", cases[k].seed),
                    10 * cases[k].rate, 10 * cases[k].error, "140", "8 %", "as above",
                    std::abs(10 * cases[k].rate / 140 - 1) < 0.08});

  std::vector<analysis::OutletRate> points;
  for (const Case& c : cases)
    if (c.seed == 1) points.push_back({c.outlet, c.rate, c.error / 1.96});
  std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.outlet < b.outlet; });
  const double flowing = 0.59 * glass; // solid fraction 0.59 of the source
  const analysis::BeverlooFit fit =
      analysis::fitBeverloo(points, analysis::OutletShape::slot, diameter, flowing, gravity);
  rows.push_back({"V6 outlet width", "R^2 of rate^(2/3) against width", fit.r2, 0, "> 0.99", "",
                  "Beverloo scaling", fit.r2 > 0.99});
  rows.push_back({"V6 outlet width", "C at flowing solid fraction 0.59", fit.c, 2 * fit.cError, "1.03",
                  "10 %", "Myers and Sellers 1977", std::abs(fit.c / 1.03 - 1) < 0.1});
  rows.push_back({"V6 outlet width", "k", fit.k, 2 * fit.kError, "1.0 ... 2.4", "",
                  "1.3 (Anand 2009); 1.5 +- 0.1 (literature)", fit.k >= 1.0 && fit.k <= 2.4});

  write(folder / "hopper.csv", csv(rows));
  std::string runs = "outlet_cm,seed,rate_g_per_cm_s,half_width_95,mass_entered_g\n";
  for (const Case& c : cases)
    runs += fmt::format("{:.3g},{},{:.3f},{:.3f},{:.4f}\n", 100 * c.outlet, c.seed, 10 * c.rate, 10 * c.error,
                        1e3 * c.totalMass);
  write(folder / "hopper_rates.csv", runs);
  const analysis::Curve width =
      analysis::beverlooCurve(points, fit, analysis::OutletShape::slot, diameter, flowing, gravity);
  write(folder / "hopper_width.csv", analysis::toCsv(width));
  vis::writeChart(width, folder / "hopper_width.png");
  analysis::DischargeOptions options;
  options.shares = {0.1, 0.5};
  options.totalMass = cases[0].totalMass;
  options.depth = depth;
  vis::writeChart(
      analysis::dischargeCurve(cases[0].data, analysis::fitDischarge(cases[0].data, options), options),
      folder / "hopper_discharge.png");
  std::cout << csv(rows);
  return allOk(rows) ? 0 : 1;
}
