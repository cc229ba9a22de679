#include "vis/superellipsoid.h"

#include <algorithm>
#include <cmath>

namespace sandglass::vis {

namespace {

struct Norm {
  double value;
  Vec3 gradient;
};

/// N and its gradient. With r = (|x|^a + |y|^a)^(1/a):
///   dN/dx = (r/N)^(b-1) (|x|/r)^(a-1) sgn x,   dN/dz = (|z|/N)^(b-1) sgn z.
Norm normAt(const Vec3& p, double e1, double e2) {
  const double a = 2 / e2, b = 2 / e1;
  const Vec3 q = p.cwiseAbs();
  const double wide = std::max(q.x(), q.y());
  const double r =
      wide > 0 ? wide * std::pow(std::pow(q.x() / wide, a) + std::pow(q.y() / wide, a), 1 / a) : 0;
  const double most = std::max(r, q.z());
  if (most == 0) return {0, Vec3::Zero()};
  const double n = most * std::pow(std::pow(r / most, b) + std::pow(q.z() / most, b), 1 / b);
  const double across = r > 0 ? std::pow(r / n, b - 1) : 0;
  const auto lateral = [&](double x) { return r > 0 ? across * std::pow(x / r, a - 1) : 0; };
  return {n, Vec3(std::copysign(lateral(q.x()), p.x()), std::copysign(lateral(q.y()), p.y()),
                  std::copysign(std::pow(q.z() / n, b - 1), p.z()))};
}

} // namespace

double surroundingRadius(const GrainShape& shape) {
  const Vec3& axes = shape.semiAxes;
  const double across = shape.e2 >= 1 ? std::max(axes.x(), axes.y()) : std::hypot(axes.x(), axes.y());
  return shape.e1 >= 1 ? std::max(across, axes.z()) : std::hypot(across, axes.z());
}

Vec3 inscribedEllipsoid(const GrainShape& shape) {
  // The octahedron, e = 2, holds the ellipsoid of 1 / sqrt(3) of its semi-axes, rounder shapes a larger one.
  const bool round = shape.e1 <= 1 && shape.e2 <= 1;
  return shape.semiAxes * (round ? 1 : 1 / std::sqrt(3.0));
}

double support(const GrainShape& shape, const Vec3& direction) {
  const Vec3 d = direction.cwiseProduct(shape.semiAxes).cwiseAbs();
  const auto joined = [](double x, double y, double e) {
    const double most = std::max(x, y), least = std::min(x, y);
    if (most == 0 || e >= 2) return most;
    if (e == 1) return std::hypot(most, least);
    const double p = 2 / (2 - e);
    return most * std::pow(1 + std::pow(least / most, p), 1 / p);
  };
  return joined(joined(d.x(), d.y(), shape.e2), d.z(), shape.e1);
}

std::optional<double> entryDistance(const GrainShape& shape, const Ray& ray) {
  const Vec3 from = ray.origin.cwiseQuotient(shape.semiAxes),
             way = ray.direction.cwiseQuotient(shape.semiAxes);
  // Into the box of the unit cube first: no point outside it has N < 1.
  double t = -std::numeric_limits<double>::infinity(), out = -t;
  for (int k = 0; k < 3; ++k) {
    if (way[k] == 0) {
      if (std::abs(from[k]) > 1) return std::nullopt;
      continue;
    }
    const double one = (-1 - from[k]) / way[k], other = (1 - from[k]) / way[k];
    t = std::max(t, std::min(one, other));
    out = std::min(out, std::max(one, other));
  }
  if (!(t < out) || t <= 0) return std::nullopt;
  constexpr int iterations = 100;
  for (int k = 0; k < iterations; ++k) {
    const Norm norm = normAt(from + t * way, shape.e1, shape.e2);
    if (norm.value < 1 + 1e-12) return t;
    const double slope = norm.gradient.dot(way);
    if (!(slope < 0)) return std::nullopt; // convex: it only rises from here
    t += (1 - norm.value) / slope;
    if (t > out) return std::nullopt;
  }
  return t;
}

Vec3 outwardNormal(const GrainShape& shape, const Vec3& point) {
  return normAt(point.cwiseQuotient(shape.semiAxes), shape.e1, shape.e2)
      .gradient.cwiseQuotient(shape.semiAxes)
      .normalized();
}

} // namespace sandglass::vis
