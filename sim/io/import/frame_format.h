#pragma once
// What a format of files of frames is to the program. To add one: a file beside this with a function that
// gives its ReaderKind, and its line in reader_table.cpp.

#include "sim/io/import/byte_stream.h"
#include "sim/io/import/import_settings.h"
#include "sim/io/import/line_reader.h"
#include "sim/io/import/raw_frame.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace sandglass {

/// Where a frame begins and what its header says.
struct FrameMark {
  std::uint64_t offset = 0, line = 0; ///< of what LineReader::seek() wants, or of the format's own
  std::uint64_t index = 0;            ///< number of the frame in its file
  std::optional<double> time;         ///< in the file's unit
  std::optional<std::int64_t> step;
};

/// One open file of frames. Its functions throw InputError with file and line or byte.
class FrameFormat {
public:
  virtual ~FrameFormat() = default;
  /// From where the last call stopped (at first: the start of the file) over one frame: its mark, or nothing
  /// at the end of the file. Looks at no more than is needed to know that the frame is whole.
  virtual std::optional<FrameMark> next() = 0;
  /// Any frame that next() has passed over; called in between without harm.
  virtual RawFrame read(const FrameMark& mark) = 0;
};

struct ReaderKind {
  std::string name;     ///< "LAMMPS or LIGGGHTS dump"
  std::string expected; ///< what the file must begin with, for messages: "ITEM: TIMESTEP"
  /// From the first bytes of the (unpacked) file.
  bool (*recognises)(std::string_view head) = nullptr;
  std::unique_ptr<FrameFormat> (*open)(const ImportFile& file, const ImportSettings& settings) = nullptr;
};

/// A text file: two readers on it, one that walks on and one that jumps.
class TextFormat : public FrameFormat {
public:
  TextFormat(const ImportFile& file, const ImportSettings& settings);

protected:
  const ImportSettings& settings() const { return settings_; }
  /// Bytes from the line read last to the end of the file; nothing for a packed file.
  std::optional<std::uint64_t> bytesLeft(const LineReader& in) const;
  /// Columns of that name; those the settings leave out are parsed all the same.
  static void nameColumns(RawFrame& frame, const std::vector<std::string>& names);
  LineReader& walker() { return walker_; }
  LineReader& jumper(const FrameMark& mark); ///< at the frame

private:
  ImportSettings settings_;
  std::optional<std::uint64_t> size_;
  LineReader walker_, jumper_;
};

} // namespace sandglass
