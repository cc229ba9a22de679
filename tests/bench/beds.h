#pragma once
// The scenes and starting states of the core's bench, made by rules alone so that every machine has the same.

#include "sim/grains/seeding.h"
#include "sim/scene/scene.h"
#include "tests/peers/lammps.h"
#include "tests/peers/yade.h"

#include <string>
#include <vector>

namespace sandglass::bench {

/// Beads of diameter 1, density 1, over a floor at z = 0, over beads that are held fast, or in free space,
/// periodic sideways; the numbers of the granular benchmark that LAMMPS is measured by: spring 2e5,
/// tangential 2/7 of it, damping rate 50, friction 0.5, step 1e-4, gravity 1 (units of metre, kilogram,
/// second).
struct Beads {
  double width = 0, breadth = 0, height = 0; ///< of the periodic cell [diameters]
  double angle = 0;                          ///< of the floor against gravity [deg]
  double gravity = 1;
  bool friction = true, floor = true;
  double restitution = 0; ///< > 0: instead of the damping rate
  double timeStep = 1e-4;
  bool clamped = false; ///< contacts never attract, as Yade has it
  bool rough = false;   ///< instead of the floor: beads of species 1, which are held fast

  Scene scene(const std::vector<std::string>& knobs = {}) const;
  /// Decks of other programs up to their `run`: grains.data, forces, floor, kinetic energy every `look`
  /// steps.
  std::string lammpsDeck(std::int64_t look) const;
  std::string liggghtsDeck(std::int64_t look) const;
  std::string yadeScript(std::int64_t steps) const;
};

/// Spring, damping, friction of the benchmark.
peers::HookeHistory standardCoefficients(bool friction = true);

/// The lowest layer as beads of species 1, at rest.
std::vector<GrainSeed> roughened(std::vector<GrainSeed> beads);

/// `across` x `across` x `layers` beads at rest on the floor: let fall from a jittered lattice, calmed.
std::vector<GrainSeed> settledTile(int across, int layers, bool quick);
constexpr double tileSpacing = 1.05; ///< a tile is this wide per bead

/// The beads all moving down at this speed: a bed that has just been dropped by a little.
std::vector<GrainSeed> dropped(std::vector<GrainSeed> beads, double speed);

/// `tile`, of width `side`, nx times ny times side by side.
std::vector<GrainSeed> tiled(const std::vector<GrainSeed>& tile, double side, int nx, int ny);

/// The beads after so much time.
std::vector<GrainSeed> after(const Beads& beads, const std::vector<GrainSeed>& start, double time);

/// The beads sheared (at about the rate that this flow has over a rough bottom) and shaken.
std::vector<GrainSeed> shaken(std::vector<GrainSeed> beads);

/// Those that are free with small velocities of their own, so that copies of a tile part.
std::vector<GrainSeed> nudged(std::vector<GrainSeed> beads);

/// Beads on a lattice at a solid fraction in a periodic cube, velocities of unit spread.
std::vector<GrainSeed> gas(int across, double solidFraction, Beads& beads);

} // namespace sandglass::bench
