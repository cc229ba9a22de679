#pragma once
// How many grains stand below each grain in the way of a wind that rises: grain j shields grain i when
//   |x_i - x_j| < r_i + r_j,  |y_i - y_j| < r_i + r_j  and  z_j < z_i,
// that is, when the square around j overlaps the prism on the square below i.
//
// Counts are exact at every step, yet few pairs are looked at: when grains are listed, columns of a grid over
// x and y give all candidates, and those whose answer cannot change before the next listing (no grain moves
// further than its `listed.w`) are counted for good. The few in doubt are asked anew each step.

#include "sim/base/parallel.h"
#include "sim/grains/grain_store.h"

#include <cstdint>
#include <vector>

namespace sandglass {

class ShieldCounts {
public:
  void list(const GrainStore& grains, Parallel& parallel);
  void count(const GrainStore& grains, Parallel& parallel);

  /// Of the grain with this storage index, as of the last count().
  std::int32_t of(std::int64_t grain) const { return counts_[grain]; }
  std::size_t doubts() const; ///< pairs that count() asks

private:
  static constexpr std::int64_t pieceSize = 128;
  /// Grains that one thread lists and counts at a time.
  struct Piece {
    std::vector<std::int32_t> firstDoubt; ///< of each grain; one more at the end
    std::vector<std::int32_t> doubts;     ///< grains that may come to shield, or stop
  };
  /// Grains sorted by column.
  struct Columns {
    double x0 = 0, y0 = 0, perCell = 0;
    int nx = 1, ny = 1;
    std::vector<std::int32_t> first, grain;
    std::vector<double> x, y, z, radius, allowed;
    int cellX(double v) const;
    int cellY(double v) const;
  };
  enum Answer : std::int64_t { apart, shields, inDoubt };
  static constexpr int batch = 64; ///< candidates judged at a time
  void judge(const Quad& p, double mine, std::int32_t from, int count, std::int64_t* answer) const;
  void sortIntoColumns(const GrainStore& grains);
  void listPiece(const GrainStore& grains, std::int64_t piece);

  Columns columns_;
  std::vector<std::int32_t> certain_, counts_; ///< per grain
  std::vector<Piece> pieces_;
};

} // namespace sandglass
