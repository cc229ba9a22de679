// Speed of the vortex tank on one core: small scenes, where what a step costs beside its contacts shows, a
// large one, and the array program of tests/bench/vortex_numpy.py on the same tank. Rows of
//   case,program,threads,precision,grains,steps,cpu_s,wall_s,grain_steps_per_cpu_s,bytes_per_grain,check
// The check is a hash of the positions at the end; of the array program, the lag of its beads behind the
// flow.

#include "sim/base/error.h"
#include "sim/scene/scene.h"
#include "sim/solvers/dem/dem_solver.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <iostream>

using namespace sandglass;

namespace {

const std::string source = SANDGLASS_SOURCE_DIR;

struct Row {
  std::string name, program = "sandglass";
  std::int64_t grains = 0, steps = 0;
  double cpu = 0, wall = 0, bytes = 0;
  std::string check{};
  std::string text() const {
    if (wall == 0) return fmt::format("{},{},,,,,,,,,{}\n", name, program, check);
    return fmt::format("{},{},1,double,{},{},{:.4f},{:.4f},{:.4g},{},{}\n", name, program, grains, steps, cpu,
                       wall, static_cast<double>(grains) * static_cast<double>(steps) / cpu,
                       bytes > 0 ? fmt::format("{:.0f}", bytes) : "", check);
  }
};

class Clock {
public:
  double wall() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_).count();
  }
  double cpu() const { return static_cast<double>(std::clock() - cpu_) / CLOCKS_PER_SEC; }

private:
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
  std::clock_t cpu_ = std::clock();
};

Scene tank(const std::vector<std::string>& overrides) {
  return readScene(source + "/sample_runs/vortex_tank/scene.toml", overrides);
}

std::string hashOf(const DemSolver& solver) {
  std::string bytes;
  for (const GrainSeed& grain : solver.present())
    bytes.append(reinterpret_cast<const char*>(grain.position.data()), 3 * sizeof(double));
  return fmt::format("{:016x}", XXH3_64bits(bytes.data(), bytes.size()));
}

/// `before` steps to settle, then `steps` that are timed; every `look` steps a frame, as a classifier asks.
Row run(const std::string& name, const Scene& scene, std::int64_t before, std::int64_t steps,
        std::int64_t look = 0) {
  SolverOptions one;
  one.threads = 1;
  DemSolver solver(scene, one);
  solver.add(placeGrains(scene, scene.stages[0].name, 0, {}));
  solver.advance(before);
  const Clock clock;
  if (look == 0) solver.advance(steps);
  for (std::int64_t k = 0; look > 0 && k < steps; k += look) {
    solver.advance(look);
    solver.frame();
  }
  Row row;
  row.name = name;
  row.grains = static_cast<std::int64_t>(solver.grains());
  row.steps = steps;
  row.cpu = clock.cpu();
  row.wall = clock.wall();
  row.bytes = solver.bytesPerGrain();
  row.check = hashOf(solver);
  return row;
}

/// The same tank as array code.
Row arrays(std::int64_t steps) {
  Row row;
  row.name = "tank_256";
  row.program = "numpy";
  // Another python3 may stand before the system's, which has the package.
  const std::string command = fmt::format("for p in python3 /usr/bin/python3; do OMP_NUM_THREADS=1 $p "
                                          "{}/tests/bench/vortex_numpy.py {} 2>/dev/null && "
                                          "break; done",
                                          source, steps);
  std::FILE* pipe = popen(command.c_str(), "r");
  double lag = 0;
  long long done = 0;
  if (pipe && std::fscanf(pipe, "%lld %lf %lf %lf", &done, &row.wall, &row.cpu, &lag) == 4) {
    row.grains = 256;
    row.steps = done;
    row.check = fmt::format("lag {:.4g} m/s", lag);
  } else {
    row.wall = 0;
    row.check = "void: python3 with numpy is not installed";
  }
  if (pipe) pclose(pipe);
  return row;
}

} // namespace

int main(int argc, char** argv) {
  CLI::App app{"Speed of the vortex tank"};
  std::string csv;
  bool quick = false;
  app.add_option("--csv", csv, "write the rows here too");
  app.add_flag("--quick", quick, "a tenth of the steps, without the large tank");
  CLI11_PARSE(app, argc, argv);
  std::string all =
      "case,program,threads,precision,grains,steps,cpu_s,wall_s,grain_steps_per_cpu_s,bytes_per_"
      "grain,check\n";
  std::cout << all;
  const auto put = [&](const Row& row) {
    all += row.text();
    std::cout << row.text() << std::flush;
    return row;
  };
  try {
    const std::int64_t steps = quick ? 5'000 : 50'000;
    const Row whole = put(run("tank_256", tank({}), 0, steps));
    put(run("tank_256_looked_at", tank({}), 0, steps, 10));
    put(run("tank_256_rice2012", tank({"preset=\"rice2012\""}), 0, steps));
    for (const int grains : {16, 64})
      put(run(fmt::format("tank_{}", grains), tank({fmt::format("fill.1.number={}", grains)}), 0, steps));
    const Row other = put(arrays(quick ? 100 : 400));
    if (other.wall > 0)
      std::cout << fmt::format("# the array program takes {:.0f} times as long a step\n",
                               other.cpu / static_cast<double>(other.steps) *
                                   static_cast<double>(whole.steps) / whole.cpu);
    if (!quick) {
      // A wider tank with as many layers of beads, which fall from near the floor.
      const double radius = 0.06 * std::sqrt(1e5 / 256);
      std::vector<std::string> wide{
          fmt::format("domain.lower=[\"{0} m\",\"{0} m\",\"-21 cm\"]", -1.2 * radius),
          fmt::format("domain.upper=[\"{0} m\",\"{0} m\",\"2 m\"]", 1.2 * radius),
          fmt::format("wall.side.radius=\"{} m\"", radius),
          fmt::format("fill.1.radius=\"{} m\"", radius),
          "fill.1.number=100000",
          "fill.1.base=[\"0\",\"0\",\"-20 cm\"]",
          "fill.1.height=\"5 cm\"",
          "fill.1.velocity_spread=[\"0.1 m/s\",\"0.1 m/s\",\"0.1 m/s\"]",
          "field.rotation.angular_velocity=\"5 rad/s\""};
      put(run("tank_1e5", tank(wide), 1000, 300));
      Scene bare = tank(wide);
      bare.fields.clear();
      put(run("tank_1e5_no_fields", bare, 1000, 300));
    }
  } catch (const InputError& error) {
    std::cerr << error.what() << "\n";
    return 2;
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
  if (!csv.empty()) std::ofstream(csv) << all;
  return 0;
}
