#include "tests/validate/hopper/bed.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace sandglass::validate {

double sphereMass(double diameter, double density) {
  return std::numbers::pi / 6 * std::pow(diameter, 3) * density;
}

double latchingTime(double reducedMass, double loading, double unloading) {
  return std::numbers::pi / 2 * std::sqrt(reducedMass) * (1 / std::sqrt(loading) + 1 / std::sqrt(unloading));
}

std::string latchingLaw(double loading, double unloading) {
  return fmt::format(
      R"({{ law = "walton_braun", stiffness = "{:.10g} N/m", unloading_stiffness = "{:.10g} N/m" }})",
      loading, unloading);
}

std::string HopperBed::key() const {
  std::string text =
      fmt::format("W {:.4g} cm, outlet {:.4g} cm, {} grains", 100 * width, 100 * outlet, number);
  const HopperBed base;
  const auto add = [&](double value, double usual, const char* form) {
    if (value != usual) text += fmt::format(fmt::runtime(form), value);
  };
  add(depth * 100, base.depth * 100, ", depth {:.4g} cm");
  add(halfAngle, base.halfAngle, ", half angle {:g} deg");
  add(diameter * 1000, base.diameter * 1000, ", d {:.4g} mm");
  add(finesShare, 0, ", fines {:g}");
  add(friction, base.friction, ", friction {:g}");
  add(wallFriction, base.wallFriction, ", wall friction {:g}");
  add(unloading, base.unloading, ", unloading {:g} N/m");
  add(rollingLength * 1000, base.rollingLength * 1000, ", rolling {:.4g} mm");
  if (emptied) text += ", emptied";
  return text;
}

HopperBed HopperBed::coarser(double times) const {
  HopperBed bed = *this;
  bed.diameter *= times;
  bed.finesDiameter *= times;
  bed.depth *= times;
  bed.rollingLength *= times;
  bed.number = static_cast<int>(std::lround(number / (times * times)));
  return bed;
}

double HopperBed::totalMass() const {
  return number * sphereMass(diameter);
}

double HopperBed::lip() const {
  return 0.17 * outlet + 0.025e-2; // as in the source's program
}

double HopperBed::timeStep() const {
  const double smallest = finesShare > 0 ? std::min(diameter, finesDiameter) : diameter;
  const double base = latchingTime(0.5 * sphereMass(2.24e-3), loadingStiffness, 283);
  const double here = latchingTime(0.5 * sphereMass(smallest), loadingStiffness, unloading);
  return 2.5e-5 * here / base;
}

