#pragma once
// Rows of numbers and words as text.

#include "sim/io/import/line_reader.h"
#include "sim/io/import/raw_frame.h"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace sandglass {

/// The number at the start of `text`, a leading + allowed, or nothing when `text` is not one number.
std::optional<double> numberIn(std::string_view text);
/// A whole number in the range of what a double counts exactly (2^53).
std::optional<std::int64_t> wholeNumberIn(std::string_view text);

/// Cells of a line. `separator` 0: white space of any length; else that character, with quotes as in CSV.
std::vector<std::string_view> cellsOf(std::string_view line, char separator = 0);

/// Fills the columns of a frame row by row. A column whose first cell is no number becomes one of words.
class RowParser {
public:
  /// The frame's columns must have their names; `in` gives the lines and the place in messages.
  RowParser(LineReader& in, RawFrame& frame, char separator = 0);
  /// Appends the line that was read last. Throws InputError (file, line, column, what was found).
  void add(std::string_view line);
  /// Makes room for so many more rows, as far as `bytesLeft` of text can hold them.
  void expect(std::uint64_t rows, std::optional<std::uint64_t> bytesLeft);

private:
  void addCell(std::size_t column, std::string_view cell);
  [[noreturn]] void wrongCount(std::size_t found) const;
  LineReader& in_;
  RawFrame& frame_;
  char separator_;
  std::vector<std::map<std::string, double, std::less<>>> words_;
};

} // namespace sandglass
