// sandglass sweep: results, going on after kills with the same bits, failures, refinement, recomputing, job
// arrays.

#include "analysis/sweep/sweep_table.h"
#include "sim/base/random.h"
#include "sim/io/run_folder.h"
#include "tests/app/program.h"
#include "tests/app/started_program.h"
#include "tests/sim/frame_equality.h"
#include "tests/sim/small_hopper.h"
#include "tests/sim/temporary_folder.h"

#include <catch2/catch.hpp>

#include <chrono>
#include <fstream>
#include <sys/wait.h>

using namespace sandglass;
using namespace sandglass::analysis;
using namespace sandglass::test;
using Catch::Contains;

namespace fs = std::filesystem;

namespace {

/// A ball that falls on a floor: about a millisecond of computing.
constexpr const char* ball = R"(
seed = 7
gravity = ["0", "0", "-10 m/s^2"]
[domain]
lower = ["-1 cm", "-1 cm", "-1 cm"]
upper = ["1 cm", "1 cm", "20 cm"]
[[material]]
name = "glass"
density = "2500 kg/m^3"
[[contact]]
between = ["glass", "glass"]
normal = { law = "linear", collision_time = "0.2 ms", restitution = 0.5 }
[[species]]
name = "ball"
material = "glass"
size = { distribution = "single", diameter = "2 mm" }
[[wall]]
name = "floor"
kind = "plane"
material = "glass"
point = ["0", "0", "0"]
normal = [0, 0, 1]
[[fill]]
kind = "random"
species = "ball"
region = "box"
lower = ["-2 mm", "-2 mm", "10 cm"]
upper = ["2 mm", "2 mm", "12 cm"]
number = 1
[[stage]]
name = "fall"
until = { duration = "0.3 s" }
[[probe]]
name = "energy"
kind = "energies"
interval = "10 ms"
[output]
frame_interval = "20 ms"
quantities = ["velocity"]
)";

constexpr const char* sweepOfBalls = R"(
title = "Balls"
scene = "ball.toml"
seeds = 2
[[axis]]
name = "e"
key = "contact.1.normal.restitution"
values = [0.2, 0.5, 0.8]
[[axis]]
name = "d"
key = "species.ball.size.diameter"
unit = "mm"
from = 1
to = 3
count = 5
)";

void write(const fs::path& file, const std::string& text) {
  std::ofstream(file) << text;
}

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::size_t doneIn(const fs::path& folder) {
  std::size_t done = 0;
  for (const auto& row : SweepTable(folder).rows())
    done += row.status == SweepStatus::done;
  return done;
}

/// Kills it some time after it has done `runs` more.
int killSweepAfter(pid_t child, const fs::path& folder, std::size_t runs, double part) {
  const bool there = fs::exists(folder / SweepTable::fileName);
  const std::size_t before = there ? doneIn(folder) : 0;
  return killAfter(child, runs, part, std::chrono::milliseconds(1), [&] {
    try {
      return runs == 0 || (fs::exists(folder / SweepTable::fileName) && doneIn(folder) >= before + runs);
    } catch (const std::exception&) {
      return false; // the table is being made, or locked
    }
  });
}

pid_t start(const fs::path& sweep, const fs::path& folder, int threads) {
  return startProgram({"sweep", sweep.string(), "-o", folder.string(), "--threads", std::to_string(threads)});
}

} // namespace

