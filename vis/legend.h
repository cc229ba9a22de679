#pragma once
// What colours mean.

#include "vis/colour_map.h"

#include <string>
#include <vector>

namespace sandglass::vis {

struct Legend {
  std::string name, unit;
  ColourMap map{"viridis"};
  double low = 0, high = 1;
  std::vector<std::string> entries; ///< named things instead of a range (species, classes)
  long firstEntry = 0;              ///< the number that the first of them stands for
};

} // namespace sandglass::vis
