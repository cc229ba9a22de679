#pragma once
// The loop of a law over a block, compiled once for each width and precision from one text. A law derives
// from LawLoop<itself>, and has public
//
//   template <class Real> struct Constants { Real k = 0, zeta = 0; }; // Real alone
//   std::vector<Constants<double>> table_;                            // per pair of materials
//
//   template <class Real, class Table>
//   SANDGLASS_LOOP void loop(ContactBlockOf<Real>& b, int firstHistory, const Table& table) const {
//     SANDGLASS_CONTACTS(i) {
//       const auto c = table(i);
//       ...
//     }
//   }
//
// Selections (`touches ? x : 0`), no branches, so that the loop becomes vector code. Only + - * / and square
// root: anything else would make bits depend on the width.

#include "sim/contact/law.h"
#include "sim/contact/laws/arithmetic.h"
#include "sim/contact/laws/narrowed.h"

#include <array>
#include <bit>
#include <vector>

/// Over all lanes of a block, also those behind its last contact, whose values nobody reads: a loop of fixed
/// length needs no remainder, and columns do not overlap.
#define SANDGLASS_CONTACTS(i) _Pragma("GCC ivdep") for (int i = 0; i < ContactBlock::capacity; ++i)

namespace sandglass {

template <class Derived> class LawLoop : public Law {
public:
  void apply(ContactBlock& b, int first, KernelWidth width) const final { dispatch(b, first, width); }
  void apply(ContactBlockSingle& b, int first, KernelWidth width) const final { dispatch(b, first, width); }
  bool singlePrecision() const final { return true; }

private:
  const Derived& self() const { return static_cast<const Derived&>(*this); }

  template <class Real> void dispatch(ContactBlockOf<Real>& b, int first, KernelWidth width) const {
    if (width == KernelWidth::avx512)
      avx512(b, first);
    else if (width == KernelWidth::avx2)
      avx2(b, first);
    else
      plain(b, first);
  }

  template <class Real>
  [[gnu::target("arch=x86-64-v4,prefer-vector-width=512"), gnu::noinline]] void
  avx512(ContactBlockOf<Real>& b, int first) const {
    run(b, first);
  }
  template <class Real> [[gnu::noinline]] void avx2(ContactBlockOf<Real>& b, int first) const {
    run(b, first);
  }
  template <class Real>
  [[gnu::optimize("no-tree-vectorize"), gnu::noinline]] void plain(ContactBlockOf<Real>& b, int first) const {
    run(b, first);
  }

  template <class Real> SANDGLASS_LOOP void run(ContactBlockOf<Real>& b, int first) const {
    using Given = typename Derived::template Constants<double>;
    using Wanted = typename Derived::template Constants<Real>;
    constexpr int fields = sizeof(Given) / sizeof(double);
    using Numbers = std::array<Real, fields>;
    const Given* rows = self().table_.data();
    if (b.oneType) {
      const Wanted c = narrowed<Wanted, Real>(rows[b.type[0]]);
      self().loop(b, first, [c](int) { return c; });
      return;
    }
    // Several kinds of pairs in one block: their constants become columns too.
    alignas(64) Real column[fields][ContactBlock::capacity];
    for (int i = 0; i < b.size; ++i) {
      const auto numbers = narrowed<Numbers, Real>(rows[b.type[i]]);
      for (int k = 0; k < fields; ++k)
        column[k][i] = numbers[k];
    }
    self().loop(b, first, [&column](int i) {
      Numbers numbers;
      for (int k = 0; k < fields; ++k)
        numbers[k] = column[k][i];
      return std::bit_cast<Wanted>(numbers);
    });
  }
};

} // namespace sandglass
