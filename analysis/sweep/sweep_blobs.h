#pragma once
// Curves and last frames as bytes for the table of a sweep: little-endian, as documented in docs/sweep.md.

#include "analysis/result.h"
#include "sim/frame/frame.h"

#include <cstddef>
#include <span>
#include <vector>

namespace sandglass::analysis {

/// x, y of the first series as pairs of 32-bit floats.
std::vector<std::byte> curveBytes(const Curve& curve);
void readCurve(std::span<const std::byte> bytes, Curve& curve);

/// For each grain: id (64-bit integer), then as doubles radius, position, velocity: bit for bit.
std::vector<std::byte> frameBytes(const Frame& frame);
void readFrame(std::span<const std::byte> bytes, Frame& frame);

} // namespace sandglass::analysis
