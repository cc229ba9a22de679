#pragma once
// Pair contacts: from grain records to forces per pair and new histories, block by block.

#include "sim/contact/law_stack.h"
#include "sim/contact/mixed/mixed_records.h"
#include "sim/contact/pair_kernel.h"
#include "sim/contact/pair_list.h"
#include "sim/grains/grain_store.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

namespace sandglass {

/// Birth or death of a pair under a gap law, applied after the force loop in the order of the keys.
struct PairEvent {
  std::int64_t idA, idB, imageKey;
  std::int64_t pair;
  std::int16_t law;
  ContactEvent event;
  bool torn = false; ///< history is to be erased afterwards: the pair has left the range of all laws
};

/// The deepest overlap met in a step, for the watchdog. Ties go to the smaller key, so threads do not matter.
struct DeepestOverlap {
  /// Instead of a share: a wall is touched in more places than can be kept.
  static constexpr double crowded = std::numeric_limits<double>::infinity();

  /// Instead of a share: a grain is so deep in a wall that its centre is about to pass through, and the wall
  /// would push it out on the other side (WallShape::pushesBack()).
  static constexpr double passing = std::numeric_limits<double>::max();
  static constexpr double aboutToPass = 0.9; ///< share from which on it is

  double share = 0;                ///< of the smaller radius
  std::int64_t idA = -1, idB = -1; ///< idB < 0: a wall
  int wall = -1;
  void take(double s, std::int64_t a, std::int64_t b, int w) {
    if (s > share || (s == share && (a < idA || (a == idA && b < idB)))) *this = {s, a, b, w};
  }
  void take(const DeepestOverlap& d) { take(d.share, d.idA, d.idB, d.wall); }
};

class PairForces {
public:
  /// What one thread needs.
  struct Scratch { // all zero at first: no lane is ever uninitialised
    ContactBlock block;
    PairColumns columns;
    std::vector<PairEvent> events;
    DeepestOverlap deepest;
    alignas(64) double outputs[12 * ContactBlock::capacity];
    AlignedVector<double> sums; ///< rows of a SumRing; zeros between sweeps
    bool swept = true;          ///< the last sweep came to its end
  };

  explicit PairForces(const LawStack& laws) : laws_(laws) {}

  /// Whether the laws have a loop of their own for the grains that are bound, which is faster than one by
  /// one.
  bool hasOwnLoop() const { return fusedLoop_ != nullptr; }

  /// Overlaps above this share of the smaller radius are reported.
  void watchOverlap(double share, double smallestRadius);

  /// Looks at grains and list anew; after each rebuild and each change of the number of grains.
  void bind(GrainStore& grains, PairList& list);
  const ParticleView& view() const { return view_; }
  KernelWidth width() const { return laws_.width(); }
  const Kernel& kernel() const { return kernel_; }
  /// Under mixed precision: grains have moved otherwise than by the kernel.
  void refresh();
  std::size_t bytes() const { return mixed_.bytes() + placeOfPair_.size(); }

  /// Evaluates the pairs of a range that starts and ends at multiples of PairList::lane: outputs, which begin
  /// at `out`, and, unless `keepHistory`, histories.
  void evaluate(PairList::Range range, double dt, bool keepHistory, Scratch& scratch, double* out) const;
  /// The same for no more than a block of them, whose outputs are added to `sums`. `ahead`: the grain whose
  /// record and following ones will be read soon, for the first time.
  void addBlock(PairList::Range range, double dt, bool keepHistory, Scratch& scratch, SumRing sums,
                std::int64_t ahead) const;

  /// Energy stored in all contacts [J], with histories as the step of length dt would leave them.
  double storedEnergy(double dt) const;

  /// Calls visit(pair, block, c) for each pair in contact or in range, with the forces that the next step of
  /// length dt begins with; changes nothing.
  template <class Visit> void visitContacts(double dt, Visit&& visit) const;

private:
  void pickLoop(int material);
  bool bindTables();
  void evaluateBlock(PairList::Range range, double dt, bool keepHistory, Scratch& scratch, double* out,
                     SumRing sums, const char* ahead) const;
  void fillBlock(std::int64_t first, int count, double dt, ContactBlock& b, PairColumns& columns) const;
  void applyLaws(std::int64_t first, Scratch& scratch) const;
  void leaveRange(std::int64_t first, const double (*before)[ContactBlock::capacity], Scratch& scratch) const;
  void reportOverlaps(std::int64_t first, Scratch& scratch) const;

  const LawStack& laws_;
  Kernel kernel_{};
  FusedLaws fused_;
  FusedTables tables_;
  std::vector<std::uint8_t> placeOfPair_; ///< in the tables
  FusedLoop fusedLoop_ = nullptr;         ///< in place of the laws one by one
  ParticleView view_;
  MixedRecords mixed_;
  GrainStore* grains_ = nullptr;
  PairList* list_ = nullptr;
  double overlapShare_ = 1e300, overlapLength_ = 1e300;
};

template <class Visit> void PairForces::visitContacts(double dt, Visit&& visit) const {
  if (!list_) return;
  ContactBlock block;
  PairColumns columns;
  for (std::int64_t first = 0; first < list_->entries(); first += ContactBlock::capacity) {
    const int count =
        static_cast<int>(std::min<std::int64_t>(ContactBlock::capacity, list_->entries() - first));
    fillBlock(first, count, dt, block, columns);
    laws_.addForces(block);
    if (block.oneType) std::fill_n(block.type, count, block.type[0]);
    for (int c = 0; c < count; ++c)
      if (block.overlap[c] > -laws_.range() && !list_->isPadding(first + c)) visit(first + c, block, c);
  }
}

} // namespace sandglass
