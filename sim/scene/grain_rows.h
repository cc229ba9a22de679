#pragma once
// The rows of a "list" filling: inline tables (`grains = [{ position = …, … }, …]`) or a CSV file.

#include "sim/scene/scene.h"
#include "sim/scene/table_reader.h"

#include <string>
#include <vector>

namespace sandglass {

/// Reads `grains` or `csv` of the table into the parameters species, diameters, positions, velocities, spins
/// of `fill.how`. Left out: velocity and spin are 0, the species is the only one of the scene, the diameter
/// that of a species of size "single".
///
/// CSV: comma-separated, first line the headings x[mm] y[mm] z[mm], and if wanted vx[m/s] vy[…] vz[…]
/// wx[rad/s] wy[…] wz[…] diameter[mm] species, any unit of the right dimension; lines that begin with # are
/// skipped.
void readGrainRows(TableReader& in, const std::vector<Species>& species, const std::string& baseFolder,
                   FillSpec& fill);

} // namespace sandglass
