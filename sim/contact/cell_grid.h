#pragma once
// Grains sorted by cell, so that the partners of a grain stand in a few contiguous stretches of storage.
//
// A cell is as wide as the largest cut-off between two grains that it may hold (chaining mesh: Hockney and
// Eastwood, Computer Simulation Using Particles, 1988, section 8-4); cells are numbered x slab by x slab, z
// fastest. Where grains differ much in size there are several levels of cells, fine ones first: a grain lives
// on the level of its size, and looks for partners there and on all coarser levels, so a large grain among
// small ones does not widen their cells (Ogarko and Luding, Comput. Phys. Commun. 183, 931, 2012).

#include "sim/base/parallel.h"
#include "sim/frame/frame.h"
#include "sim/grains/grain_store.h"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace sandglass {

class CellGrid {
public:
  /// Grains of one range of sizes and their cells: an exact fit along periodic directions, the bounds of all
  /// grains elsewhere.
  struct Level {
    std::int64_t grains = 0;
    double reach = 0.0;                                 ///< largest reach on the level [m]
    std::array<double, 3> lower{}, width{}, perWidth{}; ///< [m], [m], [1/m]
    std::array<int, 3> count{1, 1, 1};
    std::array<int, 3> look{0, 0, 0}; ///< cells to look beyond one's own for partners of the same level
    std::int32_t firstCell = 0;
  };

  /// The reach of a grain, here, is its radius + range / 2 + the largest motion that any grain is allowed
  /// (`listed.w`), so that the cells do not depend on how allowances are shared out among grains.
  ///
  /// If `allowance` is given, what it says of the fastest grain is the largest motion [m] allowed, whatever
  /// `listed.w` is; it grows with speed [m/s].
  using Allowance = std::function<double(double speed)>;

  /// Wraps the grains into the periodic box, lays the cells out and sorts: order()[k] is the grain that comes
  /// k-th. Grains of one cell keep their order, so what is sorted already stays as it is. Grains whose `drop`
  /// flag is set are left out. `scratch` is memory to work in, made larger if need be; what it held is lost.
  void sort(GrainStore& grains, const Domain& domain, double range, Parallel& parallel,
            const std::vector<std::uint8_t>& drop, AlignedVector<Quad>& scratch,
            const Allowance& allowance = {});

  const std::vector<Level>& levels() const { return levels_; } ///< fine to coarse
  const std::vector<std::int32_t>& order() const { return order_; }
  /// First grain of each cell, as a place in order(); one more at the end.
  const std::vector<std::int32_t>& start() const { return start_; }
  /// By how many boxes each grain's image counters grew, packed (ImageCodes::pack), in the order before
  /// sorting; empty without periodic directions.
  const std::vector<std::int32_t>& wrapped() const { return wrapped_; }
  /// Radius [m] and 1/mass [1/kg] of all grains; 0 where they differ.
  double oneRadius() const { return oneRadius_; }
  double oneInverseMass() const { return oneInverseMass_; }
  const std::array<bool, 3>& periodic() const { return periodic_; }
  double largestReach() const { return levels_.back().reach; }
  std::size_t bytes() const;

private:
  struct Bounds;
  struct Map;
  void lay(const Domain& domain, const Bounds& bounds);

  std::array<bool, 3> periodic_{};
  double oneRadius_ = 0.0, oneInverseMass_ = 0.0;
  std::vector<Level> levels_;
  std::vector<std::int32_t> order_, start_, wrapped_;
};

} // namespace sandglass
