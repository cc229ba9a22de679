#pragma once
// The formats of frames that can be read, told apart by what is in a file, never by its name.

#include "sim/io/import/frame_format.h"
#include "sim/io/run_folder.h"

#include <memory>
#include <vector>

namespace sandglass {

/// In the order in which they are tried.
const std::vector<ReaderKind>& readerKinds();

/// A reader from elsewhere (vis: those that need VTK), tried before the others. To be called before files are
/// opened.
void registerReader(ReaderKind kind);

/// The format of a file; throws InputError (file, byte, what was found, what is due) when there is none.
const ReaderKind& readerFor(const ImportFile& file);

/// Where a file stands among those of a sequence.
struct SequencePlace {
  std::optional<std::int64_t> step; ///< for frames that say none
  std::size_t firstFrame = 0;       ///< number of its first frame
};

/// The frames of one foreign file. Its index grows as it is asked for: at first there is the first frame
/// alone, refresh() looks on for a moment, and complete() tells when all is known. A fault in a later frame
/// ends the file there: the frames before it are kept, and remarks() says why. Memory: one frame, the blocks
/// of the reader and some 60 bytes for each frame. Throws InputError when not even the first frame is whole.
std::unique_ptr<FrameSource> openForeign(std::shared_ptr<const ImportFile> file,
                                         const ImportSettings& settings, const SequencePlace& place = {});

/// One source from many files, in the order of the numbers in their names. The step of a frame that says none
/// is the last number in its file's name. Memory as for one file.
std::unique_ptr<FrameSource> openSequence(const std::string& name, std::vector<std::filesystem::path> files,
                                          const ImportSettings& settings);

/// The files that a pattern (*, ?, [..]) fits, in that order; empty when `name` is no pattern or fits
/// nothing.
std::vector<std::filesystem::path> filesOfPattern(const std::string& name);

} // namespace sandglass
