#pragma once
// A slot hopper in small, with all that a checkpoint must carry: friction, rolling, a size spread, rain, an
// opened gate, grains that leave, a periodic direction. Less than a second of computing.

namespace sandglass::test {

inline const char* const smallHopper = R"(
gravity = ["0", "-9.81 m/s^2", "0"]

[domain]
lower = ["-2 cm", "-2 cm", "-0.4 cm"]
upper = ["2 cm", "8 cm", "0.4 cm"]
periodic = ["z"]

[[material]]
name = "glass"
density = "2500 kg/m^3"

[[contact]]
between = ["glass", "glass"]
normal = { law = "linear", collision_time = "5e-4 s", restitution = 0.9 }
tangential = { law = "spring", friction = 0.3, stiffness_ratio = 0.2857 }
rolling = { law = "elastic_plastic", length = "0.1 mm" }

[[species]]
name = "bead"
material = "glass"
size = { distribution = "uniform", smallest = "2 mm", largest = "2.6 mm" }

[[wall]]
name = "hopper"
kind = "wedge"
material = "glass"
outlet = "1.2 cm"
width = "3.5 cm"
half_angle = "45 deg"
height = "8 cm"

[[wall]]
name = "gate"
kind = "rectangle"
material = "glass"
centre = ["0", "0", "0"]
normal = [0, 1, 0]
along = [1, 0, 0]
length = "1.4 cm"
breadth = "2 cm"

[[outlet]]
name = "below"
point = ["0", "-1 cm", "0"]
normal = [0, -1, 0]

[[fill]]
kind = "random"
species = "bead"
region = "box"
lower = ["-1.7 cm", "0.2 cm", "-0.4 cm"]
upper = ["1.7 cm", "5 cm", "0.4 cm"]
number = 250

[[fill]]
kind = "rain"
stage = "discharge"
species = "bead"
lower = ["-1.5 cm", "6 cm", "-0.4 cm"]
upper = ["1.5 cm", "7 cm", "0.4 cm"]
rate = "1500 1/s"
number = 100

[[stage]]
name = "settle"
until = { duration = "40 ms" }

[[stage]]
name = "discharge"
remove_walls = ["gate"]
until = { duration = "100 ms" }

[[probe]]
name = "energy"
kind = "energies"
interval = "2 ms"

[[probe]]
name = "outflow"
kind = "flow_rate"
point = ["0", "-0.3 cm", "0"]
normal = [0, -1, 0]
interval = "3 ms"

[output]
frame_interval = "7 ms"
checkpoint_interval = "9 ms"
quantities = ["velocity", "spin"]
)";

} // namespace sandglass::test
