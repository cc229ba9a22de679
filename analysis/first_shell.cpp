#include "analysis/first_shell.h"

#include <algorithm>
#include <cmath>

namespace sandglass::analysis {

std::optional<FirstShell> firstShell(std::span<const double> r, std::span<const double> g,
                                     std::span<const double> error) {
  if (r.size() < 5) return std::nullopt;
  const double width = r[1] - r[0];
  std::size_t peak = 0;
  for (std::size_t b = 0; b < r.size() && r[b] < 1.5; ++b)
    if (g[b] > g[peak]) peak = b;
  if (!(g[peak] > 1 + 3 * error[peak]) || r[peak] <= 0) return std::nullopt;

  const std::size_t half = static_cast<std::size_t>(std::lround(0.05 / width));
  const auto smooth = [&](std::size_t b) {
    double sum = 0;
    for (std::size_t k = b - half; k <= b + half; ++k)
      sum += g[k];
    return sum / static_cast<double>(2 * half + 1);
  };
  const std::size_t from = std::max(peak + 1, half);
  std::size_t to = from;
  while (to + half + 1 < r.size() && r[to + 1] <= 1.75 * r[peak])
    ++to;
  if (to <= from) return std::nullopt;
  std::size_t lowest = from;
  for (std::size_t b = from; b <= to; ++b)
    if (smooth(b) < smooth(lowest) - 1e-12) lowest = b;
  if (!(smooth(lowest) < 1) || lowest == to) return std::nullopt;
  std::size_t last = lowest;
  while (last + 1 <= to && smooth(last + 1) <= smooth(lowest) + 1e-12)
    ++last;
  double minimum = 0.5 * (r[lowest] + r[last]);

  // Granular minima are broad and noisy: the vertex of a parabola through g within 0.15 either side. With
  // offsets t symmetric about 0: slope = S(tg) / S(tt), curvature from the even moments.
  const std::size_t wing = static_cast<std::size_t>(std::lround(0.15 / width));
  if (wing >= 2 && lowest > peak + wing && lowest + wing < r.size() && last == lowest) {
    double n = 0, tt = 0, tttt = 0, sg = 0, tg = 0, ttg = 0;
    for (std::size_t b = lowest - wing; b <= lowest + wing; ++b) {
      const double t = r[b] - r[lowest];
      n += 1, tt += t * t, tttt += t * t * t * t;
      sg += g[b], tg += t * g[b], ttg += t * t * g[b];
    }
    const double curvature = (n * ttg - tt * sg) / (n * tttt - tt * tt), shift = -tg / tt / (2 * curvature);
    if (curvature > 0 && std::abs(shift) < 0.15) minimum += shift;
  }
  return FirstShell{r[peak], minimum};
}

} // namespace sandglass::analysis
