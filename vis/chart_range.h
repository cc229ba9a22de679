#pragma once
// What a chart's axes span.

#include "analysis/result.h"

namespace sandglass::vis {

struct Span {
  double low = 0, high = 1;
};

struct ChartRange {
  Span x, y;
};

/// Everything finite that the curve holds: lines, error bars, marks. What comes near zero on its scale starts
/// there (y below half its largest value, x below a seventh); other ends get a little air.
ChartRange chartRange(const analysis::Curve& curve);

} // namespace sandglass::vis
