#pragma once
// How far the grains of each group may have moved since pairs were listed. A step adds the greatest speed of
// a group, which is cheap and counts every way there and back; when some group's allowance is used up by
// that, a look at where the grains really are shows what is left of it.
//
// Only what two grains do against each other matters. Displacements d(X) from the listed places X are split
// in what all grains have in common, A(X) = a + G X, and the rest e. A pair that was listed as too far apart,
// at a distance of reach_i + reach_j or more, is now no nearer than
//   (reach_i + reach_j) (1 - |G|) - |e_i| - |e_j|,
// for any A. Around a periodic box an image has the displacement of its grain, so G is zero along periodic
// axes. Walls and fields do not move with A, so this is for scenes without them.

#include "sim/base/parallel.h"
#include "sim/grains/grain_store.h"

#include <array>
#include <cstdint>
#include <vector>

namespace sandglass {

class GroupTravel {
public:
  /// Grains have just been listed: those of a group may move as far as `listed.w` of its first says.
  void begin(const GrainStore& grains);

  /// The group has moved by no more than so much [m] again; true if its list may now be too old.
  bool add(std::int64_t group, double length) {
    moved_[group] += length;
    return moved_[group] > allowed_[group];
  }

  /// Takes the bounds anew from where the grains are. `range`: of the laws, across gaps [m]. Returns whether
  /// lists are good for a while yet; if not, make them anew.
  bool measure(const GrainStore& grains, double range, const std::array<bool, 3>& periodic,
               Parallel& parallel);

  /// For checkpoints [m].
  std::vector<double>& moved() { return moved_; }

private:
  std::vector<double> moved_, allowed_;
};

} // namespace sandglass
