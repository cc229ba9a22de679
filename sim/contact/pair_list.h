#pragma once
// Who may touch whom: all pairs of grains nearer than reach + skin, with every periodic image as a pair of
// its own, so a box may be thinner than two cut-offs. A pair is keyed (id, id, image); its history lives in
// the list from birth to death and is carried over when the list is built anew.
//
// The list is laid out for the particle loop. Grains are sorted by cell. A pair belongs to the row of its
// grain that comes first in storage, so once row i is done every contact of grain i is known and nobody later
// reads its old state. Rows are cut into chunks of grains for threads; pairs between two chunks stand in a
// section of their own that is evaluated first. Sections start at multiples of `lane` and are padded with
// pairs of two phantom grains (storage indices grains.size() and grains.size() + 1) that never touch: their
// outputs are zeros.
// The cutting depends on the number of grains alone, never on the number of threads: a power of two up to
// 16, so few that chunks of a cube of grains would be five layers thick, and one below 4096 grains.

#include "sim/base/parallel.h"
#include "sim/contact/cell_grid.h"
#include "sim/contact/pair_carry.h"
#include "sim/contact/pair_listing.h"
#include "sim/contact/pair_search.h"
#include "sim/grains/grain_store.h"
#include "sim/scene/scene.h"

#include <array>
#include <cstdint>
#include <vector>

namespace sandglass {

class PairList {
public:
  /// Pairs that a vector loop takes at once; histories are grouped so.
  static constexpr int lane = PairListing::lane;
  /// Grains that are integrated together.
  static constexpr int group = PairListing::group;
  /// Storage indices a and b; a has the smaller id (or is its own image).
  using Pair = PairListing::Pair;
  struct Range {
    std::int64_t begin = 0, end = 0;
  };

  /// outputStride: doubles that the particle loop writes per pair, as ParticleView has it. Histories are
  /// doubles, or floats if `single`.
  PairList(const Domain& domain, int historySize, int outputStride, bool keepsLive, bool single = false);

  /// How far grains may move [m] that are as fast as this [m/s]; grows with speed.
  using Allowance = CellGrid::Allowance;

  /// Sorts the grains by cell, wraps them into the periodic box, remembers where they are (listed.x,y,z) and
  /// lists all pairs with distance below r_a + r_b + range + listed.w of a + listed.w of b, where `listed.w`
  /// of a grain, set by the caller, is how far it may move before the list is too old. If `allowance` is
  /// given, it is set here: all grains of a group have what the fastest of them needs. Pairs that were listed
  /// before keep their history (and live flag), at the same key; since then, grains may have been appended,
  /// but not moved in storage. Grains whose `drop` flag is set leave the store (an empty `drop` keeps all).
  void build(GrainStore& grains, double range, Parallel& parallel, const std::vector<std::uint8_t>& drop = {},
             const Allowance& allowance = {});

  std::int64_t entries() const { return now_.entries; }           ///< with padding; a multiple of `lane`
  std::int64_t size() const { return size_; }                     ///< real pairs
  const AlignedVector<Pair>& pairs() const { return now_.pairs; } ///< entries() of them
  bool isPadding(std::int64_t p) const { return now_.pairs[p].a >= now_.grains; } ///< a pair of phantoms
  bool periodic() const { return periodic_; }
  /// Vector from the box to the image of b that pair p means: shifts()[shiftOf()[p]]. w is 0. Empty without
  /// periodic directions; padding: the code of no shift.
  const AlignedVector<std::uint8_t>& shiftOf() const { return now_.shiftOf; }
  const std::vector<Quad>& shifts() const { return now_.codes.shift; }
  std::array<int, 3> image(std::int64_t p) const;
  /// Box crossings of b against a, which does not change when grains are wrapped: the third part of the key.
  std::int64_t imageKey(std::int64_t p, const GrainStore& grains) const;

  /// Of all grains; 0 where they differ.
  double oneRadius() const { return grid_.oneRadius(); }
  double oneInverseMass() const { return grid_.oneInverseMass(); }

  // Sections. Chunks are whole groups of grains. Ranges of pairs include their padding: crossing() and the
  // chunks' pairs follow each other without gaps, up to entries().
  int chunks() const { return static_cast<int>(chunkGrains_.size()); }
  Range crossing() const { return crossing_; }               ///< pairs between chunks
  Range chunkGrains(int c) const { return chunkGrains_[c]; } ///< storage indices
  Range chunkPairs(int c) const { return chunkPairs_[c]; }
  /// Where in its chunk's pairs the rows of a group of grains end: a pair index, not padded. The first group
  /// of a chunk begins at chunkPairs(c).begin. g = index / group.
  std::int64_t groupEnd(std::int64_t g) const { return groupEnd_[g]; }
  /// The last grain of its chunk that the rows of a group name, images around the box left out: where a sweep
  /// meets records for the first time.
  std::int64_t groupReach(std::int64_t g) const { return groupReach_[g]; }

