#pragma once
// Files that are either whole or absent after a kill or a power cut: write under temporaryName(), then
// publish().

#include <filesystem>
#include <functional>
#include <ostream>
#include <string_view>

namespace sandglass {

/// "<file>.part", beside the file so that a rename cannot cross file systems.
std::filesystem::path temporaryName(const std::filesystem::path& file);

/// What was written to `file` is on the disk afterwards. Throws RunError.
void syncFile(const std::filesystem::path& file);

/// Syncs temporaryName(file) to disk, renames it to `file`, syncs the folder. Throws RunError.
void publish(const std::filesystem::path& file);

/// Writes `content`, or what `write` puts out, as one atomic file. Throws RunError.
void writeAtomically(const std::filesystem::path& file, std::string_view content);
void writeAtomically(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write);

} // namespace sandglass
