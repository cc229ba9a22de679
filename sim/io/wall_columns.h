#pragma once
// What a segment stores of each wall at each step, beside whether it is active.

#include "sim/frame/frame.h"

#include <array>
#include <utility>

namespace sandglass {

/// Data sets of three numbers a wall, and where they live in a frame.
inline constexpr std::array<std::pair<const char*, Vec3 FrameWall::*>, 6> wallVectorNames{
    {{"wallVelocity", &FrameWall::velocity},
     {"wallForce", &FrameWall::force},
     {"wallTorque", &FrameWall::torque},
     {"wallSpin", &FrameWall::spin},
     {"wallReference", &FrameWall::reference},
     {"wallTranslation", &FrameWall::translation}}};
/// Quaternion w, x, y, z that turns the wall from the scene's description to where it is.
inline constexpr const char* wallRotationName = "wallRotation";
/// Whether it has a motion (1 or 0), work [J], power [W], wear work [J], contacts begun.
inline constexpr const char* wallSumsName = "wallSums";

} // namespace sandglass
