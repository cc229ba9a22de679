#pragma once
// What a file of another program holds and how each of its columns is understood: for a user who wants to
// know before anything is computed, and for a dialog that maps columns.

#include "sim/io/import/byte_stream.h"
#include "sim/io/import/import_settings.h"
#include "sim/io/import/raw_frame.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sandglass {

struct ForeignColumn {
  std::string name;                 ///< in the file
  std::string quantity;             ///< column_names.h; "": it is left out
  double smallest = 0, largest = 0; ///< in the file's unit, over finite numbers; of a column of numbers
  std::size_t notFinite = 0;        ///< how many NaN and infinities
  std::vector<std::string> words;   ///< of a column of words: the first of them
};

struct ForeignFacts {
  std::string file;   ///< that was looked into: of a pattern the first
  std::string format; ///< name of its reader
  std::size_t frame = 0, grains = 0;
  std::optional<double> time; ///< in the file's unit
  std::optional<std::int64_t> step;
  std::optional<Domain> box; ///< in the file's unit
  bool tilted = false;
  std::vector<ForeignColumn> columns; ///< in the file's order
  std::vector<std::string> remarks;   ///< what the reader took for granted
};

/// Of the first frame with grains of a file (looking at up to 1000), or of the first file that a pattern
/// fits. Settings as for openFrames(): without any, those that lie beside the file. Throws InputError when it
/// is a run of this program or no frame is whole.
ForeignFacts foreignFacts(const std::filesystem::path& path, const ImportSettings* settings = nullptr);

/// Whether openFrames() would take the path for other programs' frames.
bool isForeign(const std::filesystem::path& path);

} // namespace sandglass
