#pragma once
// What a picture or a film says about itself: the view that draws it again, the run and frame that it shows,
// and the run's provenance. In a PNG as text chunks, in an MP4 as a TOML document in its comment.

#include "vis/view.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace sandglass::vis {

struct PictureRecord {
  View view;
  std::filesystem::path source;      ///< run folder or frame file, as it was named when the picture was made
  std::size_t frame = 0;             ///< index; of a film its first
  double time = 0;                   ///< [s]
  std::filesystem::path rightSource; ///< of a picture of two runs side by side that on the right; else empty
  std::map<std::string, std::string> text; ///< everything else too: scene (hash), version, seed, ...
};

/// Whether the ending says that this is a picture or a film of ours: .png, .mp4.
bool isPicture(const std::filesystem::path& file);

/// Throws InputError when the file does not exist, is torn, or carries no record. Films need the program
/// ffprobe.
PictureRecord readRecord(const std::filesystem::path& file);

/// The view alone.
View viewFromPicture(const std::filesystem::path& file);

/// Where the record's source is now: as it was named, or relative to the picture's folder or one above it.
/// Throws InputError that says which file is missing and where it was looked for.
std::filesystem::path locateSource(const PictureRecord& record, const std::filesystem::path& picture);

/// The same for the run on the right; nothing when there is one run.
std::optional<std::filesystem::path> locateRightSource(const PictureRecord& record,
                                                       const std::filesystem::path& picture);

/// The record as text of a film's comment, and back.
std::string recordText(const std::map<std::string, std::string>& text);
std::map<std::string, std::string> parseRecordText(const std::string& text);

} // namespace sandglass::vis
