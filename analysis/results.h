#pragma once
// Everything that one analysis can give back, so that the command line, the desktop and the tests can take
// any of them without knowing which it was.

#include "analysis/field.h"
#include "analysis/result.h"
#include "sim/base/vec.h"

#include <map>
#include <string>
#include <vector>

namespace sandglass::analysis {

/// One number for each grain of the last Frame, in its order; NaN where it is not defined. For colouring.
struct GrainValues {
  std::string name; ///< snake_case: "q6", "local_fraction", "state"
  std::string unit; ///< SI symbol, "" when dimensionless
  std::string definition;
  std::vector<double> values;
  std::map<int, std::string> classes{}; ///< where values are classes: what each stands for
};

struct Ball {
  Vec3 centre = Vec3::Zero(); ///< [m]
  double radius = 0;          ///< [m]
  bool atWall = false;        ///< touches a wall
};

/// Spheres worth showing in space, largest first: the largest voids.
struct BallSet {
  std::string name, definition;
  std::vector<Ball> balls;
};

struct Results {
  std::vector<Curve> curves;
  std::vector<Table> tables;
  std::vector<Field> fields;
  std::vector<GrainValues> grains;
  std::vector<BallSet> balls;
  std::vector<std::string> sentences; ///< the key numbers in words, one line each
};

} // namespace sandglass::analysis
