#pragma once
// The text of all fused loops. `W` is a register width: its vector `V` of `lanes` numbers `Real`, places()
// and motions() of that many pairs from grain records, store() to outputs, and its arithmetic. `Reach` of a
// register of pairs is what tells, with their distances, how far they overlap.

#include "sim/contact/contact_geometry.h"
#include "sim/contact/fused/fused_laws.h"
#include "sim/contact/laws/narrowed.h"

namespace sandglass {

namespace {

/// What the passes over a block hand on. Three passes with short chains of dependent operations are a quarter
/// faster than one with a long chain, of which a processor sees no more than two turns at a time.
template <class Real> struct Staged {
  static constexpr int capacity = ContactBlock::capacity;
  alignas(64) Real nx[capacity], ny[capacity], nz[capacity], overlap[capacity], vn[capacity];
  alignas(64) Real slipX[capacity], slipY[capacity], slipZ[capacity], arm[capacity], mass[capacity];
};

/// Where the histories of pair p begin: three numbers, `lane` places apart.
template <class Real> SANDGLASS_LOOP Real* springOf(const ParticleView& v, std::int64_t p) {
  return reinterpret_cast<Real*>(v.history) + p / ParticleView::lane * 3 * ParticleView::lane +
         p % ParticleView::lane;
}

/// Reach of pairs in double precision.
template <class A, class V> struct SumOfRadii {
  V radii;
  SANDGLASS_LOOP V overlap(V distance) const { return radii - distance; }
  /// Whoever is nearer than this may touch once the root is rounded.
  SANDGLASS_LOOP bool mayTouch(V squared) const {
    return A::any(A::above(radii * radii * A::template all<V>(1.0 + 1e-12), squared));
  }
};

/// Pairs none of which touches: no force, no history. Zeros are written once, to spare the memory.
template <class W, bool turning>
void rest(const ParticleView& v, std::int64_t p, bool keepHistory, double* out) {
  const auto zero = W::Arithmetic::template all<typename W::V>(0.0);
  if (turning && !keepHistory && !v.quiet[p / W::lanes]) {
    for (int k = 0; k < 3; ++k)
      W::write(springOf<typename W::Real>(v, p) + ParticleView::lane * k, zero);
    v.quiet[p / W::lanes] = 1;
  }
  W::template clear<turning ? 2 : 1>(out);
}

template <class W, FusedLaws::Normal kind, bool turning, bool project, Dashpot dashpot>
double fusedLoop(const ParticleView& v, const FusedLaws& laws, std::int64_t first, std::int64_t last,
                 double dt, bool keepHistory, double* out) {
  using V = typename W::V;
  using Real = typename W::Real;
  using A = typename W::Arithmetic;
  using Normal = FusedLaws::Normal;
  constexpr bool massive = kind == Normal::linearOfMass || kind == Normal::hertz || dashpot == Dashpot::rate;
  const auto linear = narrowed<LinearConstants<Real>, Real>(laws.linear);
  const auto hertz = narrowed<HertzConstants<Real>, Real>(laws.hertz);
  const auto spring = narrowed<SpringConstants<Real>, Real>(laws.spring);
  constexpr int outputQuads = turning ? 2 : 1, stride = W::quad * outputQuads;
  const V zero = A::template all<V>(0.0), one = A::template all<V>(1.0);
  const V radius = A::template all<V>(v.oneRadius * v.oneRadius / (v.oneRadius + v.oneRadius));
  const bool radiusArm = laws.radiusArm;
  const int count = static_cast<int>(last - first);
  Staged<Real> b;
  V deepest = zero;
  // Roots and quotients take long: those of the next pairs are begun before these are used.
  struct Ahead {
    bool near;
    Vector3<V> apart, motion, roll;
    typename W::Reach reach;
    V inverseMass, distance, inverse;
  };
  const auto begin = [&](int c, Ahead& a) SANDGLASS_LAMBDA {
    a.apart = W::template places<turning>(v, first + c, a.reach);
    a.motion = W::template motions<turning>(v, first + c, a.inverseMass, a.roll);
    const V squared = dot<A>(a.apart, a.apart);
    a.near = a.reach.mayTouch(squared);
    a.inverse = A::overRoot(one, squared, a.distance);
  };
  int active[ContactBlock::capacity / W::lanes], actives = 0;
  Ahead next;
  begin(0, next);
  for (int c = 0; c < count; c += W::lanes) {
    const Ahead now = next;
    if (c + W::lanes < count) begin(c + W::lanes, next);
    if (!now.near) {
      rest<W, turning>(v, first + c, keepHistory, out + c * stride);
      continue;
    }
    active[actives++] = c;
    const Vector3<V> n = times(now.inverse, now.apart);
    const V overlap = now.reach.overlap(now.distance);
    deepest = A::larger(deepest, overlap);
    W::write(b.nx + c, n.x);
    W::write(b.ny + c, n.y);
    W::write(b.nz + c, n.z);
    W::write(b.overlap + c, overlap);
    V arm = one;
    if (turning && !radiusArm) {
      arm = A::over(now.distance, now.reach.radii);
      W::write(b.arm + c, arm);
    }
    const ContactMotion<V> contact = contactMotion<A, turning>(n, now.motion, now.roll, arm);
    W::write(b.vn + c, contact.vn);
    if constexpr (massive) W::write(b.mass + c, A::over(one, now.inverseMass));
    if constexpr (turning) {
      W::write(b.slipX + c, contact.slip.x);
      W::write(b.slipY + c, contact.slip.y);
      W::write(b.slipZ + c, contact.slip.z);
    }
  }
  for (int k = 0; k < actives; ++k) {
    const int c = active[k];
    const std::int64_t p = first + c;
    const Vector3<V> n{W::read(b.nx + c), W::read(b.ny + c), W::read(b.nz + c)};
    const V overlap = W::read(b.overlap + c), vn = W::read(b.vn + c);
    V mass = zero;
    if constexpr (massive) mass = W::read(b.mass + c);
    NormalForce<V> normal;
    if constexpr (kind == Normal::linear)
      normal = linearForce<A>(linear, A::template all<V>(linear.gamma), overlap, vn);
    else if constexpr (kind == Normal::linearOfMass)
      normal = linearForce<A>(linear, linearDamping<A>(linear, mass), overlap, vn);
    else
      normal = hertzForce<A, true, true>(hertz, overlap, vn, radius, mass);
    if constexpr (!turning) {
      const Vector3<V> force = times(normal.force, n);
      W::template store<1>(out + stride * c, force, force);
    } else {
      Real* history = springOf<Real>(v, p);
      constexpr int lane = ParticleView::lane;
      Vector3<V> s{W::read(history), W::read(history + lane), W::read(history + 2 * lane)};
      const Vector3<V> slip{W::read(b.slipX + c), W::read(b.slipY + c), W::read(b.slipZ + c)};
      const Vector3<V> ft =
          springForce<A, project, dashpot>(spring, n, slip, overlap, normal, mass, static_cast<Real>(dt), s);
      if (!keepHistory) {
        v.quiet[p / W::lanes] = 0;
        W::write(history, s.x);
        W::write(history + lane, s.y);
        W::write(history + 2 * lane, s.z);
      }
      V arm = one;
      if (!radiusArm) arm = W::read(b.arm + c);
      W::template store<2>(out + stride * c, plus<A>(ft, normal.force, n), contactTorque<A>(n, arm, ft));
    }
  }
  alignas(64) Real each[W::lanes];
  W::write(each, deepest);
  double most = 0.0;
  for (const Real o : each)
    most = o > most ? o : most;
  return most;
}

/// The loop of a combination, or null.
template <class W> FusedLoop pickFusedLoop(const FusedLaws& laws) {
  using Normal = FusedLaws::Normal;
  using Tangential = FusedLaws::Tangential;
  constexpr Dashpot none = Dashpot::none, coefficient = Dashpot::coefficient;
  if (laws.tangential == Tangential::none) {
    if (laws.normal == Normal::linear) return fusedLoop<W, Normal::linear, false, false, none>;
    if (laws.normal == Normal::linearOfMass) return fusedLoop<W, Normal::linearOfMass, false, false, none>;
    return nullptr;
  }
  if (laws.tangential != Tangential::spring) return nullptr;
  if (laws.dashpot == none) {
    if (laws.normal == Normal::linear)
      return laws.project ? fusedLoop<W, Normal::linear, true, true, none>
                          : fusedLoop<W, Normal::linear, true, false, none>;
    if (laws.normal == Normal::linearOfMass && !laws.project)
      return fusedLoop<W, Normal::linearOfMass, true, false, none>;
  }
  if (laws.dashpot == coefficient && !laws.project) {
    if (laws.normal == Normal::linear) return fusedLoop<W, Normal::linear, true, false, coefficient>;
    if (laws.normal == Normal::linearOfMass)
      return fusedLoop<W, Normal::linearOfMass, true, false, coefficient>;
    if (laws.normal == Normal::hertz) return fusedLoop<W, Normal::hertz, true, false, coefficient>;
  }
  return nullptr;
}

/// As pickFusedLoop, and for what has none a loop that reads each pair's mass and has all dashpots: the same
/// forces, though not the bits of the laws one by one.
template <class W> FusedLoop pickGeneralLoop(const FusedLaws& laws) {
  using Normal = FusedLaws::Normal;
  using Tangential = FusedLaws::Tangential;
  if (const FusedLoop own = pickFusedLoop<W>(laws)) return own;
  if (laws.normal == Normal::other || laws.tangential == Tangential::other) return nullptr;
  const bool hertz = laws.normal == Normal::hertz;
  if (laws.tangential == Tangential::none) return fusedLoop<W, Normal::hertz, false, false, Dashpot::none>;
  if (laws.project)
    return hertz ? fusedLoop<W, Normal::hertz, true, true, Dashpot::rate>
                 : fusedLoop<W, Normal::linearOfMass, true, true, Dashpot::rate>;
  return hertz ? fusedLoop<W, Normal::hertz, true, false, Dashpot::rate>
               : fusedLoop<W, Normal::linearOfMass, true, false, Dashpot::rate>;
}

} // namespace

} // namespace sandglass
