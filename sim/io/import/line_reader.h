#pragma once
// Lines of a text file in blocks of 128 kB: line ends \n or \r\n, mixed as they may be, a mark of UTF-8 at
// the start passed over. Memory: one block, and up to `longestLine` where a line is longer than that.

#include "sim/io/import/byte_stream.h"

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace sandglass {

class LineReader {
public:
  static constexpr std::size_t longestLine = std::size_t{16} << 20; ///< [bytes]

  LineReader(std::unique_ptr<ByteStream> stream, std::string name);

  /// The next line without its end; false at the end of the file. Valid until the next call. Throws
  /// InputError when a line is too long.
  bool next(std::string_view& line);
  /// The line that next() will give.
  bool peek(std::string_view& line);
  /// Passes over lines; the number of them that were there.
  std::uint64_t skip(std::uint64_t count);

  /// Number of the line that was read last, from 1.
  std::uint64_t line() const { return line_; }
  /// Where the next line begins.
  std::uint64_t offset() const { return blockAt_ + at_; }
  /// Whether the line read last had a line end.
  bool ended() const { return ended_; }
  /// To a place that offset() and line() gave.
  void seek(std::uint64_t offset, std::uint64_t line);

  /// "FILE:LINE: " of the line read last and `sentence`.
  [[noreturn]] void fail(const std::string& sentence) const;
  const std::string& name() const { return name_; }

private:
  bool find(std::size_t& end); ///< of the line at at_; reads more as needed
  bool more();
  std::unique_ptr<ByteStream> stream_;
  std::string name_;
  std::vector<char> block_;
  std::size_t at_ = 0, have_ = 0;
  std::uint64_t blockAt_ = 0, line_ = 0;
  bool ended_ = true, over_ = false;
};

/// What a reader found, short and printable: 'xs 3…', or "the end of the file" for nothing.
std::string shownText(std::string_view found);

} // namespace sandglass
