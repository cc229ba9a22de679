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
#include <functional>
#include <vector>

namespace sandglass {

class PairList {
public:
  static constexpr int lane = 8, group = 32, slotCount = 8;
  struct Pair { std::int32_t a = 0, b = 0; };
  struct Range { std::int64_t begin = 0, end = 0; };
  struct Extra { std::int32_t grain, entry; };
  using Allow = std::function<void(std::int64_t first, std::int64_t last)>;
  PairList(const Domain& domain, int h, int o, bool live) : d(domain), H(h), O(o), L(live) {}
  void build(GrainStore& grains, double range, Parallel& parallel, const std::vector<std::uint8_t>& drop = {}, const Allow& allow = {});
  std::int64_t entries() const { return (std::int64_t)P.size(); }
  std::int64_t size() const { return real; }
  const std::vector<Pair>& pairs() const { return P; }
  bool isPadding(std::int64_t p) const { return P[p].a >= n; }
  bool periodic() const { return d.periodic[0]||d.periodic[1]||d.periodic[2]; }
  const std::vector<std::uint8_t>& shiftOf() const { return S; }
  const std::vector<Quad>& shifts() const { return T; }
  std::array<int,3> image(std::int64_t p) const { if(!periodic()) return {0,0,0}; int c=S[p]; return {c/9-1,c/3%3-1,c%3-1}; }
  std::int64_t imageKey(std::int64_t p, const GrainStore& g) const { if(!periodic()) return 0; auto im=image(p); std::int64_t k=0; for(int q=0;q<3;++q) k=k*(1<<21)+(im[q]-g.image[P[p].b][q]+g.image[P[p].a][q]+(1<<20)); return k; }
  int chunks() const { return 1; }
  Range crossing() const { return {0,0}; }
  Range chunkGrains(int) const { return {0,n}; }
  Range chunkPairs(int) const { return {0,entries()}; }
  std::int64_t groupEnd(std::int64_t g) const { return E[g]; }
  const std::int32_t* slots(std::int64_t g) const { return slot.data()+8*g; }
  const std::vector<Extra>& extras() const { return X; }
  Range groupExtras(std::int64_t g) const { return {XS[g],XS[g+1]}; }
  double* history() { return Hs.data(); }
  double historyOf(std::int64_t p,int k) const { return Hs[(p/8)*8*H+k*8+p%8]; }
  void setHistory(std::int64_t p,int k,double v) { Hs[(p/8)*8*H+k*8+p%8]=v; }
  Quad* output() { return out.data(); }
  std::uint8_t* live() { return L? lv.data():nullptr; }
  int historySize() const { return H; }
  int outputQuads() const { return O; }
  std::vector<double>& historyArray() { return Hs; }
  std::vector<std::uint8_t>& liveArray() { return lv; }
  std::size_t bytes() const { return 0; }
  Domain d; int H,O; bool L; std::int64_t n=0, real=0;
  std::vector<Pair> P; std::vector<std::uint8_t> S, lv; std::vector<Quad> T, out; std::vector<std::int64_t> E, XS; std::vector<std::int32_t> slot; std::vector<Extra> X; std::vector<double> Hs;
};
} // namespace sandglass
