#pragma once
// Superellipsoids from the columns of other programs.

#include "sim/io/import/column_set.h"

#include <vector>

namespace sandglass {

/// Takes semi-axes or whole axes, and exponents or blockiness, from the columns; gives the frame its list of
/// shapes and each grain the number of its own. Returns the radius of each grain's volume [m], or nothing
/// where no column tells shapes. What was taken for granted is added to `notes`. Throws InputError for axes
/// and exponents that make no convex grain.
std::vector<double> takeShapes(ColumnSet& columns, const RawFrame& raw, const ImportSettings& settings,
                               const FramePlace& place, Frame& frame, std::vector<std::string>& notes);

/// Throws InputError where a quaternion's length is not 1.
void takeOrientations(ColumnSet& columns, const FramePlace& place, Frame& frame);

} // namespace sandglass
