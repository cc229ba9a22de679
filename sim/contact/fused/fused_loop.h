#pragma once
// The text of all fused loops. `W` is a register width: its vector `V` of `lanes` numbers `Real`, places()
// and motions() of that many pairs from grain records, store() to outputs (storeCouple() for those of rolling
// resistance, which comes in double precision alone), add() of two quads to sums if it `addsAtOnce`, and its
// arithmetic. `Reach` of a
// register of pairs is what tells, with their distances, how far they overlap.

#include "sim/contact/contact_geometry.h"
#include "sim/contact/fused/fused_laws.h"
#include "sim/contact/laws/narrowed.h"
#include "sim/contact/pair_sums.h"

#include <type_traits>
#include <utility>

namespace sandglass {

namespace {

struct Nothing {};

/// What the passes over a block hand on. Three passes with short chains of dependent operations are a quarter
/// faster than one with a long chain, of which a processor sees no more than two turns at a time.
template <class Real> struct Staged {
  static constexpr int capacity = ContactBlock::capacity;
  alignas(64) Real nx[capacity], ny[capacity], nz[capacity], overlap[capacity], vn[capacity];
  alignas(64) Real slipX[capacity], slipY[capacity], slipZ[capacity], arm[capacity], mass[capacity],
      radius[capacity];
};

/// The same for the couples against rolling, which have a pass of their own.
template <class Real> struct StagedRolling {
  static constexpr int capacity = ContactBlock::capacity;
  alignas(64) Real spinX[capacity], spinY[capacity], spinZ[capacity], radius[capacity], inverse[capacity];
  alignas(64) Real load[capacity], stiffness[capacity];
};

/// Of pairs: differences of velocities and spins, sums of radius times spin, of 1/mass, of 1/radius and of
/// rollingInverse(). Those that no law of a combination reads are left out.
template <class V> struct Motions {
  Vector3<V> velocity, roll, spin;
  V inverseMass, inverseRadii, rollingInverse;
};

/// From what records hold, as FourMotions and EightMotions have it.
template <class V, bool turning, bool spin, class Columns>
SANDGLASS_LOOP Motions<V> motionsFrom(const Columns& m) {
  Motions<V> out;
  out.velocity = {m.motion.x, m.motion.y, m.motion.z};
  out.inverseMass = m.motion.w;
  if constexpr (turning) {
    out.roll = {m.roll.x, m.roll.y, m.roll.z};
    out.inverseRadii = m.roll.w;
  }
  if constexpr (spin) {
    out.spin = {m.spin.x, m.spin.y, m.spin.z};
    out.rollingInverse = m.spin.w;
  }
  return out;
}

/// Numbers of history a pair: a spring, then a rolling angle.
constexpr int historySizeOf(FusedLaws::Rolling rolling) {
  return rolling == FusedLaws::Rolling::elasticPlastic ? 6 : 3;
}

/// Where the histories of pair p begin: `size` numbers, `lane` places apart.
template <int size, class Real> SANDGLASS_LOOP Real* historyOf(const ParticleView& v, std::int64_t p) {
  return reinterpret_cast<Real*>(v.history) + p / ParticleView::lane * size * ParticleView::lane +
         p % ParticleView::lane;
}

template <class W, class Real> SANDGLASS_LOOP Vector3<typename W::V> readVector(const Real* at) {
  constexpr int lane = ParticleView::lane;
  return {W::read(at), W::read(at + lane), W::read(at + 2 * lane)};
}
template <class W, class Real> SANDGLASS_LOOP void writeVector(Real* at, const Vector3<typename W::V>& s) {
  constexpr int lane = ParticleView::lane;
  W::write(at, s.x);
  W::write(at + lane, s.y);
  W::write(at + 2 * lane, s.z);
}

/// The constants of a law for a register of pairs: the same for all, or, among grains of several materials,
/// looked up.
using ConstantRows = const double (*)[FusedTables::places];
template <class W, template <class> class Constants, bool several> struct ConstantsOf {
  Constants<typename W::Real> one;
  ConstantsOf(const Constants<double>& c, ConstantRows)
      : one(narrowed<Constants<typename W::Real>, typename W::Real>(c)) {}
  SANDGLASS_LOOP const auto& at(Nothing) const { return one; }
};
template <class W, template <class> class Constants> struct ConstantsOf<W, Constants, true> {
  ConstantRows rows;
  ConstantsOf(const Constants<double>&, ConstantRows rows) : rows(rows) {}
  SANDGLASS_LOOP auto at(typename W::Places places) const {
    constexpr int count = FusedTables::fields<Constants<double>>;
    return each(places, std::make_index_sequence<count>());
  }
  template <std::size_t... k>
  SANDGLASS_LOOP auto each(typename W::Places places, std::index_sequence<k...>) const {
    return Constants<typename W::V>{W::lookUp(rows[k], places)...};
  }
};

template <class W, bool several> SANDGLASS_LOOP auto placesOfPairs(const FusedLaws& laws, std::int64_t p) {
  if constexpr (several)
    return W::placesOfPairs(laws.placeOfPair + p);
  else
    return Nothing{};
}

/// Arithmetic for constants that are registers themselves.
template <class Base> struct WithRegisters : Base {
  using V = typename Base::V;
  template <class> SANDGLASS_LOOP static V all(double a) { return Base::template all<V>(a); }
  template <class> SANDGLASS_LOOP static V all(V a) { return a; }
};

/// Reach of pairs in double precision.
template <class A, class V> struct SumOfRadii {
  V radii;
  SANDGLASS_LOOP V overlap(V distance) const { return radii - distance; }
  /// Whoever is nearer than this may touch once the root is rounded.
  SANDGLASS_LOOP bool mayTouch(V squared) const {
    return A::any(A::above(radii * radii * A::template all<V>(1.0 + 1e-12), squared));
  }
};

/// Pairs none of which touches: no history. Zeros are written once, to spare the memory.
template <class W, bool turning, int historySize>
void rest(const ParticleView& v, std::int64_t p, bool keepHistory) {
  const auto zero = W::Arithmetic::template all<typename W::V>(0.0);
  if (turning && !keepHistory && !v.quiet[p / W::lanes]) {
    for (int k = 0; k < historySize; ++k)
      W::write(historyOf<historySize, typename W::Real>(v, p) + ParticleView::lane * k, zero);
    __atomic_store_n(&v.quiet[p / W::lanes], std::uint8_t{1}, __ATOMIC_RELAXED);
  }
}

/// Asks for histories of a block further on, unless they are zeros of pairs at rest, and for the records that
/// about as many pairs will need for the first time, three a grain; returns where the next begin. A processor
/// foresees both by itself, but anew from each page on. A few lines at a time: asked for all at once, they
/// hold up whatever else is read.
template <class W, bool turning, int historySize>
SANDGLASS_LOOP const char* fetch(const ParticleView& v, std::int64_t p, const char* ahead) {
  constexpr int line = 64, record = W::quad * (turning ? 3 : 2) * static_cast<int>(sizeof(double));
  constexpr int lines = (W::lanes * record + 3 * line - 1) / (3 * line);
  if (turning && !__atomic_load_n(&v.quiet[(p + ContactBlock::capacity) / W::lanes], __ATOMIC_RELAXED))
    for (int k = 0; k < historySize; ++k)
      __builtin_prefetch(historyOf<historySize, typename W::Real>(v, p + ContactBlock::capacity) +
                             ParticleView::lane * k,
                         1, 2);
  for (int k = 0; k < lines; ++k)
    __builtin_prefetch(ahead + k * line, 1, 2);
  return ahead + lines * line;
}

template <class W, FusedLaws::Normal kind, bool turning, bool project, Dashpot dashpot,
          FusedLaws::Rolling rolling = FusedLaws::Rolling::none, bool several = false>
double fusedLoop(const ParticleView& v, const FusedLaws& laws, std::int64_t first, std::int64_t last,
                 double dt, bool keepHistory, double* out, SumRing sums, const char* ahead) {
  using V = typename W::V;
  using Real = typename W::Real;
  using A = std::conditional_t<several, WithRegisters<typename W::Arithmetic>, typename W::Arithmetic>;
  using Normal = FusedLaws::Normal;
  using Rolling = FusedLaws::Rolling;
  constexpr bool hertzian = kind == Normal::hertz || kind == Normal::hertzOfSize;
  constexpr bool massive = kind == Normal::linearOfMass || hertzian || dashpot == Dashpot::rate;
  constexpr bool rolls = rolling != Rolling::none, sized = kind == Normal::hertzOfSize || rolls;
  constexpr int historySize = historySizeOf(rolling);
  const FusedTables* t = laws.tables;
  const ConstantsOf<W, LinearConstants, several> linears(laws.linear, several ? t->linear : nullptr);
  const ConstantsOf<W, HertzConstants, several> hertzes(laws.hertz, several ? t->hertz : nullptr);
  const ConstantsOf<W, SpringConstants, several> springs(laws.spring, several ? t->spring : nullptr);
  const ConstantsOf<W, RollingConstants, several> couples(laws.couple, several ? t->couple : nullptr);
  constexpr int outputQuads = rolls ? 3 : turning ? 2 : 1, stride = W::quad * outputQuads;
  const V zero = A::template all<V>(0.0), one = A::template all<V>(1.0);
  const V oneRadius = A::template all<V>(1.0 / (1.0 / v.oneRadius + 1.0 / v.oneRadius));
  constexpr bool atOnce = W::addsAtOnce && outputQuads == 2; ///< sums are added to without outputs between
  const bool anyRadius =
      kind == Normal::hertzOfSize || ((several || laws.couple.coefficient != 0.0) && v.oneRadius == 0.0);
  const bool radiusArm = laws.radiusArm;
  const int count = static_cast<int>(last - first);
  Staged<Real> b;
  std::conditional_t<rolls, StagedRolling<Real>, Nothing> r;
  V deepest = zero;
  // Roots and quotients take long: those of the next pairs are begun before these are used.
  struct Ahead {
    bool near;
    Vector3<V> apart;
    Motions<V> motion;
    typename W::Reach reach;
    V distance, inverse;
  };
  const auto begin = [&](int c, Ahead& a) SANDGLASS_LAMBDA {
    a.apart = W::template places<turning>(v, first + c, a.reach);
    const V squared = dot<A>(a.apart, a.apart);
    a.near = a.reach.mayTouch(squared);
    if (!a.near) return; // foreseen: pairs that are near when they are listed stand together
    a.motion = W::template motions<turning, rolls>(v, first + c);
    a.inverse = A::overRoot(one, squared, a.distance);
  };
  int active[ContactBlock::capacity / W::lanes], actives = 0;
  Ahead next;
  begin(0, next);
  for (int c = 0; c < count; c += W::lanes) {
    const Ahead now = next;
    if (c + W::lanes < count) begin(c + W::lanes, next);
    if (ahead) ahead = fetch<W, turning, historySize>(v, first + c, ahead);
    if (!now.near) {
      rest<W, turning, historySize>(v, first + c, keepHistory);
      if (!sums.rows) W::template clear<outputQuads>(out + c * stride);
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
    const ContactMotion<V> contact = contactMotion<A, turning>(n, now.motion.velocity, now.motion.roll, arm);
    W::write(b.vn + c, contact.vn);
    if constexpr (massive) W::write(b.mass + c, A::over(one, now.motion.inverseMass));
    if constexpr (turning) {
      W::write(b.slipX + c, contact.slip.x);
      W::write(b.slipY + c, contact.slip.y);
      W::write(b.slipZ + c, contact.slip.z);
    }
    if constexpr (sized) {
      V radius = oneRadius;
      if (anyRadius) radius = A::over(one, now.motion.inverseRadii);
      W::write(b.radius + c, radius);
    }
    if constexpr (rolls) {
      const Vector3<V> spin = acrossNormal<A>(n, now.motion.spin);
      W::write(r.spinX + c, spin.x);
      W::write(r.spinY + c, spin.y);
      W::write(r.spinZ + c, spin.z);
      W::write(r.inverse + c, now.motion.rollingInverse);
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
    const auto places = placesOfPairs<W, several>(laws, p);
    const auto& linear = linears.at(places);
    const auto& hertz = hertzes.at(places);
    if constexpr (kind == Normal::linear)
      normal = linearForce<A>(linear, A::template all<V>(linear.gamma), overlap, vn);
    else if constexpr (kind == Normal::linearOfMass)
      normal = linearForce<A>(linear, linearDamping<A>(linear, mass), overlap, vn);
    else if constexpr (kind == Normal::hertz)
      normal = hertzForce<A, true, true>(hertz, overlap, vn, oneRadius, mass);
    else
      normal = hertzForce<A, true, true>(hertz, overlap, vn, W::read(b.radius + c), mass);
    if constexpr (rolls) {
      W::write(r.load + c, normal.load);
      if (hertzian) W::write(r.stiffness + c, normal.stiffness);
    }
    if constexpr (!turning) {
      const Vector3<V> force = times(normal.force, n);
      W::template store<1>(out + stride * c, force, force);
    } else {
      Real* history = historyOf<historySize, Real>(v, p);
      Vector3<V> s = readVector<W>(history);
      const Vector3<V> slip{W::read(b.slipX + c), W::read(b.slipY + c), W::read(b.slipZ + c)};
      const Vector3<V> ft = springForce<A, project, dashpot>(springs.at(places), n, slip, overlap, normal,
                                                             mass, static_cast<Real>(dt), s);
      if (!keepHistory) {
        __atomic_store_n(&v.quiet[p / W::lanes], std::uint8_t{0}, __ATOMIC_RELAXED);
        writeVector<W>(history, s);
      }
      V arm = one;
      if (!radiusArm) arm = W::read(b.arm + c);
      const Vector3<V> force = plus<A>(ft, normal.force, n), torque = contactTorque<A>(n, arm, ft);
      if constexpr (atOnce)
        if (sums.rows) {
          W::add(v, p, force, torque, sums);
          continue;
        }
      W::template store<outputQuads>(out + stride * c, force, torque);
    }
  }
  if constexpr (rolls)
    for (int k = 0; k < actives; ++k) {
      const int c = active[k];
      const Vector3<V> n{W::read(b.nx + c), W::read(b.ny + c), W::read(b.nz + c)};
      const RollingPair<V> pair{{W::read(r.spinX + c), W::read(r.spinY + c), W::read(r.spinZ + c)},
                                W::read(b.radius + c),
                                W::read(r.inverse + c)};
      const V overlap = W::read(b.overlap + c), load = W::read(r.load + c);
      const auto places = placesOfPairs<W, several>(laws, first + c);
      const auto& couple = couples.at(places);
      if constexpr (rolling == Rolling::elasticPlastic) {
        V stiffness = A::template all<V>(linears.at(places).k);
        if (hertzian) stiffness = W::read(r.stiffness + c);
        Real* history = historyOf<historySize, Real>(v, first + c) + 3 * ParticleView::lane;
        Vector3<V> angle = readVector<W>(history);
        W::storeCouple(out + stride * c, elasticPlasticCouple<A>(couple, n, pair, overlap, load, stiffness,
                                                                 static_cast<Real>(dt), angle));
        if (!keepHistory) writeVector<W>(history, angle);
      } else {
        W::storeCouple(out + stride * c,
                       constantCouple<A>(couple, pair, overlap, load, coupleCap(static_cast<Real>(dt))));
      }
    }
  if (!atOnce && sums.rows)
    for (int k = 0; k < actives; ++k)
      addOutputs<outputQuads>(v, first + active[k], W::lanes,
                              reinterpret_cast<const Real*>(out + stride * active[k]), sums);
  alignas(64) Real each[W::lanes];
  W::write(each, deepest);
  double most = 0.0;
  for (const Real o : each)
    most = o > most ? o : most;
  return most;
}

} // namespace

} // namespace sandglass