TEST_CASE("a sweep is its single runs, and its points can be computed again", "[sweep]") {
  const TemporaryFolder folder("sweep");
  write(folder / "ball.toml", ball);
  write(folder / "SWEEP.toml", sweepOfBalls);
  const std::string all = (folder / "all").string();
  const Result result = program("sweep " + (folder / "SWEEP.toml").string() + " -o " + all);
  INFO(result.text);
  REQUIRE(result.code == 0);
  CHECK_THAT(result.text, Contains("15 points, 30 runs: 30 done, 0 failed, 0 waiting"));

  const SweepTable table(folder / "all");
  const auto rows = table.rows();
  REQUIRE(rows.size() == 30);
  CHECK(rows[0].seed == 7);
  CHECK(rows[29].seed == 8);
  // Coarse first: the corners and, of five, the middle before what lies between.
  const auto points = table.points();
  CHECK(points[0].values == std::vector<SweepValue>{0.2, 1.0});
  CHECK(points[1].values == std::vector<SweepValue>{0.2, 3.0});
  CHECK(points.back().values == std::vector<SweepValue>{0.8, 2.5});
  const auto axis = table.column("d"), energy = table.column("energy.total");
  CHECK(table.columns()[axis].unit == "mm");
  CHECK(table.columns()[energy].unit == "J");

  const SweepRow& row = rows[17];
  const Scene scene = table.scene(row.run);
  CHECK(scene.seed == row.seed);
  CHECK(scene.species[0].size.parameters.number("diameter") == Approx(1e-3 * row.number(axis)));
  const std::string run = (folder / "run").string();
  const Result again = program("sweep " + all + " --recompute " + std::to_string(row.point) +
                               " --replicate " + std::to_string(row.replicate) + " -o " + run);
  INFO(again.text);
  REQUIRE(again.code == 0);
  CHECK_THAT(again.text, Contains("has the bits that the sweep kept"));
  const auto frames = openFrames(run);
  REQUIRE(frames->size() == 16);
  const FramePtr last = frames->load(15), kept = table.lastFrame(row.run);
  CHECK(last->position == kept->position);
  CHECK(last->vector("velocity") == kept->vector("velocity"));
  CHECK(last->step == kept->step);
  REQUIRE(kept->walls.size() == 1);
  const auto curves = table.curves(row.run);
  const auto total =
      std::find_if(curves.begin(), curves.end(), [](const Curve& c) { return c.name == "energy.total"; });
  REQUIRE(total != curves.end());
  CHECK(total->series[0].x.size() == 31);
  CHECK(total->series[0].y.back() == static_cast<float>(row.number(energy)));

  // Changed plans are refused, the same one has nothing to do.
  const std::string before = table.csv(true);
  CHECK(program("sweep " + (folder / "SWEEP.toml").string() + " -o " + all + " --threads 1").code == 0);
  CHECK(SweepTable(folder / "all").csv(true) == before);
  write(folder / "SWEEP.toml", std::string(sweepOfBalls) + "\n# changed\n");
  const Result other = program("sweep " + (folder / "SWEEP.toml").string() + " -o " + all);
  CHECK(other.code == 2);
  CHECK_THAT(other.text, Contains("holds another sweep"));
}

TEST_CASE("a sweep killed at ten random moments ends with the same table", "[sweep]") {
  const TemporaryFolder folder("sweep-kill");
  write(folder / "hopper.toml", smallHopper);
  write(folder / "SWEEP.toml", R"(
scene = "hopper.toml"
set = ["stage.settle.until.duration=\"10 ms\"", "stage.discharge.until.duration=\"20 ms\""]
seeds = [3, 4]
[[axis]]
name = "friction"
key = "contact.1.tangential.friction"
from = 0.1
to = 0.9
count = 6
[[axis]]
name = "outlet"
keys = ["wall.hopper.outlet"]
unit = "cm"
values = [1, 1.1, 1.2]
[refine]
by = "energy.total"
difference = 1e-6
levels = 1
)");
  int status = 0;
  waitpid(start(folder / "SWEEP.toml", folder / "whole", 2), &status, 0);
  REQUIRE(status == 0);
  const SweepTable whole(folder / "whole");
  REQUIRE(whole.rows().size() > 36); // refined
  // Moments are counted in runs that are done, not in seconds: on a machine of any speed they lie all over
  // the sweep. One that ends all the same, since this test had to wait for a core, is begun anew.
  int kills = 0;
  std::size_t progress = 0, most = 0;
  for (std::uint64_t trial = 0; kills < 10 && trial < 200; ++trial) {
    RandomStream random(6, RandomPurpose::test, trial);
    const pid_t child = start(folder / "SWEEP.toml", folder / "killed", 1 + static_cast<int>(trial % 3));
    status = killSweepAfter(child, folder / "killed", static_cast<std::size_t>(random.uniform(0, 6)),
                            random.uniform());
    if (!WIFSIGNALED(status)) {
      REQUIRE(status == 0);
      CHECK(SweepTable(folder / "killed").csv(true) == whole.csv(true));
      fs::remove_all(folder / "killed");
      progress = 0;
      continue;
    }
    ++kills;
    if (!fs::exists(folder / "killed" / SweepTable::fileName)) continue;
    const std::size_t done = doneIn(folder / "killed"); // whole at any moment
    CHECK(done >= progress);                            // what is there stays
    progress = done;
    most = std::max(most, done);
  }
  CHECK(kills == 10);
  CHECK(most > 0);
  waitpid(start(folder / "SWEEP.toml", folder / "killed", 2), &status, 0);
  REQUIRE(status == 0);
  CHECK(SweepTable(folder / "killed").csv(true) == whole.csv(true));
  CHECK(content(folder / "killed" / "sweep.csv") == content(folder / "whole" / "sweep.csv"));
}

