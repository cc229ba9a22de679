#pragma once
// Forty grains that fall and bounce for 0.3 s while ten more rain in, then fall through the open floor for
// 0.4 s. For the solver of fake_solver.h.

#include "sim/scene/scene.h"

#include <numbers>

namespace sandglass::test {

inline const char* const ballisticText = R"(
title = "Falling grains"
seed = 7

[domain]
lower = ["-1 m", "-1 m", "-1 m"]
upper = ["1 m", "1 m", "1 m"]

[[material]]
name = "glass"
density = "2500 kg/m^3"

[[contact]]
between = ["glass", "glass"]
normal = { law = "linear", collision_time = "10 ms", restitution = 0.9 }

[[species]]
name = "bead"
material = "glass"
size = { distribution = "single", diameter = "2 cm" }

[[wall]]
name = "floor"
kind = "plane"
material = "glass"
point = ["0", "0", "0"]
normal = [0, 0, 1]

[[outlet]]
name = "below"
point = ["0", "0", "-0.2 m"]
normal = [0, 0, -1]

[[fill]]
kind = "random"
species = "bead"
region = "box"
lower = ["-0.5 m", "-0.5 m", "0 m"]
upper = ["0.5 m", "0.5 m", "0.5 m"]
number = 40

[[fill]]
kind = "rain"
species = "bead"
lower = ["-0.5 m", "-0.5 m", "0.6 m"]
upper = ["0.5 m", "0.5 m", "0.7 m"]
rate = "50 1/s"
number = 10

[[stage]]
name = "bounce"
until = { duration = "0.3 s" }

[[stage]]
name = "fall"
remove_walls = ["floor"]
until = { duration = "0.4 s" }

[[probe]]
name = "energy"
kind = "energies"
interval = "20 ms"

[[probe]]
name = "lost"
kind = "flow_rate"
point = ["0", "0", "-0.1 m"]
normal = [0, 0, -1]
interval = "100 ms"

[[probe]]
name = "low"
kind = "mass_in_region"
lower = ["-1 m", "-1 m", "-1 m"]
upper = ["1 m", "1 m", "0.25 m"]
interval = "30 ms"

[[probe]]
name = "weight"
kind = "wall_force"
wall = "floor"
interval = "50 ms"

[output]
frame_interval = "50 ms"
)";

inline Scene ballisticScene(const std::vector<std::string>& overrides = {}) {
  return parseScene(ballisticText, "ballistic", overrides);
}

constexpr int ballisticGrains = 50;
inline double ballisticGrainMass() {
  return 2500 * (4.0 / 3.0 * std::numbers::pi) * 0.01 * 0.01 * 0.01;
}

} // namespace sandglass::test
