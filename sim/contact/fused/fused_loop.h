#pragma once
// The text of all fused loops. `W` is a register width: its vector `V` of `lanes` doubles, load() of that
// many pairs from grain records, store() to outputs, and its arithmetic.

#include "sim/contact/contact_geometry.h"
#include "sim/contact/fused/fused_laws.h"

namespace sandglass {

namespace {

/// What the second pass over a block takes from the first. Two passes with short chains of dependent
/// operations are a third faster than one with a long chain: a processor sees two turns of it at a time.
struct Staged {
  static constexpr int capacity = ContactBlock::capacity;
  alignas(64) double nx[capacity], ny[capacity], nz[capacity], overlap[capacity], vn[capacity];
  alignas(64) double slipX[capacity], slipY[capacity], slipZ[capacity], arm[capacity], mass[capacity];
};

template <class W, FusedLaws::Normal kind, bool turning, bool project, Dashpot dashpot>
double fusedLoop(const ParticleView& v, const FusedLaws& laws, std::int64_t first, std::int64_t last,
                 double dt, bool keepHistory) {
  using V = typename W::V;
  using A = typename W::Arithmetic;
  using Normal = FusedLaws::Normal;
  constexpr bool massive =
      kind == Normal::linearOfMass || kind == Normal::hertzTsuji || dashpot == Dashpot::rate;
  const LinearConstants<double> linear = laws.linear;
  const HertzConstants<double> hertz = laws.hertz;
  const SpringConstants<double> spring = laws.spring;
  const V zero = A::template all<V>(0.0), one = A::template all<V>(1.0);
  const V radius = A::template all<V>(v.oneRadius * v.oneRadius / (v.oneRadius + v.oneRadius));
  const bool radiusArm = laws.radiusArm;
  const int count = static_cast<int>(last - first);
  Staged b;
  V deepest = zero;
  // Roots and quotients take long: those of the next pairs are begun before these are used.
  struct Ahead {
    PairState<V> pair;
    V inverseMass, distance, inverse;
  };
  const auto begin = [&](int c) SANDGLASS_LAMBDA {
    Ahead a;
    a.pair = W::template load<turning>(v, first + c, a.inverseMass);
    a.inverse = inverseDistance<A>(a.pair.apart, a.distance);
    return a;
  };
  Ahead next = begin(0);
  for (int c = 0; c < count; c += W::lanes) {
    const Ahead now = next;
    if (c + W::lanes < count) next = begin(c + W::lanes);
    const ContactState<V> contact = contactState<A, turning>(now.pair, now.distance, now.inverse, radiusArm);
    deepest = A::larger(deepest, contact.overlap);
    W::write(b.nx + c, contact.n.x);
    W::write(b.ny + c, contact.n.y);
    W::write(b.nz + c, contact.n.z);
    W::write(b.overlap + c, contact.overlap);
    W::write(b.vn + c, contact.vn);
    if constexpr (massive) W::write(b.mass + c, A::over(one, now.inverseMass));
    if constexpr (turning) {
      if (!radiusArm) W::write(b.arm + c, contact.arm);
      W::write(b.slipX + c, contact.slip.x);
      W::write(b.slipY + c, contact.slip.y);
      W::write(b.slipZ + c, contact.slip.z);
    }
  }
  for (int c = 0; c < count; c += W::lanes) {
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
      normal = hertzForce<A, kind == Normal::hertzTsuji, kind == Normal::hertzTsuji>(hertz, overlap, vn,
                                                                                     radius, mass);
    if constexpr (!turning) {
      const Vector3<V> force = times(normal.force, n);
      W::template store<1>(v, p, force, force);
    } else {
      double* history = v.history + p / 8 * 24 + p % 8;
      Vector3<V> s{W::read(history), W::read(history + 8), W::read(history + 16)};
      const Vector3<V> slip{W::read(b.slipX + c), W::read(b.slipY + c), W::read(b.slipZ + c)};
      const Vector3<V> ft = springForce<A, project, dashpot>(spring, n, slip, overlap, normal, mass, dt, s);
      if (!keepHistory) {
        W::write(history, s.x);
        W::write(history + 8, s.y);
        W::write(history + 16, s.z);
      }
      V arm = one;
      if (!radiusArm) arm = W::read(b.arm + c);
      W::template store<2>(v, p, plus<A>(ft, normal.force, n), contactTorque<A>(n, arm, ft));
    }
  }
  alignas(64) double each[W::lanes];
  W::write(each, deepest);
  double most = 0.0;
  for (const double o : each)
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
    if (laws.normal == Normal::hertzTsuji) return fusedLoop<W, Normal::hertzTsuji, true, false, coefficient>;
  }
  return nullptr;
}

} // namespace

} // namespace sandglass