TEST_CASE("failed runs are rows with their sentence", "[sweep]") {
  const TemporaryFolder folder("sweep-fail");
  write(folder / "ball.toml", ball);
  write(folder / "SWEEP.toml", R"(
scene = "ball.toml"
[[axis]]
name = "overlap"
key = "accuracy.maximum_overlap"
values = [1e-6, 0.5, 5]
)");
  const Result result =
      program("sweep " + (folder / "SWEEP.toml").string() + " -o " + (folder / "all").string());
  INFO(result.text);
  CHECK(result.code == 0);
  const auto rows = SweepTable(folder / "all").rows();
  CHECK(rows[0].status == SweepStatus::failed); // while running
  CHECK_THAT(rows[0].fault, Contains("maximum_overlap"));
  CHECK(rows[1].status == SweepStatus::failed); // the scene is wrong here
  CHECK_THAT(rows[1].fault, Contains("maximum_overlap is 5, but must not be above"));
  CHECK(rows[2].status == SweepStatus::done);
  CHECK(program("sweep " + (folder / "SWEEP.toml").string() + " --dry-run").code == 2);
}

TEST_CASE("the shares of a job array, gathered, are the sweep of one machine", "[sweep]") {
  const TemporaryFolder folder("sweep-slurm");
  write(folder / "ball.toml", ball);
  write(folder / "SWEEP.toml", std::string(sweepOfBalls) + R"(
[refine]
by = "energy.total"
difference = 1e-5
)");
  const std::string sweep = (folder / "SWEEP.toml").string(), all = (folder / "all").string();
  REQUIRE(program("sweep " + sweep + " -o " + (folder / "one").string()).code == 0);
  Result result;
  for (int round = 0; round < 3; ++round) {
    result = program("sweep " + sweep + " -o " + all + " --slurm 4");
    INFO(result.text);
    REQUIRE(result.code == 0);
    // The scripts as Slurm would run them.
    const std::string script = all + "/slurm/array.sh";
    for (int k = 0; k < 4; ++k)
      REQUIRE(std::system(("SLURM_ARRAY_TASK_ID=" + std::to_string(k) + " bash '" + script + "' > /dev/null")
                              .c_str()) == 0);
    result = program("sweep " + all + " --gather");
    INFO(result.text);
    if (result.code == 0) break;
    CHECK_THAT(result.text, Contains("refinement has added"));
  }
  CHECK(result.code == 0);
  CHECK_THAT(content(folder / "all" / "slurm" / "array.sh"), Contains("#SBATCH --array=0-3"));
  CHECK(SweepTable(folder / "all").rows().size() > 30);
  CHECK(SweepTable(folder / "all").csv(true) == SweepTable(folder / "one").csv(true));
  // A share that has done nothing: the gathering says so.
  REQUIRE(program("sweep " + sweep + " -o " + (folder / "part").string() + " --slurm 2").code == 0);
  REQUIRE(program("sweep " + (folder / "part").string() + " --share 1/2").code == 0);
  const Result half = program("sweep " + (folder / "part").string() + " --gather");
  CHECK(half.code == 1);
  CHECK_THAT(half.text, Contains("15 runs from 1 shares") && Contains("15 runs are waiting"));
}

