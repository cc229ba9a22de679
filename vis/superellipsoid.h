#pragma once
// Geometry of a superellipsoid for drawing and picking.
//
// With a = 2 / e2 and b = 2 / e1, N(p) = ((|x|^a + |y|^a)^(b/a) + |z|^b)^(1/b) of p in units of the semi-axes
// is a norm for all convex shapes (nested p-norms); the surface is N = 1. Along a ray N is therefore convex,
// and Newton's iteration from a point before the surface runs up to it without ever passing it: no bisection,
// no missed roots. The fragment shader of the ray-cast grains uses the same iteration.

#include "sim/frame/frame.h"
#include "vis/camera.h"

#include <optional>

namespace sandglass::vis {

/// The radius of a sphere around the shape: the smallest for ellipsoids, that of its box otherwise.
double surroundingRadius(const GrainShape& shape);

/// Semi-axes of an ellipsoid inside the shape.
Vec3 inscribedEllipsoid(const GrainShape& shape);

/// How far the shape reaches from its centre along a direction given in its own axes, of unit length: the
/// dual of the norm, with exponents 2 / (2 - e).
double support(const GrainShape& shape, const Vec3& direction);

/// Distance along a ray, given in the shape's own axes, to where it enters the shape; nothing when it misses
/// or starts inside.
std::optional<double> entryDistance(const GrainShape& shape, const Ray& ray);

/// The outward normal at a point of the surface, in the shape's own axes, of unit length.
Vec3 outwardNormal(const GrainShape& shape, const Vec3& point);

} // namespace sandglass::vis
