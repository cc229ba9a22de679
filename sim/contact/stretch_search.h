#pragma once
// The innermost part of the search for pairs: the grains of one cell against stretches of storage. One
// function for each width of instructions; all find the same partners in the same order.

#include "sim/contact/kernel_width.h"
#include "sim/grains/grain_store.h"

#include <cstdint>

namespace sandglass {

/// Grains begin .. end - 1, seen in the image `code`.
struct Stretch {
  std::int32_t begin, end, code;
};

struct CellSearch {
  // Positions and reaches in storage order, with `readAhead` more numbers behind the last grain.
  const double *x, *y, *z, *reach;
  const Quad* shift; ///< of each image code
  int center;        ///< the code of no shift
  bool shifted;      ///< there are other codes among the stretches
  const Stretch* stretches;
  int stretchCount;
  std::int32_t first, last; ///< the grains of the cell

  static constexpr int readAhead = 8, writeAhead = 8;
};

/// For each grain i of the cell: writes partners j > i (and i itself in images with codes above the centre)
/// that are nearer than the sum of the reaches to `partner`, their image codes to `code` (nothing when null),
/// and their number to `count`. Up to `writeAhead` places behind the last one may be overwritten. Returns
/// how many were found.
using CellSearcher = std::int64_t (*)(const CellSearch& cell, std::int32_t* partner, std::uint8_t* code,
                                      std::int32_t* count);

std::int64_t searchCellPlain(const CellSearch& cell, std::int32_t* partner, std::uint8_t* code,
                             std::int32_t* count);
std::int64_t searchCellAvx2(const CellSearch& cell, std::int32_t* partner, std::uint8_t* code,
                            std::int32_t* count);
std::int64_t searchCellAvx512(const CellSearch& cell, std::int32_t* partner, std::uint8_t* code,
                              std::int32_t* count);

CellSearcher cellSearcher(KernelWidth width);

} // namespace sandglass
