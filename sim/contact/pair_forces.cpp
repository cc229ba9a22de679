#include "sim/contact/pair_forces.h"

#include <algorithm>
#include <cmath>
#include <mutex>

namespace sandglass {

void PairForces::fill(const GrainStore& grains, PairList& list, const std::int32_t* index, int count,
                      double dt, ContactBlock& b) const {
  b.size = count;
  b.dt = dt;
  b.oneType = laws_.materials() == 1;
  const bool turning = laws_.turning(), periodic = list.periodic(), fullArm = laws_.fullRadiusArm();
  // Gather: scalar loads of whole records. Positions go to n for the time being.
  alignas(64) double dvx[ContactBlock::capacity], dvy[ContactBlock::capacity], dvz[ContactBlock::capacity];
  alignas(64) double sx[ContactBlock::capacity], sy[ContactBlock::capacity], sz[ContactBlock::capacity];
  for (int c = 0; c < count; ++c) {
    const std::size_t p = index[c];
    const auto [i, j] = list.pairs()[p];
    const Quad xi = grains.place[i], xj = grains.place[j], vi = grains.motion[i], vj = grains.motion[j];
    b.nx[c] = xi.x - xj.x;
    b.ny[c] = xi.y - xj.y;
    b.nz[c] = xi.z - xj.z;
    if (periodic) {
      const Vec3& s = list.shift(p);
      b.nx[c] = xi.x - (xj.x + s.x());
      b.ny[c] = xi.y - (xj.y + s.y());
      b.nz[c] = xi.z - (xj.z + s.z());
    }
    b.radiusA[c] = xi.w;
    b.radiusB[c] = xj.w;
    b.inverseMassA[c] = vi.w;
    b.inverseMassB[c] = vj.w;
    dvx[c] = vi.x - vj.x;
    dvy[c] = vi.y - vj.y;
    dvz[c] = vi.z - vj.z;
    b.type[c] = laws_.typeOf(grains.material[i], grains.material[j]);
    if (!turning) continue;
    const Quad wi = grains.spin[i], wj = grains.spin[j];
    sx[c] = xi.w * wi.x + xj.w * wj.x; // weighted spins; scaled to the contact arms below
    sy[c] = xi.w * wi.y + xj.w * wj.y;
    sz[c] = xi.w * wi.z + xj.w * wj.z;
    if (laws_.readsSpin()) {
      b.wx[c] = wi.x - wj.x;
      b.wy[c] = wi.y - wj.y;
      b.wz[c] = wi.z - wj.z;
    }
  }
  for (int c = 0; c < count; ++c) {
    const double d = std::sqrt(b.nx[c] * b.nx[c] + b.ny[c] * b.ny[c] + b.nz[c] * b.nz[c]);
    const double inverse = 1.0 / d, sum = b.radiusA[c] + b.radiusB[c];
    b.nx[c] *= inverse;
    b.ny[c] *= inverse;
    b.nz[c] *= inverse;
    b.overlap[c] = sum - d;
    b.effectiveRadius[c] = b.radiusA[c] * b.radiusB[c] / sum;
    b.effectiveMass[c] = 1.0 / (b.inverseMassA[c] + b.inverseMassB[c]);
    const double vn = dvx[c] * b.nx[c] + dvy[c] * b.ny[c] + dvz[c] * b.nz[c];
    b.vn[c] = vn;
    b.vtx[c] = dvx[c] - vn * b.nx[c];
    b.vty[c] = dvy[c] - vn * b.ny[c];
    b.vtz[c] = dvz[c] - vn * b.nz[c];
    dvx[c] = d / sum; // contact arm over radius: the arms add up to the distance, so angular momentum is kept
  }
  if (fullArm) std::fill_n(dvx, count, 1.0);
  if (turning)
    for (int c = 0; c < count; ++c) { // slip: minus (arm_a w_a + arm_b w_b) x n
      const double wx = sx[c] * dvx[c], wy = sy[c] * dvx[c], wz = sz[c] * dvx[c];
      b.vtx[c] -= wy * b.nz[c] - wz * b.ny[c];
      b.vty[c] -= wz * b.nx[c] - wx * b.nz[c];
      b.vtz[c] -= wx * b.ny[c] - wy * b.nx[c];
    }
  for (int c = 0; c < count; ++c) {
    const double* h = list.history(index[c]);
    for (int k = 0; k < laws_.historySize(); ++k)
      b.history[k][c] = h[k];
  }
}

void PairForces::flush(const GrainStore& grains, PairList& list, const std::int32_t* index, int count,
                       ContactBlock& b, std::vector<PairEvent>& events, DeepestOverlap& deepest) const {
  const double dt = b.dt;
  fill(grains, list, index, count, dt, b);
  clearForces(b, laws_.readsSpin());
  for (std::size_t l = 0; l < laws_.entries().size(); ++l) {
    const auto& entry = laws_.entries()[l];
    const bool watched = laws_.hasEvents() && entry.role == LawRole::gap;
    if (watched) std::fill_n(b.event, count, noEvent);
    entry.law->apply(b, entry.firstHistory, laws_.width());
    if (!watched) continue;
    for (int c = 0; c < count; ++c)
      if (b.event[c] != noEvent) {
        const auto [i, j] = list.pairs()[index[c]];
        events.push_back({grains.id[i], grains.id[j], list.imageKey(index[c]), index[c],
                          static_cast<std::int16_t>(l), static_cast<ContactEvent>(b.event[c])});
      }
  }
  double worst = 0.0;
  for (int c = 0; c < count; ++c)
    worst = std::max(worst, b.overlap[c] / std::min(b.radiusA[c], b.radiusB[c]));
  if (worst >= deepest.share && worst > 0.0)
    for (int c = 0; c < count; ++c) {
      const auto [i, j] = list.pairs()[index[c]];
      deepest.take(b.overlap[c] / std::min(b.radiusA[c], b.radiusB[c]), grains.id[i], grains.id[j], -1);
    }

  const int stride = list.outputSize();
  const bool fullArm = laws_.fullRadiusArm();
  for (int c = 0; c < count; ++c) {
    const std::size_t p = index[c];
    double* h = list.history(p);
    for (int k = 0; k < laws_.historySize(); ++k)
      h[k] = b.history[k][c];
    list.live()[p] = 1;
    double* out = list.output(p);
    const double fn = b.normalForce[c];
    out[0] = fn * b.nx[c] + b.ftx[c];
    out[1] = fn * b.ny[c] + b.fty[c];
    out[2] = fn * b.nz[c] + b.ftz[c];
    if (stride < 6) continue;
    // Torque on either grain is -arm (n x f_t); divided by the own radius it is the same for both.
    const double sum = b.radiusA[c] + b.radiusB[c], arm = fullArm ? 1.0 : (sum - b.overlap[c]) / sum;
    out[3] = -arm * (b.ny[c] * b.ftz[c] - b.nz[c] * b.fty[c]);
    out[4] = -arm * (b.nz[c] * b.ftx[c] - b.nx[c] * b.ftz[c]);
    out[5] = -arm * (b.nx[c] * b.fty[c] - b.ny[c] * b.ftx[c]);
    if (stride < 9) continue;
    out[6] = b.mx[c];
    out[7] = b.my[c];
    out[8] = b.mz[c];
  }
}

template <bool periodic>
void PairForces::range(const GrainStore& grains, PairList& list, double dt, std::int64_t first,
                       std::int64_t last, std::vector<PairEvent>& events, DeepestOverlap& deepest) const {
  ContactBlock block;
  block.dt = dt;
  std::int32_t index[ContactBlock::capacity + 1];
  int count = 0;
  const PairList::Pair* pairs = list.pairs().data();
  const Quad* place = grains.place.data();
  std::uint8_t* live = list.live();
  const double reach = laws_.range();
  for (std::int64_t p = first; p < last; ++p) {
    const Quad &xi = place[pairs[p].a], &xj = place[pairs[p].b];
    double dx, dy, dz;
    if constexpr (periodic) {
      const Vec3& s = list.shift(p);
      dx = xi.x - (xj.x + s.x());
      dy = xi.y - (xj.y + s.y());
      dz = xi.z - (xj.z + s.z());
    } else {
      dx = xi.x - xj.x;
      dy = xi.y - xj.y;
      dz = xi.z - xj.z;
    }
    const double sum = xi.w + xj.w + reach;
    const bool near = dx * dx + dy * dy + dz * dz < sum * sum;
    index[count] = static_cast<std::int32_t>(p);
    count += near;
    if (!near && live[p]) { // parted: forget, after the gap laws have been told
      live[p] = 0;
      std::fill_n(list.output(p), list.outputSize(), 0.0);
      if (laws_.hasEvents()) {
        for (std::size_t l = 0; l < laws_.entries().size(); ++l)
          if (laws_.entries()[l].role == LawRole::gap)
            events.push_back({grains.id[pairs[p].a], grains.id[pairs[p].b], list.imageKey(p),
                              static_cast<std::int32_t>(p), static_cast<std::int16_t>(l), deathEvent, true});
      } else {
        std::fill_n(list.history(p), list.historySize(), 0.0);
      }
    }
    if (count == ContactBlock::capacity) {
      flush(grains, list, index, count, block, events, deepest);
      count = 0;
    }
  }
  if (count) flush(grains, list, index, count, block, events, deepest);
}

void PairForces::step(const GrainStore& grains, PairList& list, double dt, Parallel& parallel,
                      std::vector<PairEvent>& events, DeepestOverlap& deepest) const {
  std::mutex merge;
  const auto size = static_cast<std::int64_t>(list.size());
  const std::int64_t piece = std::max<std::int64_t>(1024, size / (4 * parallel.threads()));
  parallel.forRange(size, piece, [&](std::int64_t first, std::int64_t last) {
    std::vector<PairEvent> mine;
    DeepestOverlap worst;
    if (list.periodic())
      range<true>(grains, list, dt, first, last, mine, worst);
    else
      range<false>(grains, list, dt, first, last, mine, worst);
    const std::lock_guard lock(merge);
    events.insert(events.end(), mine.begin(), mine.end());
    deepest.take(worst.share, worst.idA, worst.idB, worst.wall);
  });
}

double PairForces::storedEnergy(const GrainStore& grains, PairList& list) const {
  double sum = 0.0;
  visitContacts(grains, list, [&](std::size_t, const ContactBlock& block, int c) {
    for (const auto& entry : laws_.entries())
      sum += entry.law->storedEnergy(block, c, entry.firstHistory);
  });
  return sum;
}

namespace {

template <int stride>
void gather(GrainStore& grains, const PairList& list, std::int64_t first, std::int64_t last) {
  const double* outputs = list.outputs();
  for (std::int64_t i = first; i < last; ++i) {
    double f[3] = {0, 0, 0}, t[3] = {0, 0, 0}, m[3] = {0, 0, 0};
    for (const std::int32_t* e = list.begin(i); e != list.end(i); ++e) {
      const double* out = outputs + static_cast<std::size_t>(*e >> 1) * stride;
      const double sign = *e & 1 ? -1.0 : 1.0;
      for (int k = 0; k < 3; ++k)
        f[k] += sign * out[k];
      if constexpr (stride >= 6)
        for (int k = 0; k < 3; ++k)
          t[k] += out[3 + k];
      if constexpr (stride >= 9)
        for (int k = 0; k < 3; ++k)
          m[k] += sign * out[6 + k];
    }
    Quad& force = grains.force[i];
    force.x += f[0];
    force.y += f[1];
    force.z += f[2];
    if constexpr (stride >= 6) {
      const double r = grains.place[i].w;
      Quad& torque = grains.torque[i];
      torque.x += r * t[0] + m[0];
      torque.y += r * t[1] + m[1];
      torque.z += r * t[2] + m[2];
    }
  }
}

} // namespace

void gatherPairForces(GrainStore& grains, const PairList& list, const LawStack& laws, std::int64_t first,
                      std::int64_t last) {
  switch (list.outputSize()) {
  case 3:
    return gather<3>(grains, list, first, last);
  case 6:
    return gather<6>(grains, list, first, last);
  default:
    return gather<9>(grains, list, first, last);
  }
}

} // namespace sandglass
