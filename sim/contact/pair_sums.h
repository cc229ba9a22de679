#pragma once
// Outputs of pairs, added to the sums of both grains. One text for all widths: the compiler cuts rows into
// its registers. Pairs are added one after the other, the first grain before the second, so all widths give
// the same bits; pairs that do nothing may be passed over, since a sum is never a negative zero.

#include "sim/contact/laws/arithmetic.h"
#include "sim/contact/pair_kernel.h"

#include <cstring>
#include <type_traits>

namespace sandglass {

namespace {

template <class Real> struct Quads;
template <> struct Quads<double> {
  using One = double __attribute__((vector_size(32)));
  using Two = double __attribute__((vector_size(64)));
};
template <> struct Quads<float> {
  using One = float __attribute__((vector_size(16)));
  using Two = float __attribute__((vector_size(32)));
};

/// Adds `quads` quads of `count` pairs from `first`; forces and couples change sign for the second grain,
/// torques do not.
template <int quads, class Real>
SANDGLASS_LOOP void addOutputs(const ParticleView& v, std::int64_t first, int count, const Real* out,
                               SumRing ring) {
  using Quad = Quads<double>::One;
  using Two = Quads<double>::Two;
  constexpr Two sign = {-1, -1, -1, -1, 1, 1, 1, 1};
  const std::int32_t* pair = v.pairs + 2 * first;
  for (const std::int32_t* const end = pair + 2 * count; pair < end; pair += 2, out += 4 * quads) {
    double* const a = ring.row(pair[0], quads);
    double* const b = ring.row(pair[1], quads);
    if constexpr (quads > 1) {
      typename Quads<Real>::Two both;
      std::memcpy(&both, out, sizeof both);
      const Two o = __builtin_convertvector(both, Two);
      Two sum;
      std::memcpy(&sum, a, sizeof sum);
      sum += o;
      std::memcpy(a, &sum, sizeof sum);
      std::memcpy(&sum, b, sizeof sum); // may be the same row
      sum += sign * o;
      std::memcpy(b, &sum, sizeof sum);
    }
    if constexpr (quads != 2) {
      constexpr int at = 4 * (quads - 1);
      typename Quads<Real>::One one;
      std::memcpy(&one, out + at, sizeof one);
      const Quad o = __builtin_convertvector(one, Quad);
      Quad sum;
      std::memcpy(&sum, a + at, sizeof sum);
      sum += o;
      std::memcpy(a + at, &sum, sizeof sum);
      std::memcpy(&sum, b + at, sizeof sum);
      sum -= o;
      std::memcpy(b + at, &sum, sizeof sum);
    }
  }
}

/// The same for one grain of a pair, wherever its output stands.
template <int quads, class Real>
SANDGLASS_LOOP void addSide(PairSide side, const Real* outputs, SumRing ring) {
  using Quad = Quads<double>::One;
  using Two = Quads<double>::Two;
  constexpr Two signs[2] = {{1, 1, 1, 1, 1, 1, 1, 1}, {-1, -1, -1, -1, 1, 1, 1, 1}};
  const Real* const out = outputs + std::int64_t{side.entry >> 1} * 4 * quads;
  double* const row = ring.row(side.grain, quads);
  if constexpr (quads > 1) {
    typename Quads<Real>::Two both;
    std::memcpy(&both, out, sizeof both);
    Two sum;
    std::memcpy(&sum, row, sizeof sum);
    sum += signs[side.entry & 1] * __builtin_convertvector(both, Two);
    std::memcpy(row, &sum, sizeof sum);
  }
  if constexpr (quads != 2) {
    constexpr int at = 4 * (quads - 1);
    typename Quads<Real>::One one;
    std::memcpy(&one, out + at, sizeof one);
    Quad sum;
    std::memcpy(&sum, row + at, sizeof sum);
    sum += (side.entry & 1 ? -1.0 : 1.0) * __builtin_convertvector(one, Quad);
    std::memcpy(row + at, &sum, sizeof sum);
  }
}

template <class Real>
[[maybe_unused]] void addSides(const ParticleView& v, const PairSide* sides, std::int64_t count,
                               const double* outputs, SumRing ring) {
  const auto all = [&](auto quads) {
    for (std::int64_t k = 0; k < count; ++k)
      addSide<quads>(sides[k], reinterpret_cast<const Real*>(outputs), ring);
  };
  if (v.outputQuads == 1)
    all(std::integral_constant<int, 1>());
  else if (v.outputQuads == 2)
    all(std::integral_constant<int, 2>());
  else
    all(std::integral_constant<int, 3>());
}

/// For the kernel of a width.
[[maybe_unused]] void add(const ParticleView& v, std::int64_t first, int count, const double* out,
                          SumRing ring) {
  if (v.outputQuads == 1)
    addOutputs<1>(v, first, count, out, ring);
  else if (v.outputQuads == 2)
    addOutputs<2>(v, first, count, out, ring);
  else
    addOutputs<3>(v, first, count, out, ring);
}

} // namespace

} // namespace sandglass