  // Sums of what contacts do to a grain stand in a ring while its chunk is swept from the first pair on,
  // blocks of ContactBlock::capacity pairs at a time: those of grain i in row i modulo sumRows(). It is no
  // longer than from the group of grains that is due to whoever has been met, so that it stays in the cache.
  std::int64_t sumRows() const { return sumRows_; } ///< a power of two, not below `group`
  /// The contacts of a group of grains with other chunks. g = index / group.
  const std::vector<PairSide>& crossings() const { return crossings_; }
  Range groupCrossings(std::int64_t g) const { return {groupCrossings_[g], groupCrossings_[g + 1]}; }

  // Histories: number k of pair p is history()[(p / lane) * lane * historySize + k * lane + p % lane], in
  // floats if they are single.
  double* history() { return reinterpret_cast<double*>(now_.history.data()); }
  double historyOf(std::int64_t p, int k) const {
    const Quad* all = now_.history.data();
    return single_ ? reinterpret_cast<const float*>(all)[placeOf(p, k)]
                   : reinterpret_cast<const double*>(all)[placeOf(p, k)];
  }
  void setHistory(std::int64_t p, int k, double value) {
    if (single_)
      reinterpret_cast<float*>(now_.history.data())[placeOf(p, k)] = static_cast<float>(value);
    else
      history()[placeOf(p, k)] = value;
    for (const int lanes : {1, 4, 8, 16})
      quiet_[p / lanes] = 0;
  }
  /// For loops that pass over pairs at rest, as ParticleView has it; zeros after a build.
  std::uint8_t* quiet() { return quiet_.data(); }
  /// Outputs of pairs between chunks: those of pair p begin at p * outputStride.
  double* crossingOutput() { return &memory_[0].x; }
  std::uint8_t* live() {
    return keepsLive_ ? now_.live.data() : nullptr;
  } ///< 1: in range of a law with events; null unless keepsLive
  int historySize() const { return historySize_; }
  int outputStride() const { return outputStride_; }

  // For checkpoints: what cannot be made again from the positions at listing time.
  std::vector<double> histories() const;             ///< as history() has them
  bool setHistories(const std::vector<double>& all); ///< false, and nothing done, if the size is another
  std::vector<std::uint8_t>& liveArray() { return now_.live; }

  std::size_t bytes() const;

private:
  /// Rows that one thread searches and writes at a time, whole groups within a chunk.
  struct Block {
    std::int64_t firstGrain, lastGrain, chunk;
    std::int64_t firstPair = 0, firstCrossing = 0; ///< where its rows go
    FoundRows rows;
  };

  std::size_t placeOf(std::int64_t p, int k) const {
    return static_cast<std::size_t>(p / lane * lane * historySize_ + k * lane + p % lane);
  }
  void fillColumns(GrainStore& grains, double range, const Allowance& allowance, std::int64_t first,
                   std::int64_t last);
  void cut(std::int64_t grains);
  void search(const GrainStore& grains, Parallel& parallel);
  void layOut();
  void fillPadding(std::int64_t from, std::int64_t to);
  void writeRows(const GrainStore& grains, Parallel& parallel);
  void writeGroup(const GrainStore& grains, Block& block, std::int64_t first,
                  std::vector<std::int32_t>& owners);
  void carryHistories(Parallel& parallel);
  void findCrossings(Parallel& parallel);
  void findRing();

  Domain domain_;
  bool periodic_ = false;
  int historySize_, outputStride_;
  bool keepsLive_, single_;
  PairListing now_;
  PairKeys past_; ///< of the listing before, while histories are carried
  std::int64_t size_ = 0;
  AlignedVector<Quad> memory_; ///< outputs of crossing pairs; during a build for anybody, old histories last
  std::int64_t sumRows_ = group;
  std::vector<PairSide> crossings_;
  std::vector<std::int32_t> groupCrossings_; ///< the first of each group, and their number
  Range crossing_;
  std::vector<Range> chunkGrains_, chunkPairs_,
      chunkCrossing_; ///< the last: crossing rows of a chunk's grains
  std::vector<std::int64_t> groupEnd_, groupReach_;
  std::vector<std::int32_t> groupLast_; ///< the group of the last grain of its chunk that a group's rows name
  std::vector<std::uint8_t> quiet_;

  // Of use during a build alone; kept because asking for memory anew costs more than the search.
  CellGrid grid_;
  AlignedVector<double> columnMemory_;
  GrainColumns columns_; ///< there
  std::vector<Block> blocks_;
  RowTable rows_;
  std::vector<std::int32_t> newOf_; ///< new storage index of each old grain
};

} // namespace sandglass
