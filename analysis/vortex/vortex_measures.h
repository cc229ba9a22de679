#pragma once
// What the states of a bed in a vortex are decided from: a few numbers for each frame, so that a run of any
// length is classified while it goes on and no frame is kept.

#include "analysis/vortex/vortex_tank.h"
#include "sim/frame/frame.h"

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace sandglass::analysis {

/// Thresholds that act on single grains. Each is applied at 0.8, 1 and 1.2 of its value, so that later it can
/// be seen whether a state hangs on it.
struct VortexGrainThresholds {
  double rise = 0.1;        ///< least rise from a radial bin to the next that counts, in grain radii
  double riserStep = 0.01;  ///< the source's rising grain: in radii from frame to frame, above the mean
  double riserSpeed = 0.2;  ///< ours: in sqrt(g r), above the mean
  double spoutReach = 0.75; ///< rising grains count up to this distance from the axis, in tank radii
  static constexpr std::array<double, 3> factors{0.8, 1.0, 1.2};
};

/// One frame in numbers. Counts are at the three factors.
struct VortexSample {
  double time = 0;       ///< [s]
  double energy = 0;     ///< [J] mean of a grain, moving, turning and m g z
  double aboveFloor = 0; ///< [J] the same with heights above the floor: positive
  float highest = 0;     ///< [m] of all centres
  float meanHeight = 0;  ///< [m]
  float core = 0;        ///< [m] distance of the innermost centre from the axis
  float rotation = 0;    ///< [rad/s] of the bed about `up`: angular momentum over moment of inertia
  std::array<std::uint16_t, 3> rises{};       ///< radial bins whose top is higher than the one before
  std::array<std::uint16_t, 3> stepRisers{};  ///< rising grains by step from frame to frame
  std::array<std::uint16_t, 3> speedRisers{}; ///< rising grains by speed
  bool sound = true; ///< false: not a number, or a grain far outside the tank (an exploded run)
};

/// Height of the bed against the distance from the axis, a mean of the last frames, and the paraboloid
/// z = apex + curvature rho^2 through it.
struct SurfaceProfile {
  std::vector<double> distance;   ///< [m] middles of the bins
  std::vector<double> height;     ///< [m] of the highest centre; NaN where a bin was always empty
  std::vector<double> filled;     ///< share of the frames in which the bin held a grain
  double apex = 0, curvature = 0; ///< [m], [1/m]; NaN with fewer than three bins that held grains
  double rms = 0;                 ///< [m] of the bins about the paraboloid
  double rotation = 0;            ///< [rad/s] sqrt(2 g curvature); NaN when it opens downwards
};

class VortexMeasures {
public:
  explicit VortexMeasures(const VortexTank& tank, const VortexGrainThresholds& limits = {},
                          double density = 0);

  /// Frames in ascending order of time; one at the time of the last is left out. Velocities are taken from
  /// the frame, else from the change of positions; masses from the frame, else from `density` [kg/m^3] (2500
  /// when that is 0 too). Throws InputError without radii, or when grains come or go.
  void add(const Frame& frame);

  const std::vector<VortexSample>& samples() const { return samples_; }
  const VortexTank& tank() const { return tank_; }
  const VortexGrainThresholds& limits() const { return limits_; }
  std::size_t grains() const { return before_.size(); }
  double radius() const { return radius_; } ///< [m] mean
  int bins() const { return bins_; }        ///< round(R / 2 r)
  double interval() const;                  ///< [s] between frames, the commonest
  SurfaceProfile profile() const;           ///< of the last profileFrames frames
  static constexpr std::size_t profileFrames = 500;

private:
  void begin(const Frame& frame);
  VortexTank tank_;
  VortexGrainThresholds limits_;
  double density_;
  double radius_ = 0;
  int bins_ = 0;
  std::vector<double> mass_;
  std::vector<Vec3> before_;
  std::vector<std::int64_t> ids_;
  std::vector<VortexSample> samples_;
  std::vector<float> tops_;         ///< ring of profileFrames x bins; NaN: empty
  std::vector<double> speed_, top_; ///< scratch
};

} // namespace sandglass::analysis
