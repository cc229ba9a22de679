#pragma once
// One frame as a file has it, before its columns get a meaning.

#include "sim/frame/frame.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sandglass {

struct RawColumn {
  std::string name;
  std::vector<double> numbers;    ///< one a grain; of a column of words: indices into `words`
  std::vector<std::string> words; ///< each different one once; empty: the column holds numbers
};

struct RawFrame {
  std::optional<double> time; ///< in the file's unit
  std::optional<std::int64_t> step;
  std::optional<Domain> box; ///< in the file's unit
  Vec3 tilt = Vec3::Zero();  ///< xy, xz, yz of the box: its edges are (lx, 0, 0), (xy, ly, 0), (xz, yz, lz)
  std::vector<RawColumn> columns;
  std::size_t rows = 0;
  std::uint64_t firstLine = 0;      ///< of the rows, which follow each other line by line; 0: they do not
  bool orderIsIdentity = false;     ///< the k-th row is the same grain in every frame, where there are no ids
  std::vector<std::string> remarks; ///< what the reader took for granted
};

/// The most that one frame may hold: 8 GB of memory. Readers refuse more with a sentence.
inline constexpr std::uint64_t mostNumbersInFrame = 1'000'000'000;

} // namespace sandglass
