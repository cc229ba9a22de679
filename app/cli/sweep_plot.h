#pragma once
// sandglass sweep DIR --plot: the phase diagram as a picture and CSV, with pictures of runs beside it.

#include "app/cli/sweep_work.h"

namespace sandglass::cli {

/// Keys of --plot: x, y, colour (or color), line, classes, where=COLUMN:VALUE (again and again),
/// pictures=yes. Writes -o FILE.png and FILE.csv. Returns the exit code. Throws InputError.
int plotSweep(const SweepArguments& arguments);

} // namespace sandglass::cli
