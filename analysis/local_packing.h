#pragma once
// Packing from Voronoi cells: each grain's fraction of its cell, and what follows from it.
//
// Local fraction: V_grain / V_cell. Global fraction: sum of V_grain over sum of V_cell, which is not the mean
// of the local ones. Free volume: V_cell - V_grain. Spheres that overlap count whole. Cells that end at the
// free surface or at a bound of the domain without a wall are not used.

#include "analysis/field.h"
#include "analysis/region.h"
#include "analysis/result.h"
#include "analysis/results.h"
#include "analysis/voronoi.h"

#include <optional>
#include <vector>

namespace sandglass::analysis {

struct LocalPackingOptions {
  double diameter = 0; ///< [m]
  bool radical = true;
  int bins = 60;           ///< of the distributions
  double slab = 1;         ///< of the profiles by height and radius, in diameters
  Vec3 up = Vec3::UnitZ(); ///< of the heights
  std::optional<Vec3>
      axis; ///< a point on the axis of the radii, which is along `up`; absent: the domain's middle
  double gridSpacing = 2; ///< in diameters; 0: no field
  double gridReach =
      2.2; ///< grains about a node that count there, in diameters (Rycroft, PhD thesis, MIT, 2007)
};

class LocalPacking {
public:
  explicit LocalPacking(LocalPackingOptions options) : options_(std::move(options)) {}

  /// Grains whose centres lie in `region` count.
  void add(const Frame& frame, const VoronoiCells& cells, const Region& region);

  /// Distributions of local fraction, of cell volume with its k-gamma law (equal grains), of faces; profiles
  /// by height and radius; the field; local_fraction, cell_volume, free_volume and faces of the last Frame's
  /// grains. Throws InputError without a single whole cell.
  Results results() const;

private:
  struct Sample {
    double grains = 0, cells = 0; ///< [m^3]
    std::size_t count = 0;
  };
  void addField(const Frame& frame, const std::vector<char>& used, const VoronoiCells& cells);
  Curve profile(const std::string& name, const std::string& title, const std::string& axis,
                const std::vector<std::vector<Sample>>& samples, double from) const;

  LocalPackingOptions options_;
  std::vector<double> fraction_, volume_; ///< of all grains and frames; the volume in mean-grain cubes d^3
  std::vector<double> global_;            ///< per frame
  std::vector<double> faces_;             ///< counts by number of faces
  std::vector<std::vector<Sample>> byHeight_, byRadius_; ///< per frame
  double heightFrom_ = 0;
  bool equal_ = true;
  std::string definition_;
  std::vector<GrainValues> grains_;
  std::optional<Field> field_;
  std::vector<double> fieldGrains_, fieldCells_;
  std::size_t leftOut_ = 0;
};

} // namespace sandglass::analysis
