#pragma once
// What text and binary dumps of LAMMPS have in common.

#include "sim/frame/frame.h"

#include <string>

namespace sandglass {

/// Bounds of a tilted box are those of all its corners, lower.x = xlo + min(0, xy, xz, xy + xz) and so on
/// (https://docs.lammps.org/Howto_triclinic.html). Takes them to the box itself, tilt = (xy, xz, yz); false
/// when nothing is left of it.
bool takeCornersOff(Domain& box, const Vec3& tilt);

/// What the user is told of units other than SI.
std::string unitsRemark(const std::string& units);

} // namespace sandglass
