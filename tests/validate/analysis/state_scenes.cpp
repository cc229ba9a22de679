#include "tests/validate/analysis/state_scenes.h"

#include "sim/run/run.h"
#include "sim/scene/scene.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace sandglass::validate {

Vec3 gravityOf(KnownState state) {
  const double angle = state == KnownState::shear ? 22 * std::numbers::pi / 180 : 0;
  return state == KnownState::gas ? Vec3::Zero() : Vec3(9.81 * Vec3(std::sin(angle), 0, -std::cos(angle)));
}

namespace {

std::string textOf(KnownState state, std::uint64_t seed) {
  const Vec3 g = gravityOf(state);
  const bool gas = state == KnownState::gas;
  const double duration = gas ? 0.4 : state == KnownState::bed ? 0.6 : 1.6;
  std::string text = fmt::format(R"(seed = {}
gravity = ["{} m/s^2", "0 m/s^2", "{} m/s^2"]
[domain]
lower = ["0 m", "0 m", "0 m"]
upper = {}
periodic = {}
[[material]]
name = "glass"
density = "2500 kg/m^3"
youngs_modulus = "2 MPa"
poisson_ratio = 0.25
[[contact]]
between = ["glass", "glass"]
normal = {{ law = "hertz", restitution = {} }}
tangential = {{ law = "mindlin", friction = 0.5 }}
[[species]]
name = "bead"
material = "glass"
size = {{ distribution = "uniform", smallest = "1.8 mm", largest = "2.2 mm", by = "number" }}
)",
                                 seed, g.x(), g.z(),
                                 gas ? R"(["30 mm", "30 mm", "30 mm"])" : R"(["15 mm", "15 mm", "60 mm"])",
                                 gas ? R"(["x", "y", "z"])" : R"(["x", "y"])", gas ? 0.9 : 0.7);
  if (gas)
    text += R"([[fill]]
kind = "random"
region = "box"
lower = ["0 m", "0 m", "0 m"]
upper = ["30 mm", "30 mm", "30 mm"]
species = "bead"
number = 800
velocity_spread = ["0.3 m/s", "0.3 m/s", "0.3 m/s"]
)";
  else
    text += fmt::format(R"([[species]]
name = "rough"
material = "glass"
frozen = true
size = {{ distribution = "single", diameter = "2 mm" }}
[[fill]]
kind = "lattice"
species = "rough"
structure = "sc"
spacing = "2.5 mm"
lower = ["0.1 mm", "0.1 mm", "1 mm"]
upper = ["15 mm", "15 mm", "1.5 mm"]
[[fill]]
kind = "random"
species = "bead"
region = "box"
lower = ["0 m", "0 m", "2.1 mm"]
upper = ["15 mm", "15 mm", "60 mm"]
number = 700
velocity = ["{} m/s", "0 m/s", "0 m/s"]
velocity_spread = ["0.05 m/s", "0.05 m/s", "0.05 m/s"]
)",
                        state == KnownState::shear ? 0.3 : 0.0);
  return text + fmt::format(R"([[stage]]
name = "run"
until = {{ duration = "{} s" }}
[output]
frame_interval = "{} s"
quantities = ["radius", "velocity", "species", "mass"]
contacts = true
)",
                            duration, duration / 50);
}

} // namespace

std::vector<FramePtr> runOf(KnownState state, std::uint64_t seed) {
  RunOptions options;
  options.threads = 1;
  Run run(parseScene(textOf(state, seed), "state map"), options);
  std::vector<FramePtr> frames;
  run.onSavedFrame = [&](FramePtr frame) { frames.push_back(std::move(frame)); };
  run.execute();
  frames.erase(frames.begin(), frames.begin() + static_cast<std::ptrdiff_t>(frames.size() * 4 / 5));
  return frames;
}

} // namespace sandglass::validate
