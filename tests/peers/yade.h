#pragma once
// Yade (Smilauer et al., Yade Documentation, 3rd ed., 2021) on grains of ours, driven by a script in its
// Python.

#include "tests/peers/lammps.h"

#include <filesystem>
#include <string>

namespace sandglass::peers {

/// "Yade 2023.02a", or empty where `yade` is not installed.
std::string yadeVersion();

/// A periodic box of spheres of one size and density over a floor, as `HookeHistory` describes their contacts
/// (no tangential damping), gravity included. Spheres of type 2 are held fast.
struct YadeScene {
  HookeHistory law;
  double radius = 0, mass = 0;
  double lower[3] = {}, upper[3] = {}; ///< of the cell; not periodic along z where there is a floor
  bool floor = true;                   ///< at z = 0
  double gravity[3] = {};
  double timeStep = 0;
};

/// A script that reads `grains.data` (writeLammpsData) beside it, runs so many steps and prints
/// "YADE <seconds> <kinetic energy>": of the loop alone, and translational after the last step, with
/// velocities at the full step.
std::string yadeScript(const YadeScene& scene, long long steps);

struct YadeRun {
  double seconds = 0, kineticEnergy = 0;
};
/// Throws RunError with Yade's own words when it fails.
YadeRun runYade(const std::filesystem::path& folder, const std::string& script, int threads);

} // namespace sandglass::peers
