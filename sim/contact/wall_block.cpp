#include "sim/contact/wall_block.h"

#include <algorithm>

/// Over whole vectors, also behind the last contact: what is there is left from earlier blocks, and nobody
/// reads it.
#define VECTORS(c)                                                                                           \
  for (int begin = 0; begin < contact.size; begin += 8)                                                      \
  _Pragma("GCC ivdep") for (int c = begin; c < begin + 8; ++c)

namespace sandglass {

WallBlock::WallBlock() : contact{} {
  std::fill_n(contact.radiusA, capacity, 1.0);
  std::fill_n(contact.radiusB, capacity, 1.0);
  std::fill_n(contact.inverseMassA, capacity, 1.0);
  std::fill_n(distance, capacity, 0.0);
}

void WallBlock::finishMotion(bool turning, bool radiusArm) {
  ContactBlock& b = contact;
  VECTORS(c) {
    b.effectiveRadius[c] = b.radiusA[c];
    b.effectiveMass[c] = 1.0 / b.inverseMassA[c];
    const double vn = b.vtx[c] * b.nx[c] + b.vty[c] * b.ny[c] + b.vtz[c] * b.nz[c];
    b.vn[c] = vn;
    b.vtx[c] -= vn * b.nx[c];
    b.vty[c] -= vn * b.ny[c];
    b.vtz[c] -= vn * b.nz[c];
  }
  if (!turning) return;
  const double* arm = radiusArm ? b.radiusA : distance;
  VECTORS(c) {
    b.vtx[c] -= arm[c] * (b.wy[c] * b.nz[c] - b.wz[c] * b.ny[c]);
    b.vty[c] -= arm[c] * (b.wz[c] * b.nx[c] - b.wx[c] * b.nz[c]);
    b.vtz[c] -= arm[c] * (b.wx[c] * b.ny[c] - b.wy[c] * b.nx[c]);
  }
}

void WallBlock::finishForces(bool ownTorque, bool radiusArm) {
  const ContactBlock& b = contact;
  alignas(64) Column column[6];
  VECTORS(c) {
    column[0][c] = b.normalForce[c] * b.nx[c] + b.ftx[c];
    column[1][c] = b.normalForce[c] * b.ny[c] + b.fty[c];
    column[2][c] = b.normalForce[c] * b.nz[c] + b.ftz[c];
    share[c] = b.overlap[c] / b.radiusA[c];
  }
  const double* arm = radiusArm ? b.radiusA : distance;
  const double on = ownTorque ? 0.0 : 1.0;
  VECTORS(c) {
    column[3][c] = b.mx[c] - on * arm[c] * (b.ny[c] * b.ftz[c] - b.nz[c] * b.fty[c]);
    column[4][c] = b.my[c] - on * arm[c] * (b.nz[c] * b.ftx[c] - b.nx[c] * b.ftz[c]);
    column[5][c] = b.mz[c] - on * arm[c] * (b.nx[c] * b.fty[c] - b.ny[c] * b.ftx[c]);
  }
  rows = 0;
  for (int c = 0; c < contact.size; ++c) {
    if (slot[c] == 0) {
      ownerOfRow[rows] = owner[c];
      std::fill_n(row[rows++], 8, 0.0);
    }
    for (int k = 0; k < 6; ++k)
      row[rows - 1][k + k / 3] += column[k][c];
  }
}

double WallBlock::greatestShare() const {
  double greatest[8] = {};
  for (int begin = 0; begin < contact.size; begin += 8)
    for (int l = 0; l < 8; ++l)
      greatest[l] = share[begin + l] > greatest[l] ? share[begin + l] : greatest[l];
  return *std::max_element(greatest, greatest + 8);
}

} // namespace sandglass
