#pragma once
// What a hopper's half-angle does to the rate of a flat bottom, by the two corrections that are in use.

#include "analysis/beverloo.h"

namespace sandglass::analysis {

/// Factor of Brown & Richards (Principles of Powder Mechanics, 1970) for the half-angle from the vertical
/// [rad], 0 to pi / 2, where it is 1. Circle: (1 - cos^1.5 a) / sin^2.5 a. Slot, from the same argument of
/// least energy in the plane: integral of sqrt(cos t) from 0 to a over sin^1.5 a, over its value 1.1981 at pi
/// / 2.
double brownRichards(double halfAngle, OutletShape shape);

/// Factor of Rose & Tanaka (The Engineer 208, 465, 1959): (tan a tan s)^-0.35 where that product is below 1,
/// else 1; s: angle of the stagnant border above the horizontal [rad], usually 45 degrees.
double roseTanaka(double halfAngle, double stagnantAngle);

} // namespace sandglass::analysis
