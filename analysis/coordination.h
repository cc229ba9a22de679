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
  std::vector<char> rattler;   ///< grains with fewer than `least` contacts
  std::string definition;
};

/// From the Frame's contacts (overlap >= 0) where there are any; else pairs whose gap is at most `gap` times
/// the mean diameter, and walls likewise. With `again`, those who have fewer than `least` after rattlers were
/// taken out are rattlers, too, until nothing changes: right for smooth grains, while rough ones rest on
/// three or even two others, and whole beds fall apart on paper. Throws InputError when neither contacts nor
/// radii are there.
ContactCounts contactCounts(const Frame& frame, double gap, int least, bool again = false);

} // namespace sandglass::analysis
