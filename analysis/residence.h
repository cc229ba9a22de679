#pragma once
// How long grains stay between entering and leaving.

#include "analysis/result.h"
#include "analysis/series_data.h"

namespace sandglass::analysis {

/// Density of the residence times in discharged.csv. Where grains were put back, lives that began with the
/// run's fillings are left out: their time includes settling. Numbers: grains, mean, standard_deviation,
/// median, shortest, longest [s]. Throws InputError when a column is missing or nothing has left.
Curve residenceTimes(const SeriesColumns& discharged, int bins, const std::string& source);

} // namespace sandglass::analysis
