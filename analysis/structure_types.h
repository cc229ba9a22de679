#pragma once
// Crystal-like surroundings of equal grains from averaged bond order (Lechner & Dellago, J. Chem. Phys. 129,
// 114707, 2008): ordered where averaged q6 exceeds a threshold; then simple cubic by its large averaged q4,
// body-centred by averaged w6 > 0, face-centred by averaged w4 < 0, hexagonal by w4 > 0. Of the rest, grains
// that lie against a wall are told apart, since walls layer any packing.

#include <map>
#include <string>

namespace sandglass::analysis {

enum class StructureType {
  amorphous = 0,
  wallLayer = 1,
  faceCentred = 2,
  hexagonal = 3,
  bodyCentred = 4,
  simpleCubic = 5
};

struct StructureThresholds {
  double q6 = 0.35; ///< ordered above; random close packings have 0.2 to 0.3
  double q4 = 0.45; ///< simple cubic above; fcc has 0.19
};

/// NaN values are amorphous.
StructureType structureType(double q4, double q6, double w4, double w6, bool atWall,
                            const StructureThresholds& limits);

const std::map<int, std::string>& structureNames();

} // namespace sandglass::analysis
