#include "sim/base/error.h"
#include "sim/scene/scene.h"
#include "sim/scene/scene_reference.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <sstream>

using namespace sandglass;

namespace {

const std::string source = SANDGLASS_SOURCE_DIR;

/// A scene that uses every kind of table and every kind of law, filling, size and probe once.
const char* const rich = R"(
title = "quotes \" and \\ backslashes"
description = """
two
lines"""
seed = 9007199254740993
gravity = ["-0 m/s^2", "0", "-1.23456789012345678 m/s^2"]
[domain]
lower = ["-1 cm", "-1 cm", "0"]
upper = ["1 cm", "1 cm", "30 cm"]
periodic = ["x", "y"]
[[material]]
name = "glass"
density = "2.5 g/cm^3"
youngs_modulus = "63 GPa"
poisson_ratio = 0.244
[[material]]
name = "steel"
youngs_modulus = "200 GPa"
poisson_ratio = "30 %"
[[contact]]
between = ["glass", "glass"]
normal = { law = "hertz", restitution = 0.9 }
tangential = { law = "mindlin", friction = 0.3 }
rolling = { law = "elastic_plastic", coefficient = 0.01 }
[[contact]]
between = ["steel", "glass"]
normal = { law = "hertz", restitution = 0.8 }
tangential = { law = "mindlin", friction = 0.1 }
rolling = { law = "elastic_plastic", length = "0.1 mm" }
[[species]]
name = "a"
material = "glass"
size = { distribution = "single", diameter = "2.24 mm" }
[[species]]
name = "b"
material = "glass"
size = { distribution = "normal", mean = "1 mm", deviation = "0.1 mm", by = "mass" }
[[species]]
name = "c"
material = "glass"
size = { distribution = "lognormal", median = "1 mm", sigma = 0.2, largest = "2 mm" }
[[species]]
name = "d"
material = "glass"
size = { distribution = "table", diameters = ["1 mm", "1.5 mm"], shares = [1, 2.5] }
[[wall]]
name = "hopper"
kind = "cone_hopper"
material = "steel"
base = ["0", "0", "2 cm"]
outlet = "5 mm"
width = "2 cm"
half_angle = "30 deg"
height = "28 cm"
[[wall]]
name = "gate"
kind = "rectangle"
material = "steel"
centre = ["0", "0", "2 cm"]
normal = [0, 0, 1]
along = [1, 0, 0]
length = "6 mm"
breadth = "6 mm"
[[outlet]]
name = "out"
point = ["0", "0", "1 mm"]
normal = [0, 0, -1]
[[fill]]
kind = "random"
region = "cylinder"
base = ["0", "0", "8 cm"]
axis = [0, 0, 1]
radius = "9 mm"
height = "5 cm"
mass = "2 g"
mixture = [{ species = "a", fraction = 0.3 }, { species = "b", fraction = 0.7 }]
by = "mass"
velocity_spread = ["1 cm/s", "0", "0"]
[[fill]]
kind = "rain"
stage = "pour"
lower = ["-5 mm", "-5 mm", "25 cm"]
upper = ["5 mm", "5 mm", "27 cm"]
mass_rate = "3 g/s"
number = 100
species = "c"
[[fill]]
kind = "lattice"
structure = "fcc"
spacing = "2.5 mm"
lower = ["-5 mm", "-5 mm", "14 cm"]
upper = ["5 mm", "5 mm", "16 cm"]
species = "d"
[[fill]]
kind = "list"
grains = [{ species = "a", position = ["0", "0", "20 cm"], spin = ["0", "30 rpm", "0"] }]
[[stage]]
name = "fill"
until = { settled = "1 nJ", settled_after = "0.1 s", duration = "2 s" }
[[stage]]
name = "pour"
remove_walls = ["gate"]
until = { empty = true, mass_discharged = "50 mg", quiet = "0.1 s" }
[[probe]]
name = "e"
kind = "energies"
interval = "1 ms"
[[probe]]
name = "m"
kind = "mass_in_region"
lower = ["0", "0", "0"]
upper = ["1 cm", "1 cm", "1 cm"]
interval = "1 ms"
[[probe]]
name = "f"
kind = "flow_rate"
point = ["0", "0", "2 cm"]
normal = [0, 0, -1]
interval = "1 ms"
[[probe]]
name = "w"
kind = "wall_force"
wall = "hopper"
interval = "1 ms"
[output]
frame_interval = "0.3333333333333333 s"
checkpoint_interval = "0.1 s"
quantities = ["velocity", "species"]
contacts = true
positions = "single"
[accuracy]
level = "draft"
skin = 0.2
)";

} // namespace

