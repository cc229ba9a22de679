#pragma once
// Coarse-grained quantities along lines through a flow: across it at given heights, and up it at given
// distances from its axis. Each line is sampled where it was asked for, not at the nodes of a grid.

#include "analysis/coarse_graining.h"
#include "analysis/free_surface.h"
#include "analysis/result.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sandglass::analysis {

struct ProfileOptions {
  UpFrame axes{Vec3::UnitZ()};
  Vec3 axis = Vec3::Zero();    ///< a point on the axis [m]
  std::optional<Vec3> across;  ///< unit vector: distances are signed, beside the plane through the axis
                               ///< whose normal this is; absent: distances from the axis
  std::vector<double> heights; ///< of lines across the flow, along up from the origin [m]
  std::vector<double> radii;   ///< of lines up the flow: distances as above [m]
  double step = 0;             ///< from station to station of a line [m]
  double diameter = 0;         ///< for inertial numbers [m]
  Vec3 lower = Vec3::Zero(), upper = Vec3::Zero(); ///< of the grains, along axes.e1, e2, up [m]
};

/// Sums over Frames. At each station the points of a ring (of a line along the plane) stand for all that lie
/// at this distance; derived quantities are averaged over them by mass.
class FlowProfiles {
public:
  explicit FlowProfiles(ProfileOptions options);

  void add(const CoarseGrainer& grainer);

  /// One curve for each quantity, a series for each line: velocity_at_heights, packing_fraction_at_radii and
  /// so on. Averages of densities over the Frames, then ratios; errors from the Frames' own values where
  /// there are four or more. Stations with less than a hundredth of the largest density are left out.
  std::vector<Curve> curves(const std::string& definition) const;

  /// The lines that met no grains, as a sentence; empty when all did.
  std::string emptyLines() const;

private:
  struct Station {
    double at = 0;                         ///< distance or height [m]
    std::size_t first = 0, count = 0;      ///< of its points
    std::vector<std::vector<double>> each; ///< values of the Frames by quantity; those that have one
  };
  struct Line {
    double given = 0; ///< height or radius [m]
    bool level = true;
    std::vector<Station> stations;
  };
  struct Quantity {
    const char *name, *title;
    Axis axis;
    bool stress;
    double (*value)(const CoarseAverage&, const ProfileOptions&);
  };
  static const std::vector<Quantity>& quantities();
  void addLine(double given, bool level);
  void addRing(double distance, double height);
  /// Over a ring's points, by mass; NaN where all have less than a hundredth of `densest`.
  double average(std::span<const CoarseAverage> ring, const Quantity& quantity, double densest) const;
  Curve curve(const Quantity& quantity, bool level, const std::string& definition) const;

  ProfileOptions options_;
  std::vector<Line> lines_;
  std::vector<Vec3> points_;
  std::vector<CoarseAverage> sum_;
  std::size_t frames_ = 0;
  bool contacts_ = false;
};

} // namespace sandglass::analysis
