#pragma once
// Coarse-grained averages about points: mass, momentum, stress and their gradients (Goldhirsch, Granular
// Matter 12, 239, 2010; Weinhart, Thornton, Luding & Bokhove, Granular Matter 14, 289, 2012).
//
// Kernel: Lucy's polynomial W(r) = 105 / (16 pi c^3) (1 + 3 r/c) (1 - r/c)^3 for r < c = 2 w; `width` is w.
// Its integral is 1; no part that lies behind a wall is made up for, so that densities fall off within 2 w of
// walls.
//   rho = sum m W      p = sum m v W      phi = sum V W      flux = sum m v v W
//   contact stress = sum over contacts of f l integral_0^1 W(x - x_j + s l) ds: l is the branch from the
//   partner's centre (a wall: from the contact point) to the grain's, f the force on the grain; pressure is
//   positive. gradients with the kernel's own.

#include "sim/frame/frame.h"

#include <span>
#include <vector>

namespace sandglass::analysis {

struct CoarseAverage {
  double mass = 0;                                            ///< rho [kg/m^3]
  double volume = 0;                                          ///< phi
  Vec3 momentum = Vec3::Zero();                               ///< p [kg/(m^2 s)]
  Eigen::Matrix3d flux = Eigen::Matrix3d::Zero();             ///< [Pa]
  Eigen::Matrix3d contactStress = Eigen::Matrix3d::Zero();    ///< [Pa]
  Vec3 massGradient = Vec3::Zero();                           ///< [kg/m^4]
  Eigen::Matrix3d momentumGradient = Eigen::Matrix3d::Zero(); ///< d p_row / d x_column

  CoarseAverage& operator+=(const CoarseAverage& other);
  CoarseAverage& operator*=(double factor);

  Vec3 velocity() const { return momentum / mass; }
  /// <|v - u|^2> / 3 [m^2/s^2], u at the same point.
  double temperature() const;
  Eigen::Matrix3d kineticStress() const; ///< flux - rho u u
  double pressure() const { return (kineticStress() + contactStress).trace() / 3; }
  Eigen::Matrix3d velocityGradient() const; ///< d u_row / d x_column [1/s]
  Eigen::Matrix3d strainRate() const;       ///< symmetric part
  double shearRate() const;                 ///< sqrt(2 D':D'), D' the strain rate without its trace
  Vec3 vorticity() const;                   ///< curl u [1/s]
};

/// What a Frame gives for averages; quantities that it lacks stay 0.
class CoarseGrainer {
public:
  /// `width` w [m]. Masses absent: volumes times `density` [kg/m^3]. Radii absent: `diameter` / 2. Throws
  /// InputError when velocities are missing.
  CoarseGrainer(const Frame& frame, double width, double diameter, double density);
  ~CoarseGrainer();

  /// Uses the calling thread's TBB arena; equal for any number of threads.
  std::vector<CoarseAverage> at(std::span<const Vec3> points) const;

  bool hasContacts() const;

private:
  struct Data;
  std::unique_ptr<Data> data_;
};

} // namespace sandglass::analysis
