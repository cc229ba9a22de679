#pragma once
// From the probes of a run, or from its frames, to what the analyses of time series take.

#include "analysis/discharge.h"
#include "analysis/result.h"
#include "sim/io/run_folder.h"
#include "sim/io/series.h"

#include <map>
#include <string>

namespace sandglass::analysis {

using SeriesColumns = std::map<std::string, SeriesColumn>;

/// Mass through the plane of a flow_rate probe. Throws InputError when the probe is not among the columns.
DischargeData dischargeOf(const SeriesColumns& columns, const std::string& probe, const std::string& source);

/// Mass gone from the frames since they held most. Masses are those of the frames, or, where these have radii
/// alone, of spheres of `density` [kg/m^3] (0: unknown). Throws InputError when there is neither.
DischargeData dischargeOf(const FrameSource& frames, double density = 0);

/// What an outlet recorded (discharged.csv), by its name. Throws InputError when the column is not there.
const std::vector<double>& recordedColumn(const SeriesColumns& columns, const std::string& name,
                                          const std::string& source);

/// The energies that an energies probe saw, one line each. Throws InputError when it is not among the
/// columns.
Curve energyCurve(const SeriesColumns& columns, const std::string& probe, const std::string& source);

} // namespace sandglass::analysis
