#pragma once
// Sine and cosine for code that changes the state of a run: plain arithmetic in a fixed order, so that the
// bits do not depend on the C library or the processor.

namespace sandglass {

struct SineCosine {
  double sine = 0, cosine = 1;
};

/// Of an angle in turns (1 is a full circle): exact at multiples of a quarter turn, elsewhere within 2e-16.
/// Whole turns are taken off without rounding, so a long run costs no accuracy but that of `turns` itself.
SineCosine sineCosineOfTurns(double turns);

} // namespace sandglass
