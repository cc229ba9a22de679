#pragma once
// Walls by kind and parameters, and distances to them by brute force.

#include "sim/walls/wall_registry.h"

#include <map>
#include <stdexcept>

namespace sandglass::testing {

inline std::shared_ptr<const WallShape> makeWall(const std::string& kind,
                                                 std::map<std::string, ParameterValue> values) {
  for (const WallKind& k : wallKinds())
    if (k.name == kind) {
      Parameters p;
      for (const ParameterSpec& s : k.parameters)
        if (s.fallback) p.set(s.name, *s.fallback);
      for (auto& [name, value] : values)
        p.set(name, value);
      return k.make(p);
    }
  throw std::runtime_error("no such kind");
}

inline WallShape::Touches touchesOf(const WallShape& wall, const Vec3& x, double reach) {
  WallShape::Touches t;
  wall.touches(x, reach, t);
  return t;
}

/// Smallest value of f on [low, high]: the best of many samples, then golden sections to round-off of f.
template <class F> double smallest(F&& f, double low, double high, int samples) {
  double at = low, value = f(low);
  const double step = (high - low) / samples;
  for (int k = 1; k <= samples; ++k)
    if (const double v = f(low + k * step); v < value) {
      value = v;
      at = low + k * step;
    }
  double a = std::max(low, at - step), b = std::min(high, at + step);
  const double golden = 0.6180339887498949;
  for (int k = 0; k < 100; ++k) {
    const double c = b - golden * (b - a), d = a + golden * (b - a);
    (f(c) < f(d) ? b : a) = f(c) < f(d) ? d : c;
  }
  return std::min(value, f(0.5 * (a + b)));
}

} // namespace sandglass::testing
