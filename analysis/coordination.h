#pragma once
// Contacts of grains, by three definitions that are easily mixed up, and the grains that carry nothing.

#include "analysis/neighbour_list.h"
#include "sim/frame/frame.h"

#include <string>
#include <vector>

namespace sandglass::analysis {

struct ContactCounts {
  std::vector<int> contacts;   ///< of each grain, with grains and walls
  std::vector<int> mechanical; ///< the same without rattlers, 0 for rattlers
  std::vector<char> rattler; ///< grains with fewer than `least` contacts, found again after taking out others
  std::string definition;
};

/// From the Frame's contacts (overlap >= 0) where there are any; else pairs whose gap is at most `gap` times
/// the mean diameter, and walls likewise. `least`: 4 for rough grains, 2 dim = 6 for smooth ones is not asked
/// here: a grain held by fewer than dim + 1 = 4 contacts cannot be locked in place. Taking out is repeated
/// until nothing changes. Throws InputError when neither contacts nor radii are there.
ContactCounts contactCounts(const Frame& frame, double gap, int least);

} // namespace sandglass::analysis
