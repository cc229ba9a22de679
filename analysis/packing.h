#pragma once
// Packing fraction by height: the exact volumes of the spheres' slices in horizontal slabs over the volume of
// the container in each slab.

#include "analysis/region.h"
#include "analysis/result.h"

#include <cstdint>
#include <vector>

namespace sandglass::analysis {

/// Volume of the part of a sphere of radius R about height h that lies between heights `low` <= `high`.
double sphereSlabVolume(double radius, double h, double low, double high);

struct PackingOptions {
  Vec3 up = Vec3::UnitZ(); ///< minus gravity
  double slabHeight = 0;   ///< [m]; 0: half a mean diameter. Adjusted to divide a periodic height
  RegionOptions region;    ///< limits and gates; clearance and surface are set by the analysis
  double diameter = 0;     ///< [m]; 0: twice the mean radius of the first Frame
  std::uint64_t seed = 1;
};

/// Add Frames of one container, then ask for the result. Limits across `up` count a grain whole by its
/// centre; limits along `up` cut it exactly. Overlaps of soft grains count twice.
class PackingProfile {
public:
  explicit PackingProfile(PackingOptions options) : options_(std::move(options)) {}

  /// Throws InputError without radii.
  void add(const Frame& frame);

  /// Packing fraction against height; numbers packing_bulk (from the floor, or lower limit, to two diameters
  /// below the tenth part of the surface that is lowest; whole along a periodic `up`) and its error, from
  /// Frames where there are four or more, else from the container's volume. Throws InputError when no Frame
  /// was added.
  Curve result() const;

private:
  void extend(const Frame& frame, double top);

  PackingOptions options_;
  double from_ = 0, width_ = 0;
  std::vector<Volume> container_;          ///< per slab, as high as any Frame's grains reach
  std::vector<std::vector<double>> solid_; ///< per Frame and slab [m^3]
  std::vector<double> bulk_;               ///< per Frame; NaN when the bed is too shallow
  std::string regionText_;
};

} // namespace sandglass::analysis
