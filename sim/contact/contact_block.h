#pragma once
// A block of contacts on their way through the laws: arrays of one quantity each, so that every law is a
// plain loop that the compiler turns into vector code. Grain `a` is the one with the smaller id; `b` may be a
// wall. `Real` is double, or float under mixed precision.

#include <cstdint>

namespace sandglass {

template <class Real> struct ContactBlockOf {
  static constexpr int capacity = 64;   ///< keeps the whole block in the first-level cache
  static constexpr int maxHistory = 12; ///< numbers of history over all laws of a scene
  using Column = Real[capacity];

  int size = 0;
  Real dt = 0;          ///< [s]
  bool oneType = false; ///< all contacts are of type[0]

  int type[capacity]; ///< pair of materials, index into LawContext::types
  // Geometry. The normal points from b to a.
  alignas(64) Column nx, ny, nz;
  alignas(64) Column overlap; ///< [m]; negative: a gap
  // The next six are filled when a law says that it reads them (Law::reads).
  alignas(64) Column radiusA, radiusB;           ///< [m]; radiusB is 1 for a wall
  alignas(64) Column inverseMassA, inverseMassB; ///< [1/kg]; inverseMassB is 0 for a wall
  alignas(64) Column effectiveRadius;            ///< [m], ra rb / (ra + rb); ra at a wall
  alignas(64) Column effectiveMass;              ///< [kg], reduced mass; ma at a wall
  // Motion of a relative to b at the contact point.
  alignas(64) Column vn;            ///< [m/s] along the normal; positive: parting
  alignas(64) Column vtx, vty, vtz; ///< [m/s] in the tangent plane
  alignas(64) Column wx, wy, wz;    ///< [rad/s] spin of a minus spin of b; filled when a law reads spin

  // What the laws write.
  alignas(64) Column normalForce;   ///< [N] on a along the normal, all laws together
  alignas(64) Column contactForce;  ///< [N] the part that loads the contact and so limits friction; >= 0
  alignas(64) Column stiffness;     ///< [N/m] of the normal law at this overlap
  alignas(64) Column damping;       ///< [kg/s] of the normal law at this overlap
  alignas(64) Column ftx, fty, ftz; ///< [N] tangential, on a
  alignas(64) Column mx, my, mz;    ///< [N m] couple on a; b gets the opposite
  alignas(64) Column history[maxHistory];
  std::uint8_t event[capacity]; ///< ContactEvent raised by a gap law
};

using ContactBlock = ContactBlockOf<double>;
using ContactBlockSingle = ContactBlockOf<float>;

/// Sets what the laws add to back to zero; couples only where somebody reads them.
template <class Real> inline void clearForces(ContactBlockOf<Real>& b, bool couples) {
  const auto clear = [](auto& column) {
    for (auto& value : column)
      value = 0;
  };
  clear(b.normalForce), clear(b.contactForce), clear(b.stiffness), clear(b.damping);
  clear(b.ftx), clear(b.fty), clear(b.ftz);
  if (couples) clear(b.mx), clear(b.my), clear(b.mz);
}

enum ContactEvent : std::uint8_t { noEvent = 0, birthEvent = 1, deathEvent = 2 };

} // namespace sandglass
