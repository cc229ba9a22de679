#include "sim/math/sector.h"

#include "sim/math/turns.h"

#include <algorithm>
#include <cmath>

namespace sandglass {

Sector::Sector(int count, int axis)
    : count_(count), axis_(axis), across_((axis + 1) % 3), along_((axis + 2) % 3), cosine_(count, 1.0),
      sine_(count, 0.0) {
  for (int k = 1; 2 * k <= count; ++k) {
    const SineCosine turn = sineCosineOfTurns(static_cast<double>(k) / count);
    cosine_[k] = cosine_[count - k] = turn.cosine;
    sine_[k] = turn.sine;
    sine_[count - k] = -turn.sine;
    if (2 * k == count) sine_[k] = 0.0;
  }
}

Vec3 Sector::turned(const Vec3& v, int k) const {
  const int turn = modulo(k);
  if (turn == 0) return v;
  const double c = cosine_[turn], s = sine_[turn];
  Vec3 w = v;
  w[across_] = c * v[across_] - s * v[along_];
  w[along_] = s * v[across_] + c * v[along_];
  return w;
}

int Sector::numberOf(const Vec3& x) const {
  if (whole()) return 0;
  const double c = cosine_[1], s = sine_[1];
  const auto inside = [&](const Vec3& p) {
    const double beside = s * p[across_] - c * p[along_]; // inside of the far face
    return count_ == 2 ? p[along_] > 0.0 || (p[along_] == 0.0 && p[across_] >= 0.0)
                       : p[along_] >= 0.0 && beside > 0.0;
  };
  for (int k = 0; 2 * k <= count_; ++k) {
    if (inside(turned(x, -k))) return k;
    if (inside(turned(x, k))) return modulo(-k);
  }
  return 0;
}

double Sector::radius(const Vec3& x) const {
  return std::sqrt(x[across_] * x[across_] + x[along_] * x[along_]);
}

double Sector::distance(const Vec3& x, int k) const {
  const Vec3 p = turned(x, k);
  // Each face is a half-plane: the nearest point of it is on the axis where p is behind the axis.
  const auto face = [&](double c, double s) {
    const double along = c * p[across_] + s * p[along_], beside = s * p[across_] - c * p[along_];
    return along > 0.0 ? std::abs(beside) : radius(p);
  };
  return whole() || numberOf(p) == 0 ? 0.0 : std::min(face(1.0, 0.0), face(cosine_[1], sine_[1]));
}

double Sector::coreRadius() const {
  // Two neighbouring images of a point at rho are 2 rho sin(pi/n) apart.
  return whole() ? 0.0 : 1.0 / std::sqrt(0.5 * (1.0 - cosine_[1]));
}

} // namespace sandglass
