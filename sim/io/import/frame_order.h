#pragma once
// Grains in the order of their ids.

#include "sim/frame/frame.h"

#include <optional>

namespace sandglass {

/// Sorts every list that has one entry a grain. Returns an id that occurs twice, if there is one.
std::optional<std::int64_t> sortById(Frame& frame);

} // namespace sandglass
