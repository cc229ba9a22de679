// The plain kernel: one number at a time. It is the oracle of the vector kernels.

#include "sim/contact/pair_kernel_shared.h"
#include "sim/contact/pair_sums.h"

#include <algorithm>

namespace sandglass {

namespace {

void fill(const ParticleView& v, std::int64_t first, int count, ContactBlock& b, PairColumns& p) {
  const std::int64_t stride = 4 * v.quads;
  const bool turning = v.quads > 2;
  b.size = count;
  for (int c = 0; c < count; ++c) {
    const double* a = v.records + v.pairs[2 * (first + c)] * stride;
    const double* z = v.records + v.pairs[2 * (first + c) + 1] * stride;
    const double* shift = v.shifts ? v.shifts + 4 * v.shiftOf[first + c] : nullptr;
    b.nx[c] = a[0] - (shift ? z[0] + shift[0] : z[0]);
    b.ny[c] = a[1] - (shift ? z[1] + shift[1] : z[1]);
    b.nz[c] = a[2] - (shift ? z[2] + shift[2] : z[2]);
    p.sum[c] = a[3] + z[3];
    b.vtx[c] = a[4] - z[4];
    b.vty[c] = a[5] - z[5];
    b.vtz[c] = a[6] - z[6];
    p.inverseMass[c] = a[7] + z[7];
    if (!turning) continue;
    p.rollX[c] = a[8] + z[8];
    p.rollY[c] = a[9] + z[9];
    p.rollZ[c] = a[10] + z[10];
    p.inverseRadii[c] = a[11] + z[11];
    if (!v.readsSpin) continue;
    const double sign = v.ownTorque ? -1.0 : 1.0;
    b.wx[c] = a[8] * a[11] - sign * z[8] * z[11];
    b.wy[c] = a[9] * a[11] - sign * z[9] * z[11];
    b.wz[c] = a[10] * a[11] - sign * z[10] * z[11];
  }
  turning ? finishGeometry<true>(b, p, v.radiusArm) : finishGeometry<false>(b, p, v.radiusArm);
  fillExtras(v, first, b, p);
  fillHistory(v, first, b);
  clearForces(b, v.readsSpin);
}

void write(const ParticleView& v, std::int64_t first, const ContactBlock& b, const PairColumns& p,
           bool keepHistory, double* output) {
  if (!keepHistory) writeHistory(v, first, b);
  OutputColumns o;
  outputs(v, b, p, o);
  for (int c = 0; c < b.size; ++c) {
    double* out = output + c * 4 * v.outputQuads;
    out[0] = o.fx[c];
    out[1] = o.fy[c];
    out[2] = o.fz[c];
    if (v.outputQuads < 2) continue;
    out[4] = o.tx[c];
    out[5] = o.ty[c];
    out[6] = o.tz[c];
    out[7] = o.overlap[c];
    if (v.outputQuads < 3) continue;
    out[8] = b.mx[c];
    out[9] = b.my[c];
    out[10] = b.mz[c];
  }
}

void move(const ParticleView& v, std::int64_t first, int count, GroupSums s, double dt, const double* gravity,
          double speedLimit, Speeds& speeds) {
  double most[3] = {speeds.x, speeds.y, speeds.z};
  for (int i = 0; i < count; ++i) {
    double* r = v.records + (first + i) * 4 * v.quads;
    double* f = s.at(i);
    const double kick = dt * r[7];
    const bool free = r[7] > heldInverseMass;
    for (int k = 0; k < 3; ++k) {
      r[4 + k] = r[4 + k] + (free ? kick * f[k] + dt * gravity[k] : 0.0);
      r[k] = r[k] + dt * r[4 + k];
      const double size = r[4 + k] < 0.0 ? -r[4 + k] : r[4 + k];
      most[k] = size > most[k] ? size : most[k];
      speeds.bad = speeds.bad || !(size < speedLimit);
    }
    const double turn = 2.5 * kick;
    for (int k = 0; k < 3 && v.quads > 2; ++k) {
      const double torque = v.outputQuads > 2 ? f[4 + k] + f[8 + k] * r[11] : f[4 + k];
      r[8 + k] = r[8 + k] + (free ? turn * torque : 0.0);
    }
    std::fill_n(f, s.stride, 0.0);
  }
  speeds.x = most[0];
  speeds.y = most[1];
  speeds.z = most[2];
}

} // namespace

const Kernel& plainKernel() {
  static const Kernel kernel{fill, write, add, addSides<double>, move};
  return kernel;
}

} // namespace sandglass
