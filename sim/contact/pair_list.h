#pragma once
// Who may touch whom: all pairs of grains nearer than reach + skin, with every periodic image as a pair of
// its own, so a box may be thinner than two cut-offs. A pair is keyed (id, id, image); its history lives in
// the list from birth to death and is carried over when the list is built anew.
//
// The list is laid out for the particle loop. Grains are sorted by cell. A pair belongs to the row of its
// grain that comes first in storage, so once row i is done every contact of grain i is known and nobody later
// reads its old state. Rows are cut into chunks of grains for threads; pairs between two chunks stand in a
// section of their own that is evaluated first. Sections start at multiples of `lane` and are padded with
// pairs of two phantom grains (storage indices grains.size() and grains.size() + 1) that never touch.
// The cutting depends on the number of grains alone, never on the number of threads.

#include "sim/base/parallel.h"
#include "sim/grains/grain_store.h"
#include "sim/scene/scene.h"

#include <array>
#include <cstdint>
#include <vector>

namespace sandglass {

class PairList {
public:
  static constexpr int lane = 8;      ///< pairs that a vector loop takes at once; histories are grouped so
  static constexpr int group = 32;    ///< grains that are integrated together
  static constexpr int slotCount = 8; ///< contacts per grain that are found without looking further

  struct Pair {
    std::int32_t a = 0, b = 0; ///< storage indices; a has the smaller id (or is its own image)
  };
  struct Range {
    std::int64_t begin = 0, end = 0;
  };
  /// A contact of a grain beyond its slots.
  struct Extra {
    std::int32_t grain, entry;
  };

  /// outputQuads: quads (4 doubles) that the particle loop writes per pair.
  PairList(const Domain& domain, int historySize, int outputQuads, bool keepsLive);

  /// Sorts the grains by cell, wraps them into the periodic box, remembers where they are (listed.x,y,z) and
  /// lists all pairs with distance below r_a + r_b + range + listed.w of a + listed.w of b, where `listed.w`
  /// of a grain, set by the caller, is how far it may move before the list is too old. Pairs that were listed
  /// before keep their history (and live flag), at the same key. Grains whose `drop` flag is set leave the
  /// store (an empty `drop` keeps all).
  void build(GrainStore& grains, double range, Parallel& parallel, const std::vector<std::uint8_t>& drop = {});

  std::int64_t entries() const;                ///< with padding; a multiple of `lane`
  std::int64_t size() const;                   ///< real pairs
  const std::vector<Pair>& pairs() const;      ///< entries() of them
  bool isPadding(std::int64_t p) const;        ///< a pair of phantoms
  bool periodic() const;
  /// Vector from the box to the image of b that pair p means: shifts()[shiftOf()[p]]. w is 0.
  const std::vector<std::uint8_t>& shiftOf() const; ///< empty without periodic directions; padding: the code of no shift
  const std::vector<Quad>& shifts() const;
  std::array<int, 3> image(std::int64_t p) const;
  /// Box crossings of b against a, which does not change when grains are wrapped: the third part of the key.
  std::int64_t imageKey(std::int64_t p, const GrainStore& grains) const;

  // Sections. Chunks are whole groups of grains.
  int chunks() const;
  Range crossing() const;          ///< pairs between chunks
  Range chunkGrains(int c) const;  ///< storage indices
  Range chunkPairs(int c) const;
  /// Where in its chunk's pairs the rows of a group of grains end (groupEnd(g), g = index / group).
  std::int64_t groupEnd(std::int64_t g) const;

  // Per grain: entries are (pair << 1 | 1 when the grain is b), in an order that does not depend on the
  // cutting into chunks; empty slots point at the zero output behind the last pair: entries() << 1.
  const std::int32_t* slots(std::int64_t grain) const; ///< slotCount of them
  const std::vector<Extra>& extras() const;            ///< ordered by grain
  Range groupExtras(std::int64_t g) const;             ///< into extras()

  // Histories: number k of pair p is history()[(p / lane) * lane * historySize + k * lane + p % lane].
  double* history();
  double historyOf(std::int64_t p, int k) const;
  void setHistory(std::int64_t p, int k, double value);
  /// Outputs: quad k of pair p is output()[p * outputQuads + k]; one more, all zero, at p = entries().
  Quad* output();
  std::uint8_t* live(); ///< 1: in range of a law with events; null unless keepsLive
  int historySize() const;
  int outputQuads() const;

  /// For checkpoints: the arrays that cannot be made again from the positions at listing time.
  std::vector<double>& historyArray();
  std::vector<std::uint8_t>& liveArray();

  std::size_t bytes() const;
};

} // namespace sandglass
