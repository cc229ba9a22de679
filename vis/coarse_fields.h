#pragma once
// Coarse-grained fields of a frame, so that a slice can be laid through it.

#include "sim/frame/frame.h"

#include <string>
#include <vector>

namespace sandglass::vis {

/// The frame itself when it holds fields, else with those of the analysis "fields" in it: a node a mean
/// diameter, at most 48 along the longest side. Uses the calling thread's TBB arena. Throws InputError with a
/// sentence when the frame lacks what that needs.
FramePtr withFields(const FramePtr& frame);

/// What such fields can be coloured by.
const std::vector<std::string>& fieldQuantities();

} // namespace sandglass::vis
