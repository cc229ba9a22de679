#pragma once
// One contact whose motion the test prescribes, driven through the laws of a scene.

#include "tests/sim/physics/bench_scenes.h"

namespace sandglass::testing {

class OneContact {
public:
  /// Two grains of radius 1 mm and 5 mg each; normal along x.
  explicit OneContact(const LawStack& laws, double dt = 1e-6, double radius = 1e-3) : laws_(laws) {
    b.size = 1;
    b.oneType = true;
    b.type[0] = 0;
    b.dt = dt;
    b.nx[0] = 1, b.ny[0] = b.nz[0] = 0;
    b.vn[0] = b.vtx[0] = b.vty[0] = b.vtz[0] = b.wx[0] = b.wy[0] = b.wz[0] = 0;
    b.radiusA[0] = b.radiusB[0] = radius;
    b.effectiveRadius[0] = 0.5 * radius;
    b.inverseMassA[0] = b.inverseMassB[0] = 1 / 5e-6;
    b.effectiveMass[0] = 2.5e-6;
    for (auto& column : b.history)
      column[0] = 0;
  }

  /// Forces at this overlap [m] and slip velocity along y [m/s].
  void step(double overlap, double slip = 0.0) {
    b.overlap[0] = overlap;
    b.vty[0] = slip;
    laws_.apply(b, laws_.readsSpin());
  }

  double normal() const { return b.normalForce[0]; }
  double tangential() const { return -b.fty[0]; } ///< against the slip
  double stored() const {
    double sum = 0.0;
    for (const auto& entry : laws_.entries())
      sum += entry.law->storedEnergy(b, 0, entry.firstHistory);
    return sum;
  }

  ContactBlock b;

private:
  const LawStack& laws_;
};

} // namespace sandglass::testing
