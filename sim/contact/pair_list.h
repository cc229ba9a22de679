#pragma once
// Who may touch whom: all pairs of grains nearer than reach + skin, with every periodic image as a pair of
// its own, so a box may be thinner than two cut-offs. A pair is keyed (id, id, image); its history lives in
// the list from birth to death and is carried over when the list is built anew.

#include "sim/base/parallel.h"
#include "sim/grains/grain_store.h"
#include "sim/scene/scene.h"

#include <array>
#include <cstdint>
#include <vector>

namespace sandglass {

class PairList {
public:
  struct Pair {
    std::int32_t a = 0, b = 0; ///< storage indices; a has the smaller id (or is its own image)
  };

  PairList(const Domain& domain, int historySize, int outputSize);

  /// Sorts the grains by cell, wraps them into the periodic box, remembers where they are and lists all pairs
  /// with distance below r_a + r_b + range + allowed_a + allowed_b, where `listed.w` of a grain holds how far
  /// it may move before the list is too old. Live pairs keep their history, at the same key.
  /// Grains whose `drop` flag is set leave the store (an empty `drop` keeps all).
  void build(GrainStore& grains, double range, Parallel& parallel,
             const std::vector<std::uint8_t>& drop = {});

  std::size_t size() const { return pairs_.size(); }
  const std::vector<Pair>& pairs() const { return pairs_; }
  bool periodic() const { return periodic_; }
  /// Vector from the box to the image of b that pair p means.
  const Vec3& shift(std::size_t p) const { return shifts_[shiftOf_[p]]; }
  const std::vector<std::uint8_t>& shiftOf() const { return shiftOf_; }
  const std::vector<Vec3>& shifts() const { return shifts_; }
  std::array<int, 3> image(std::size_t p) const;
  /// Box crossings of b against a, which does not change when grains are wrapped: the third part of the key.
  std::int64_t imageKey(std::size_t p) const { return periodic_ ? imageKey_[p] : 0; }

  std::uint8_t* live() { return live_.data(); }
  double* history(std::size_t p) { return history_.data() + p * historySize_; }
  double* output(std::size_t p) { return output_.data() + p * outputSize_; }
  const double* outputs() const { return output_.data(); }
  int historySize() const { return historySize_; }
  int outputSize() const { return outputSize_; }

  /// Pairs of grain i as (pair << 1 | 1 when i is b), ordered by partner (id, image): the order in which its
  /// forces are summed, whatever the storage order or the age of the list.
  const std::int32_t* begin(std::size_t i) const { return entries_.data() + offsets_[i]; }
  const std::int32_t* end(std::size_t i) const { return entries_.data() + offsets_[i + 1]; }

  /// For checkpoints: the arrays that cannot be made again from positions.
  std::vector<double>& historyArray() { return history_; }
  std::vector<std::uint8_t>& liveArray() { return live_; }
  const std::vector<double>& historyArray() const { return history_; }
  const std::vector<std::uint8_t>& liveArray() const { return live_; }

  std::size_t bytes() const;

private:
  struct Cells;
  void wrap(GrainStore& grains) const;
  void search(const GrainStore& grains, const Cells& cells, double range, Parallel& parallel);
  void link(const GrainStore& grains);
  void carry(const PairList& old, const std::vector<std::int32_t>& oldIndex, const GrainStore& grains,
             Parallel& parallel);

  Domain domain_;
  Vec3 extent_ = Vec3::Zero();
  bool periodic_ = false;
  int historySize_, outputSize_;
  std::vector<Vec3> shifts_; ///< one per image code
  std::vector<std::array<int, 3>> codes_;
  std::vector<Pair> pairs_;
  std::vector<std::uint8_t> shiftOf_; ///< image code of a pair; empty without periodic directions
  std::vector<std::int64_t> imageKey_;
  std::vector<std::uint8_t> live_;
  std::vector<double> history_, output_;
  std::vector<std::int64_t> partnerIds_; ///< ids of a and b at build time, for carrying history
  std::vector<std::int32_t> offsets_, entries_;
};

} // namespace sandglass