Scene HopperBed::scene(std::uint64_t seed, double coarse) const {
  const auto rolling = [&](double length) {
    return length > 0 ? fmt::format(R"({{ law = "elastic_plastic", length = "{:.10g} mm" }})", 1000 * length)
                      : std::string(R"({ law = "none" })");
  };
  const auto contact = [&](const char* other, double unload, double mu) {
    return fmt::format(R"([[contact]]
between = ["glass", "{}"]
normal = {}
tangential = {{ law = "spring", friction = {}, stiffness_ratio = 0.2857142857142857 }}
rolling = {}
)",
                       other, latchingLaw(loadingStiffness, unload), mu, rolling(rollingLength));
  };
  std::string fines, mixture = R"(species = "bead")";
  if (finesShare > 0) {
    fines = fmt::format("[[species]]\nname = \"fine\"\nmaterial = \"glass\"\n"
                        "size = {{ distribution = \"single\", diameter = \"{:.10g} mm\" }}\n",
                        1000 * finesDiameter);
    mixture = fmt::format(R"(by = "mass"
mixture = [{{ species = "bead", fraction = {:.10g} }}, {{ species = "fine", fraction = {:.10g} }}])",
                          1 - finesShare, finesShare);
  }
  const std::string amount = finesShare > 0 ? fmt::format("mass = \"{:.10g} g\"", 1000 * totalMass())
                                            : fmt::format("number = {}", number);
  // Room for a random filling at a solid fraction of 0.25, above the slope where there is one.
  const double volume = totalMass() / glassDensity, slope = halfAngle * std::numbers::pi / 180;
  const double cone = halfAngle < 89.99 ? 0.5 * (width - outlet) / std::tan(slope) : 0;
  const double top = std::max(cone, volume / (0.25 * depth * width) + 0.6 * cone) + 0.05;
  // Free fall of the highest grain to the surface of the bed to be, then a drag as the source's, which takes
  // a thousandth of every velocity in each 10 us once half the fall is over.
  const double fall =
      1.1 * std::sqrt(2 * std::max(0.02, top - volume / (0.6 * depth * width)) / standardGravity);
  const double m = totalMass();
  const std::string until =
      emptied ? R"({ quiet = "0.075 s", duration = "8 s" })"
              : fmt::format(R"({{ mass_discharged = "{:.10g} g", duration = "8 s" }})", 1000 * 0.55 * m);
  // At rest as in the source: 0.003 erg a grain and half an erg in all.
  const double still = 0.003e-7 + 0.5e-7 / number;
  return parseScene(
      fmt::format(
          R"(
title = "Reduced hopper"
seed = {seed}
gravity = ["0", "-{g} m/s^2", "0"]
[domain]
lower = ["-{half:.10g} m", "-{below:.10g} m", "-{zhalf:.10g} m"]
upper = ["{half:.10g} m", "{top:.10g} m", "{zhalf:.10g} m"]
periodic = ["z"]
[[material]]
name = "glass"
density = "{rho} kg/m^3"
[[material]]
name = "wall"
{grains}{walls}
[[species]]
name = "bead"
material = "glass"
size = {{ distribution = "single", diameter = "{d:.10g} mm" }}
{fines}
[[wall]]
name = "hopper"
kind = "wedge"
material = "wall"
outlet = "{outlet:.10g} m"
width = "{width:.10g} m"
half_angle = "{angle:.10g} deg"
height = "{top:.10g} m"
lip = "{lip:.10g} m"
[[wall]]
name = "gate"
kind = "rectangle"
material = "wall"
centre = ["0", "0", "0"]
normal = [0, 1, 0]
along = [1, 0, 0]
length = "{outlet:.10g} m"
breadth = "10 cm" # more than the depth, so that its ends are never met
[[outlet]]
name = "below"
point = ["0", "-{outlet:.10g} m", "0"]
normal = [0, -1, 0]
[[fill]]
kind = "random"
stage = "fall"
{mixture}
region = "box"
lower = ["-{whalf:.10g} m", "0", "-{zhalf:.10g} m"]
upper = ["{whalf:.10g} m", "{top:.10g} m", "{zhalf:.10g} m"]
{amount}
velocity = ["0", "-0.4 cm/s", "0"]
velocity_spread = ["0.5 cm/s", "0.4 cm/s", "0.15 cm/s"]
spin_spread = "0.25 rad/s"
[[stage]]
name = "fall"
until = {{ duration = "{fall:.6g} s" }}
[[stage]]
name = "settle"
drag = "100 1/s"
until = {{ settled = "{still:.6g} nJ", duration = "1.5 s" }}
[[stage]]
name = "discharge"
remove_walls = ["gate"]
until = {until}
[[probe]]
name = "outflow"
kind = "flow_rate"
point = ["0", "-{lip:.10g} m", "0"]
normal = [0, -1, 0]
interval = "2 ms"
[[probe]]
name = "above_outlet"
kind = "mass_in_region"
lower = ["-{ohalf:.10g} m", "{low:.10g} m", "-{zhalf:.10g} m"]
upper = ["{ohalf:.10g} m", "{high:.10g} m", "{zhalf:.10g} m"]
interval = "5 ms"
[output]
frame_interval = "10 ms"
quantities = ["velocity", "mass"]
[accuracy]
time_step = "{dt:.10g} us"
maximum_overlap = 1 # the source's spring is soft: impacts of the filling go deep
)",
          fmt::arg("seed", seed), fmt::arg("g", standardGravity), fmt::arg("half", 0.5 * width + 0.005),
          fmt::arg("below", outlet + 0.01), fmt::arg("zhalf", 0.5 * depth), fmt::arg("top", top),
          fmt::arg("rho", glassDensity), fmt::arg("grains", contact("glass", unloading, friction)),
          fmt::arg("walls", contact("wall", wallUnloading, wallFriction)), fmt::arg("d", 1000 * diameter),
          fmt::arg("fines", fines), fmt::arg("outlet", outlet), fmt::arg("width", width),
          fmt::arg("angle", halfAngle), fmt::arg("lip", lip()), fmt::arg("mixture", mixture),
          fmt::arg("whalf", 0.5 * width), fmt::arg("amount", amount), fmt::arg("still", 1e9 * still),
          fmt::arg("fall", fall), fmt::arg("until", until), fmt::arg("ohalf", 0.5 * outlet),
          fmt::arg("low", 0.25 * outlet), fmt::arg("high", outlet),
          fmt::arg("dt", 1e6 * coarse * timeStep())),
      "reduced hopper");
}

} // namespace sandglass::validate
