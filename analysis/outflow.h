#pragma once
// What leaves: where in the outlet, how fast, and in what mixture; from the rows of discharged.csv.

#include "analysis/result.h"
#include "analysis/series_data.h"
#include "sim/base/vec.h"

#include <vector>

namespace sandglass::analysis {

/// How places in an outlet are counted.
struct OutletFrame {
  Vec3 centre = Vec3::Zero();
  Vec3 down = -Vec3::UnitZ(); ///< unit vector, the way out
  Vec3 across = Vec3::Zero(); ///< unit vector across a slot; zero: by the distance from the centre
  int bins = 15;
};

/// Number density of the leaving grains across the outlet [1/m], or over its area [1/m^2] where it is round,
/// by size class (diameters below and above the mean of the smallest and the largest, where they differ by
/// more than a tenth) and together. Numbers: grains. Errors: square root of the count. After the outlet
/// histograms of Anand, PhD thesis, University of Florida, 2009.
Curve outletPositions(const SeriesColumns& discharged, const OutletFrame& outlet, const std::string& source);

/// Mean speed downwards against the place, the same bins; errors: of the mean. Numbers: mean, deviation
/// [m/s].
Curve outletVelocities(const SeriesColumns& discharged, const OutletFrame& outlet, const std::string& source);

/// Mass share of the fines in successive samples of a twentieth of the discharged mass, over that of all,
/// x_i/x_f, against the share of the mass that has left at the middle of the sample. Fines: the grains below
/// the mean of the smallest and the largest diameter. `density` [kg/m^3] by species; empty: the same for all.
/// Numbers: SI = mean of |x_i/x_f - 1|; floor, what a perfect mixture has with n_f fine and n_c coarse grains
/// a sample, sqrt(2/pi) (1 - x_f) sqrt(1/n_f + 1/n_c); SI_above_floor, the root of the difference of squares;
/// slope of x_i/x_f against the share, with its standard error. Throws InputError where all grains are of one
/// size or fewer than 100 left.
Curve dischargeSegregation(const SeriesColumns& discharged, const std::vector<double>& density,
                           const std::string& source);

} // namespace sandglass::analysis
