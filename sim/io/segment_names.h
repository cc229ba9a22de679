#pragma once
// The names in frames/: 00000.vtkhdf, 00001.vtkhdf, ...; "<name>.part" while one is being written.

#include <filesystem>
#include <string>
#include <vector>

namespace sandglass {

std::string segmentName(int number);
/// -1 when the name is not one of ours.
int segmentNumber(const std::filesystem::path& file);
/// Closed segments in ascending order; empty when the folder is not there.
std::vector<std::filesystem::path> segmentFiles(const std::filesystem::path& framesFolder);
/// Deletes what a kill left half written.
void removeParts(const std::filesystem::path& folder);

} // namespace sandglass
