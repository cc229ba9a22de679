#pragma once
// A group of grains on its way through the fields of a scene: arrays of one quantity each, so that every
// field is a plain loop that the compiler turns into vector code. Element-wise IEEE operations alone, so the
// bits do not depend on the width.

#include "sim/base/vec.h"
#include "sim/contact/pair_kernel.h"

#include <cstdint>

/// Over all lanes, also those behind the last grain, whose values nobody reads: a loop of fixed length needs
/// no remainder.
#define SANDGLASS_GRAINS(i) _Pragma("GCC ivdep") for (int i = 0; i < FieldBlock::capacity; ++i)

namespace sandglass {

struct FieldBlock {
  static constexpr int capacity = GroupSums::capacity;
  using Column = double[capacity];

  std::int64_t first = 0; ///< storage index of the first grain
  int size = 0;
  double dt = 0;   ///< [s]
  double time = 0; ///< [s] of the positions; velocities are those of half a step before

  alignas(64) Column x, y, z, radius;         ///< [m]
  alignas(64) Column vx, vy, vz, inverseMass; ///< [m/s], [1/kg]
  alignas(64) Column rollX, rollY, rollZ;     ///< [m/s] radius times spin; zero where grains do not turn
  alignas(64) Column turnX, turnY, turnZ;     ///< [N] torque over radius, of contacts; spin drags add to it

  /// [m/s^2] of all that has acted so far: contacts, walls, gravity, fields before. Fields add to it.
  alignas(64) Column ax, ay, az;
  alignas(64) Column flowX, flowY, flowZ; ///< [m/s] of the fluid, of the flows that the next drag feels
  alignas(64) Column overlap;             ///< [m] sum over contacts with grains, where a field reads it
  alignas(64) Column exposure;            ///< share of a drag that the grain feels, set by a shield; else 1

  /// exp(-decay (x . axis - reference)), kept for the next field that asks for the same.
  const Column& falloff(double decay, double reference, const Vec3& axis);

private:
  double decay_ = 0, reference_ = 0;
  Vec3 axis_ = Vec3::Zero(); ///< zero: nothing is kept yet
  alignas(64) Column falloff_;
};

} // namespace sandglass
