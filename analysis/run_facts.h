#pragma once
// What analyses want to know about a run and a Frame does not say: taken from the run's scene.

#include "analysis/beverloo.h"
#include "analysis/vortex/vortex_tank.h"
#include "sim/math/sector.h"
#include "sim/scene/scene.h"

#include <optional>
#include <string>
#include <vector>

namespace sandglass::analysis {

/// The outlet of a slot hopper.
struct Slot {
  Vec3 centre = Vec3::Zero();                      ///< middle of the outlet [m]
  Vec3 across = Vec3::UnitX(), up = Vec3::UnitY(); ///< unit vectors
  double outlet = 0, width = 0;                    ///< of the slot and of the bin [m]
};

struct RunFacts {
  std::optional<Vec3> up;           ///< minus the direction of gravity; absent without gravity
  double gravity = 0;               ///< [m/s^2]
  std::vector<std::string> gates;   ///< walls that a stage removes
  std::optional<OutletShape> shape; ///< of the outlet of a wedge or cone hopper
  double outlet = 0;                ///< its width or diameter [m]
  double halfAngle = 0;             ///< of it from the vertical [rad]
  std::optional<Vec3> outletCentre; ///< of it [m]
  std::optional<Slot> slot;         ///< of the first wedge
  std::optional<double> slotDepth;  ///< [m], of a slot along a periodic axis
  Sector sector;                    ///< of a wedge; the whole circle without
  std::optional<VortexTank> tank;   ///< an upright round one
  double grainDensity = 0;          ///< [kg/m^3], where all species have the same; else 0
  std::vector<double> densities;    ///< [kg/m^3] by species
  std::optional<Vec3> wayOut;       ///< unit normal of the first outlet that records its grains
  std::string flowProbe;            ///< name of the first flow_rate probe, or empty
  std::string energyProbe;          ///< name of the first energies probe, or empty
};

RunFacts factsOf(const Scene& scene);

} // namespace sandglass::analysis
