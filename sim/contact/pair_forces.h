#pragma once
// One step of all pair contacts: from positions and velocities to forces per pair and new histories.

#include "sim/contact/law_stack.h"
#include "sim/contact/pair_list.h"
#include "sim/grains/grain_store.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace sandglass {

/// Birth or death of a pair under a gap law, applied after the force loop in the order of the keys.
struct PairEvent {
  std::int64_t idA, idB, imageKey;
  std::int32_t pair;
  std::int16_t law;
  ContactEvent event;
  bool torn = false; ///< history is to be erased afterwards: the pair has left the range of all laws
};

/// The deepest overlap met in a step, for the watchdog. Ties go to the smaller key, so threads do not matter.
struct DeepestOverlap {
  double share = 0;                ///< of the smaller radius
  std::int64_t idA = -1, idB = -1; ///< idB < 0: a wall
  int wall = -1;
  void take(double s, std::int64_t a, std::int64_t b, int w) {
    if (s > share || (s == share && (a < idA || (a == idA && b < idB)))) *this = {s, a, b, w};
  }
};

class PairForces {
public:
  explicit PairForces(const LawStack& laws) : laws_(laws) {}

  /// Evaluates every pair: writes PairList::output (force on a, torque over radius, couple) and history.
  void step(const GrainStore& grains, PairList& list, double dt, Parallel& parallel,
            std::vector<PairEvent>& events, DeepestOverlap& deepest) const;

  /// Energy stored in all contacts [J]; changes nothing.
  double storedEnergy(const GrainStore& grains, PairList& list) const;

  /// Calls visit(pair, block, c) for each pair in contact, with forces of the present state; changes nothing.
  template <class Visit> void visitContacts(const GrainStore& grains, PairList& list, Visit&& visit) const;

  /// Fills geometry and motion of the pairs in `index[0..count)`.
  void fill(const GrainStore& grains, PairList& list, const std::int32_t* index, int count, double dt,
            ContactBlock& block) const;

private:
  template <bool periodic>
  void range(const GrainStore& grains, PairList& list, double dt, std::int64_t first, std::int64_t last,
             std::vector<PairEvent>& events, DeepestOverlap& deepest) const;
  void flush(const GrainStore& grains, PairList& list, const std::int32_t* index, int count,
             ContactBlock& block, std::vector<PairEvent>& events, DeepestOverlap& deepest) const;

  const LawStack& laws_;
};

/// Sums what each grain gets from its pairs, in partner order, into force and torque (added to what is
/// there).
void gatherPairForces(GrainStore& grains, const PairList& list, const LawStack& laws, std::int64_t first,
                      std::int64_t last);

template <class Visit>
void PairForces::visitContacts(const GrainStore& grains, PairList& list, Visit&& visit) const {
  ContactBlock block;
  std::int32_t index[ContactBlock::capacity];
  int count = 0;
  const auto flushAll = [&] {
    fill(grains, list, index, count, 0.0, block);
    laws_.apply(block, laws_.readsSpin());
    for (int c = 0; c < count; ++c)
      visit(static_cast<std::size_t>(index[c]), block, c);
    count = 0;
  };
  for (std::size_t p = 0; p < list.size(); ++p) {
    if (!list.live()[p]) continue;
    index[count++] = static_cast<std::int32_t>(p);
    if (count == ContactBlock::capacity) flushAll();
  }
  if (count) flushAll();
}

} // namespace sandglass
