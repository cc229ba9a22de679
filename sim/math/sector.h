#pragma once
// A sector of a circle about a coordinate axis through the origin, one of n equal ones, each the others'
// image: what happens in it happens in all of them, turned. It lies at azimuths from 0 to 1/n of a turn,
// where azimuth 0 is the direction of the next axis (x, then y, z, x): about z it begins at y = 0, x > 0.
// Turning by k sectors and back gives the same matrix entries, so a force turned to an image and its reaction
// turned back are equal but for the rounding of products.

#include "sim/base/vec.h"

#include <vector>

namespace sandglass {

class Sector {
public:
  /// The whole circle: no images.
  Sector() : Sector(1, 2) {}
  /// `count` equal sectors; axis: 0, 1, 2 for x, y, z.
  Sector(int count, int axis);

  int count() const { return count_; }
  bool whole() const { return count_ == 1; }
  int axis() const { return axis_; }

  /// A vector, or a point, turned by k sectors.
  Vec3 turned(const Vec3& v, int k) const;
  /// Number of the sector in which x lies, 0 to count() - 1; 0 on the axis.
  int numberOf(const Vec3& x) const;
  /// k brought into 0 to count() - 1.
  int modulo(int k) const { return ((k % count_) + count_) % count_; }
  /// Distance from the axis.
  double radius(const Vec3& x) const;
  /// Distance from x, turned by k sectors, to sector 0; 0 inside.
  double distance(const Vec3& x, int k) const;
  /// How near the axis the centre of a sphere of radius 1 can come before it touches its own image.
  double coreRadius() const;

  /// Calls visit(k) for each turn k = 1 to count() - 1 that brings x, a point of sector 0 or a little beside
  /// it, nearer than `reach` to sector 0.
  template <class Visit> void eachImage(const Vec3& x, double reach, Visit&& visit) const {
    if (whole()) return;
    // Images further round are further away, until the axis is nearer than the faces: then all are alike.
    const bool all = radius(x) < reach;
    int last = 0;
    for (int k = 1; k < count_; ++k) {
      if (!all && distance(x, k) >= reach) break;
      visit(last = k);
    }
    for (int k = count_ - 1; k > last; --k) {
      if (!all && distance(x, k) >= reach) break;
      visit(k);
    }
  }

private:
  int count_, axis_, across_, along_; ///< the axis and the two after it
  std::vector<double> cosine_, sine_; ///< of k sectors
};

} // namespace sandglass
