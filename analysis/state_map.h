#pragma once
// Solid, liquid or gas: the mechanical state of each grain, from more than one number.
//
//   gas     packing fraction below `gasFraction` and fewer than `gasContacts` contacts about the grain, or an
//   inertial
//           number above `gasInertia`
//   solid   not gas, inertial number below `solidInertia`, and no rearrangement where that is known
//   liquid  the rest
// All are coarse-grained about the grain with one kernel. Inertial number I = shear rate d sqrt(rho_s / P)
// (GDR MiDi, Eur. Phys. J. E 14, 341, 2004: below 1e-3 quasi-static, above 1e-1 collisional). P is the
// pressure from the contacts' forces; without them the weight of what lies above; without gravity the kinetic
// part. Grains whose pressure is less than that of one layer of grains take the latter, since I has no
// meaning without load. Rearrangement: D2min of Falk & Langer (Phys. Rev. E 57, 7192, 1998) over the
// neighbours since the last Frame, over d^2. What a grain is said to be is the state that it had most often
// in the last `memory` Frames.

#include "analysis/registry.h"

#include <array>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

namespace sandglass::analysis {

enum class GrainState { solid = 0, liquid = 1, gas = 2 };

struct StateThresholds {
  double solidInertia = 1e-3, gasInertia = 0.1;
  double gasFraction = 0.3, gasContacts = 1;
  double rearranged = 0.01; ///< D2min / d^2 between Frames
};

struct StateOptions {
  StateThresholds limits;
  double width = 1.5;        ///< w of the kernel, in diameters
  int memory = 3;            ///< Frames
  double contactGap = 0.001; ///< in diameters, where Frames have no contacts
  double diameter = 0;       ///< [m]
  double density = 0;        ///< of the grains [kg/m^3]; 0: 2500
  double gravity = 0;        ///< [m/s^2]
  std::optional<Vec3> up;
};

/// What the state of a grain is decided from.
struct GrainMotion {
  double inertia = 0, fraction = 0, contacts = 0, temperature = 0,
         rearrangement = 0; ///< rearrangement NaN: not known
};

GrainState stateOf(const GrainMotion& motion, const StateThresholds& limits);

class StateMap {
public:
  explicit StateMap(StateOptions options) : options_(std::move(options)) {}

  /// Throws InputError without velocities or radii.
  void add(const Frame& frame);

  const std::vector<GrainMotion>& motion() const { return motion_; } ///< of the last Frame
  const std::vector<GrainState>& states() const { return states_; }  ///< smoothed, of the last Frame
  /// Shares of the grains by Frame: time, and of the three states.
  struct Shares {
    double time = 0;
    std::array<double, 3> share{};
  };
  const std::vector<Shares>& shares() const { return shares_; }
  /// Shares over all Frames when one threshold is multiplied by a factor: name, factor, shares of the
  /// unsmoothed states.
  std::vector<std::pair<std::string, std::array<double, 3>>> sensitivity() const;
  /// Grains of all Frames: [state at once][smoothed state].
  const std::array<std::array<double, 3>, 3>& flicker() const { return flicker_; }
  std::string definition() const;
  bool forces() const { return forces_; }

private:
  std::vector<double> rearrangement(const Frame& frame);
  StateOptions options_;
  std::vector<GrainMotion> motion_;
  std::vector<GrainState> states_;
  std::vector<Shares> shares_;
  std::array<std::array<double, 3>, 3> flicker_{};
  std::unordered_map<std::int64_t, std::vector<std::uint8_t>> past_; ///< by id
  std::vector<GrainMotion> sample_; ///< some of all Frames, for the sensitivity
  std::vector<Vec3> before_;
  std::unordered_map<std::int64_t, std::size_t> beforeIndex_;
  std::vector<std::vector<std::int64_t>> beforeNeighbours_;
  bool forces_ = false;
};

} // namespace sandglass::analysis
