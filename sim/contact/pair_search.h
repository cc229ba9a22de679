#pragma once
// All pairs within reach, found cell by cell for a block of rows. The row of a grain holds its partners that
// come later in storage, ordered by (storage index, image code).

#include "sim/contact/cell_grid.h"
#include "sim/contact/image_codes.h"
#include "sim/contact/stretch_search.h"

#include <cstdint>
#include <vector>

namespace sandglass {

/// Positions, radii and reaches (radius + allowed motion + range / 2) in storage order, as columns for vector
/// loops, in memory that somebody else lends.
struct GrainColumns {
  std::int64_t grains = 0;
  double *x = nullptr, *y = nullptr, *z = nullptr, *reach = nullptr, *radius = nullptr;

  static std::size_t numbers(std::int64_t grains) { return 5 * length(grains); } ///< doubles needed
  GrainColumns() = default;
  GrainColumns(std::int64_t count, double* memory)
      : grains(count), x(memory), y(x + length(count)), z(y + length(count)), reach(z + length(count)),
        radius(reach + length(count)) {}

private:
  static std::size_t length(std::int64_t grains) {
    return static_cast<std::size_t>(grains) + CellSearch::readAhead;
  }
};

/// What a block of rows holds, row behind row.
struct FoundRows {
  std::vector<std::int32_t> partner; ///< longer than `size`, by CellSearch::writeAhead or more
  std::vector<std::uint8_t> code;    ///< likewise; empty without periodic directions
  std::vector<std::int32_t> place;   ///< of each pair in the list, once it has one
  std::int64_t size = 0;
  std::int64_t crossing = 0; ///< of them with partners at `crossingFrom` or later
  std::size_t bytes() const {
    return (partner.capacity() + place.capacity()) * sizeof(std::int32_t) + code.capacity();
  }
};

/// The grain of each pair's row, for rows one behind the other: `length` of the grains from `first` on, as
/// many as `grains`. Room behind the last pair: CellSearch::writeAhead. Returns the number of pairs.
std::int64_t spreadRows(const std::int32_t* length, std::int64_t first, std::int64_t grains,
                        std::vector<std::int32_t>& owner);

class PairSearch {
public:
  PairSearch(const CellGrid& grid, const ImageCodes& codes, const GrainColumns& columns, KernelWidth width);

  /// Rows of the grains first .. last - 1; their lengths go to `count` (one per grain).
  void rows(std::int64_t first, std::int64_t last, std::int64_t crossingFrom, std::int32_t* count,
            FoundRows& found) const;

  /// How many pairs of grains the plain search measures.
  std::int64_t distanceTests() const;

private:
  struct Column;
  struct Scratch;
  void openColumn(std::size_t home, int x, int y, Scratch& scratch) const;
  void openCells(std::size_t home, int lowest, int highest, std::int32_t firstGrain, Scratch& scratch) const;
  template <class Visit>
  void eachCells(std::int64_t together, std::int64_t first, std::int64_t last, Visit&& visit) const;

  const CellGrid& grid_;
  const ImageCodes& codes_;
  const GrainColumns& columns_;
  CellSearcher search_;
  bool imaged_;
  std::int64_t together_; ///< cells that are searched at once
  bool thin_ = false;     ///< a cell may meet the same grains in several images
};

} // namespace sandglass
