#pragma once
// The steps of the particle loop that handle memory: from grain records to a block of contacts, from a block
// to outputs, from outputs to sums over the contacts of grains, and on to their new records. One function
// each and for each width; all widths give the same bits. Plain data alone crosses this interface, since the
// files behind it are compiled for different processors.

#include "sim/contact/contact_block.h"
#include "sim/contact/kernel_width.h"

#include <cstdint>

namespace sandglass {

/// 1/mass [1/kg] of grains that are held fast: small beside that of any other, and far from the smallest
/// numbers of single precision. Not zero: the reduced mass of two of them must be a number.
inline constexpr double heldInverseMass = 1e-30;

/// What the loop sees of grains and pairs. Records are `quads` times four doubles: x y z radius, velocity and
/// 1/mass, radius times spin and 1/radius (GrainStore). Pairs and histories: PairList.
struct ParticleView {
  /// Pairs whose histories stand side by side: number k of pair p is history[p / lane * lane * historySize +
  /// k * lane + p % lane].
  static constexpr int lane = 16;
  double* records = nullptr;
  int quads = 2;
  const std::int32_t* pairs = nullptr; ///< a and b in turns
  const std::uint8_t* shiftOf = nullptr;
  const double* shifts = nullptr; ///< four doubles a code; null without periodic directions
  std::uint8_t noShift = 0;       ///< the code of the box itself
  const std::uint8_t* material = nullptr;
  int materials = 1;
  bool oneMaterial = true;   ///< all grains are of one
  int oneType = 0;           ///< its pair with itself
  double* history = nullptr; ///< floats in mixed precision
  int historySize = 0;
  std::uint8_t* quiet = nullptr; ///< of pairs evaluated together, p / lanes: 1 if their histories are zeros
  int outputQuads = 1;           ///< force; with friction also torque over radius; with rolling also a couple
  int outputStride = 4; ///< doubles a pair: four a quad, or two where quads are of floats (mixed precision)
  bool readsSpin = false, radiusArm = false;
  bool ownTorque = false; ///< a law's couple over the radius is the torque on either grain; spins are added
  bool sumsOverlaps = false; ///< last number of the torque's quad: the overlap [m], 0 for a gap
  unsigned reads = 0;        ///< LawColumns
  double oneRadius = 0, oneInverseMass = 0; ///< of all grains; 0 where they differ
  // Mixed precision alone (mixed_records.h).
  std::int32_t* mixed = nullptr;             ///< `quads` times four numbers a grain
  const std::int32_t* mixedShifts = nullptr; ///< four numbers a code
  double unit = 0, perUnit = 0;              ///< length of a fixed-point unit [m] and its inverse
};

/// What a pair does to one of its grains: pair << 1, and 1 where the grain is the pair's b.
struct PairSide {
  std::int32_t grain, entry;
};

/// Working columns of a block that no law sees.
template <class Real> struct PairColumnsOf {
  alignas(64) Real sum[64], arm[64]; ///< sum of radii; contact arm over radius, the same for both grains
  alignas(64) Real inverseMass[64], rollX[64], rollY[64], rollZ[64];
  alignas(64) Real inverseRadii[64]; ///< sum of 1/radius, where records have it
};
using PairColumns = PairColumnsOf<double>;

/// Sums over the contacts of grains, a row for each: force, torque over radius, couple, four doubles each, as
/// many as a pair has outputs (ParticleView::outputQuads).
struct SumRing {
  double* rows = nullptr;
  std::int64_t mask = 0; ///< grain i has row i & mask
  double* row(std::int64_t grain, int quads) const { return rows + (grain & mask) * (4 * quads); }
};

/// The rows of a group of grains.
struct GroupSums {
  static constexpr int capacity = 32;
  double* rows = nullptr;
  int stride = 4;
  double* at(std::int64_t k) const { return rows + k * stride; }
};

/// Greatest components met, for lists and for the watch on speeds.
struct Speeds {
  double x = 0, y = 0, z = 0;
  bool bad = false; ///< a component was not below the limit (catches NaN)
};

struct Kernel {
  /// Fills geometry, motion and history of `count` pairs from `first`; both are multiples of `lane`. Forces:
  /// zero.
  void (*fill)(const ParticleView&, std::int64_t first, int count, ContactBlock&, PairColumns&);
  /// Writes histories (unless `keepHistory`) and outputs, which begin at `out`.
  void (*write)(const ParticleView&, std::int64_t first, const ContactBlock&, const PairColumns&,
                bool keepHistory, double* out);
  /// Adds the outputs of `count` pairs from `first`, which begin at `out`, to the sums of their grains.
  void (*add)(const ParticleView&, std::int64_t first, int count, const double* out, SumRing);
  /// Adds, for `count` sides of pairs, what their pairs have among all outputs, to the sums of their grains.
  void (*addSides)(const ParticleView&, const PairSide*, std::int64_t count, const double* outputs, SumRing);
  /// Kick and drift of a group: v += dt (f/m + g), x += dt v; `roll` by 5/2 dt/m (t + couple/radius). Grains
  /// that are held fast go on as they are. Leaves zeros in the sums. Mixed precision: makes the mixed records
  /// anew, too.
  void (*move)(const ParticleView&, std::int64_t first, int count, GroupSums, double dt,
               const double* gravity, double speedLimit, Speeds&);
  /// Makes the mixed records of `count` grains from `first`; null in double precision.
  void (*narrow)(const ParticleView&, std::int64_t first, int count) = nullptr;
};

const Kernel& plainKernel();
const Kernel& avx2Kernel();
const Kernel& avx512Kernel();
inline const Kernel& kernelOf(KernelWidth width) {
  return width == KernelWidth::avx512 ? avx512Kernel()
         : width == KernelWidth::avx2 ? avx2Kernel()
                                      : plainKernel();
}

} // namespace sandglass
