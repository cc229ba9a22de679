#pragma once
// The rate of discharge against how full the vessel still is.

#include "analysis/discharge.h"
#include "analysis/result.h"
#include "sim/frame/frame.h"

#include <span>
#include <vector>

namespace sandglass::analysis {

/// Mean height of the bed's free surface above a point, along up [m]; 0 where no grain is above it.
double fillHeight(const Frame& frame, const Vec3& up, const Vec3& outlet, double diameter);

struct FillSample {
  double time = 0, height = 0; ///< [s], [m]
};

/// Between neighbouring samples: mass that left over the time, against the mean of both heights over the
/// outlet's width. Samples before the first grain leaves and after the last are left out. Throws InputError
/// when fewer than three intervals are left.
Curve rateByFillHeight(const DischargeData& data, std::span<const FillSample> samples, double outlet);

} // namespace sandglass::analysis
