#pragma once
// What the formulas of laws are written in, so that one text serves single numbers (loops over columns, which
// the compiler vectorises) and whole registers (fused kernels). Besides + - * they use a policy `A`:
//   root(a), over(a, b)        square root, a / b
//   overRoot(a, b, r, mask)    a / root(b), and r = root(b); lanes outside the mask may hold anything
//   fma(a, b, c), fnma        a b + c, c - a b, rounded once
//   above(a, b)                a > b, as a mask
//   both(mask, mask)           where both hold
//   any(mask)                  whether it holds anywhere
//   pick(mask, a, b)           mask ? a : b
//   all<V>(number)            the number in every place
//   larger(a, b)               a < b ? b : a, as std::max has it, NaN included
// Constants of a law are single numbers, or registers too where each pair has its own.
// An exact policy gives the bits of IEEE arithmetic, whatever the width.

/// Inlined always: files are compiled for different processors, and what is not inlined may be merged.
#define SANDGLASS_LOOP [[gnu::always_inline]] inline
#define SANDGLASS_LAMBDA __attribute__((always_inline))

namespace sandglass {

struct ScalarArithmetic {
  template <class V> SANDGLASS_LOOP static V all(V a) { return a; }
  template <class V> SANDGLASS_LOOP static V root(V a) { return static_cast<V>(__builtin_sqrt(a)); }
  template <class V> SANDGLASS_LOOP static V over(V a, V b) { return a / b; }
  template <class V> SANDGLASS_LOOP static V overRoot(V a, V b, V& rootOfB, bool = true) {
    rootOfB = root(b);
    return a / rootOfB;
  }
  template <class V> SANDGLASS_LOOP static V fma(V a, V b, V c) {
    if constexpr (sizeof(V) == sizeof(float))
      return __builtin_fmaf(a, b, c);
    else
      return __builtin_fma(a, b, c);
  }
  template <class V> SANDGLASS_LOOP static V fnma(V a, V b, V c) { return fma(-a, b, c); }
  template <class V> SANDGLASS_LOOP static bool above(V a, V b) { return a > b; }
  SANDGLASS_LOOP static bool both(bool a, bool b) { return a && b; }
  SANDGLASS_LOOP static bool any(bool a) { return a; }
  template <class V> SANDGLASS_LOOP static V pick(bool mask, V a, V b) { return mask ? a : b; }
  template <class V> SANDGLASS_LOOP static V larger(V a, V b) { return a < b ? b : a; }
};

} // namespace sandglass
