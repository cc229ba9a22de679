#pragma once
// Combinations of laws that have a loop of their own, from grain records to outputs without columns in
// between. They give the same bits as the laws one after the other, and exist for the combinations that
// `bench core` shows to be worth it: grains of few materials, a linear or Hertz normal law, alone or with a
// tangential spring, and with rolling resistance on top of it.

#include "sim/contact/laws/hertz_formula.h"
#include "sim/contact/laws/linear_formula.h"
#include "sim/contact/laws/rolling_formula.h"
#include "sim/contact/laws/spring_formula.h"
#include "sim/contact/pair_kernel.h"

#include <cstdint>

namespace sandglass {

struct FusedTables;

/// What a law says to be fused; a law that says nothing is not.
struct FusedLaws {
  enum class Normal { other, linear, linearOfMass, hertz, hertzOfSize };
  enum class Tangential { other, none, spring };
  enum class Rolling { other, none, elasticPlastic, constantTorque };
  int type = 0; ///< pair of materials, row of the laws' tables
  /// hertz: with the dashpot of a given restitution, of grains of one size unless it says otherwise
  Normal normal = Normal::other;
  Tangential tangential = Tangential::other;
  Rolling rolling = Rolling::other;
  Dashpot dashpot = Dashpot::none;
  bool project = false, radiusArm = false;
  LinearConstants<double> linear;
  HertzConstants<double> hertz;
  SpringConstants<double> spring;
  RollingConstants<double> couple;
  /// Null where all grains are of one material. Else constants are looked up, by the place of each pair of
  /// grains in the tables.
  const FusedTables* tables = nullptr;
  const std::uint8_t* placeOfPair = nullptr;
};

/// The constants of all laws, for each pair of materials that grains have.
struct FusedTables {
  static constexpr int materials = 4, places = materials * materials;
  template <class Constants> static constexpr int fields = sizeof(Constants) / sizeof(double);
  alignas(64) double linear[fields<LinearConstants<double>>][places];
  alignas(64) double hertz[fields<HertzConstants<double>>][places];
  alignas(64) double spring[fields<SpringConstants<double>>][places];
  alignas(64) double couple[fields<RollingConstants<double>>][places];
  void put(int place, const FusedLaws& laws);
};

/// Evaluates pairs first .. last - 1, multiples of 8 and no more than a block: outputs, which begin at `out`,
/// and, unless `keepHistory`, histories. With rows, `sums` are added to, and `out` is room for that. Returns
/// the deepest overlap [m]. `ahead`, if not null: records that
/// rows soon to come will read for the first time; a share of them is fetched into the cache, and histories.
using FusedLoop = double (*)(const ParticleView&, const FusedLaws&, std::int64_t first, std::int64_t last,
                             double dt, bool keepHistory, double* out, SumRing sums, const char* ahead);

/// Null where the combination has no loop of this width.
FusedLoop fusedLoopAvx2(const FusedLaws& laws);
/// `fast`: roots and quotients to two units in the last place, from estimates of the processor.
FusedLoop fusedLoopAvx512(const FusedLaws& laws, bool fast);

} // namespace sandglass