TEST_CASE("a written scene reads back to the same bits", "[scene]") {
  const Scene scene = parseScene(rich, "rich.toml");
  const Scene again = parseScene(writeScene(scene), "rich.toml");
  CHECK(again == scene);
  CHECK(std::signbit(again.gravity.x()));
  CHECK(writeScene(again) == writeScene(scene));
  CHECK(sceneHash(again) == sceneHash(scene));
}

TEST_CASE("units, defaults and choices of a scene are resolved", "[scene]") {
  const Scene s = parseScene(rich, "rich.toml");
  CHECK(s.seed == 9007199254740993u); // above 2^53: kept as a whole number throughout
  CHECK(s.material("glass").density == Approx(2500).epsilon(1e-15));
  CHECK(*s.material("steel").poissonRatio == 0.3);
  CHECK(s.contact("glass", "steel").tangential.parameters.number("friction") == 0.1);
  CHECK(s.accuracy.stepsPerContact == 15); // of the level "draft"
  CHECK(s.accuracy.maximumOverlap == 0.5);
  CHECK(s.fills[0].stage == "fill"); // the first stage, since it names none
  CHECK(s.fills[0].byMass);
  CHECK(s.fills[3].how.parameters.vectors("spins")[0].y() == Approx(3.14159265358979).epsilon(1e-14));
  CHECK(s.fills[3].how.parameters.numbers("diameters")[0] == 2.24 / 1000); // that of its species
  CHECK(s.domain.periodic == std::array<bool, 3>{true, true, false});
  CHECK_THROWS_AS(s.material("wood"), InputError);
}

TEST_CASE("title and description do not change the hash, anything else does", "[scene]") {
  const Scene scene = parseScene(rich, "rich.toml");
  CHECK(sceneHash(parseScene(rich, "rich.toml", {"title=other"})) == sceneHash(scene));
  CHECK(sceneHash(parseScene(rich, "rich.toml", {"seed=2"})) != sceneHash(scene));
  CHECK(sceneHash(scene).size() == 32); // 128 bits
}

TEST_CASE("overrides reach every kind of key", "[scene]") {
  const auto with = [](const std::string& assignment) { return parseScene(rich, "rich.toml", {assignment}); };
  CHECK(with("seed=3").seed == 3);
  CHECK(with("species.a.size.diameter=\"3 mm\"").speciesNamed("a").size.parameters.number("diameter") ==
        0.003);
  CHECK(with("species.a.size.diameter=3 mm").speciesNamed("a").size.parameters.number("diameter") == 0.003);
  CHECK(with("wall.hopper.outlet=1 cm").walls[0].shape.parameters.number("outlet") == 0.01);
  CHECK(with("contact.glass-steel.tangential.friction=0.4")
            .contacts[1]
            .tangential.parameters.number("friction") == 0.4);
  CHECK(with("contact.2.tangential.friction=0.4").contacts[1].tangential.parameters.number("friction") ==
        0.4);
  CHECK(with("fill.2.number=50").fills[1].how.parameters.integer("number") == 50);
  CHECK(with("domain.upper=[\"1 cm\", \"1 cm\", \"40 cm\"]").domain.upper.z() == 0.4);
  CHECK(with("accuracy.time_step=1 us").accuracy.timeStep == 1e-6);
  CHECK(with("stage.pour.until.quiet=0.2 s").stages[1].quietTime == 0.2);
  CHECK(with("accuracy.level=reference").accuracy.stepsPerContact == 50);
}

TEST_CASE("sample scenes are sound and round-trip", "[scene][samples]") {
  int found = 0;
  for (const auto& entry : std::filesystem::directory_iterator(source + "/sample_runs")) {
    const auto file = entry.path() / "scene.toml";
    if (!std::filesystem::exists(file)) continue;
    INFO(file.string());
    const Scene scene = readScene(file.string());
    CHECK(parseScene(writeScene(scene), file.string()) == scene);
    ++found;
  }
  CHECK(found >= 4);
}

TEST_CASE("the reference page is that of this program", "[scene]") {
  std::ifstream in(source + "/docs/scene_keys.md");
  std::ostringstream page;
  page << in.rdbuf();
  // Made anew by: sandglass explain --keys > docs/scene_keys.md
  CHECK(page.str() == sceneReference());
}
