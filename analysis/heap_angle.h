#pragma once
// The slope of the heaps that a slot hopper keeps on the two sides of its outlet.
//
// Per side: bins one grain diameter wide from the edge of the outlet to the side wall, the highest grain of
// each, the first and the last bin left out, a least-squares line through the tops; the two angles are
// averaged (Anand, PhD thesis, University of Florida, 2009).

#include "analysis/result.h"
#include "analysis/run_facts.h"
#include "sim/frame/frame.h"

namespace sandglass::analysis {

struct HeapOptions {
  Slot slot;
  double diameter = 0; ///< [m]; 0: twice the mean radius
};

/// One frame in which the grains rest. Tops of the bins and the lines against the distance from the middle of
/// the outlet; numbers: angle_left, angle_right, angle [deg] and their standard errors from the lines'. A
/// heap that rises from the outlet has a positive angle. Bins without a grain are left out. Throws InputError
/// when the ledges are narrower than eight diameters or a side has fewer than three bins with grains.
Curve heapAngle(const Frame& frame, const HeapOptions& options);

} // namespace sandglass::analysis