TEST_CASE("what sweeps refuse", "[sweep]") {
  const TemporaryFolder folder("sweep-wrong");
  write(folder / "ball.toml", ball);
  const auto refused = [&](const std::string& text, const std::string& sentence) {
    write(folder / "S.toml", text);
    const Result result = program("sweep " + (folder / "S.toml").string() + " -o " + (folder / "x").string());
    INFO(result.text);
    CHECK(result.code == 2);
    CHECK_THAT(result.text, Contains(sentence));
    CHECK_FALSE(fs::exists(folder / "x" / SweepTable::fileName));
  };
  const std::string head = "scene = \"ball.toml\"\n", axis = "[[axis]]\nname = \"a\"\n";
  refused(head, "there is no [[axis]]");
  refused(axis + "values = [1]", "'scene' is missing");
  refused("scene = \"none.toml\"\n" + axis + "values = [1]", "cannot be opened");
  refused(head + axis, "lacks values, or from, to and count");
  refused(head + axis + "values = [1, 1]", "a value stands twice");
  refused(head + axis + "values = [1, 0]\nscale = \"log\"", "none but positive");
  refused(head + axis + "values = [1]\nunit = \"parrots\"", "not a known unit");
  refused(head + axis + "values = [\"3 kg\"]\nunit = \"m\"", "a mass");
  refused(head + axis + "values = [1]\nfrom = 2", "both values and from");
  refused(head + axis + "values = [1]\nkind = 2", "is not a known key");
  refused(head + axis + axis + "values = [1]", "which is taken already");
  refused(head + "seeds = 0\n" + axis + "values = [1]", "a number of seeds from 1");
  refused(head + "sampling = \"random\"\n" + axis + "from = 0\nto = 1", "need the key 'points'");
  refused(head + "sampling = \"random\"\npoints = 3\n" + axis + "from = 0\nto = 1\n[refine]", "needs a grid");
  refused(head + axis + "values = [1]\n[[derived]]\nname = \"b\"\nvalue = \"2 * c\"",
          "is no expression of a");
  refused(head + "sampling = \"sobol\"\n" + axis + "values = [1]",
          "allowed are: grid, random, latin_hypercube");
  refused(head + "key = 1\n" + axis + "values = [1]", "is not a known key");
  refused(head + axis + "key = \"species.ball.size.diametre\"\nvalues = [1, 2]",
          "no scene of this sweep reads");
  refused(head + axis + "values = [0]\n[[derived]]\nname = \"b\"\nvalue = \"1 / a\"", "no finite number");
  // One sentence, not another about what it hides.
  write(folder / "S.toml", head + "states = \"gas\"\n" + axis + "values = [1]");
  CHECK_THAT(program("sweep " + (folder / "S.toml").string() + " --dry-run").text,
             !Contains("'scene' is missing"));
  // What refinement goes by is known with the first run, and the sweep ends there.
  write(
      folder / "S.toml",
      head + axis +
          "key = \"contact.1.normal.restitution\"\nvalues = [0.2, 0.4, 0.6, 0.8]\n[refine]\nby = \"colour\"");
  const Result late =
      program("sweep " + (folder / "S.toml").string() + " --threads 1 -o " + (folder / "late").string());
  CHECK(late.code == 2);
  CHECK_THAT(late.text, Contains("there is no column 'colour'"));
  CHECK(SweepTable(folder / "late").rows()[3].status == SweepStatus::waiting);
  CHECK(program("sweep " + (folder / "nothing").string()).code == 2);
  CHECK(program("sweep " + folder.path().string() + " --share 4/4").code == 2);
}
