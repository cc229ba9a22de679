#include "sim/io/segment_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace sandglass {

namespace fs = std::filesystem;

std::string segmentName(int number) {
  return fmt::format("{:05}.vtkhdf", number);
}

int segmentNumber(const fs::path& file) {
  const std::string stem = file.stem().string();
  int number = -1;
  const auto [end, fault] = std::from_chars(stem.data(), stem.data() + stem.size(), number);
  return fault == std::errc{} && file.filename() == segmentName(number) ? number : -1;
}

std::vector<fs::path> segmentFiles(const fs::path& framesFolder) {
  std::vector<fs::path> files;
  std::error_code missing;
  for (const auto& entry : fs::directory_iterator(framesFolder, missing))
    if (segmentNumber(entry.path()) >= 0) files.push_back(entry.path());
  std::sort(files.begin(), files.end(),
            [](const fs::path& a, const fs::path& b) { return segmentNumber(a) < segmentNumber(b); });
  return files;
}

void removeParts(const fs::path& folder) {
  std::vector<fs::path> parts;
  std::error_code missing;
  for (const auto& entry : fs::directory_iterator(folder, missing))
    if (entry.path().extension() == ".part") parts.push_back(entry.path());
  for (const auto& part : parts)
    fs::remove(part, missing);
}

} // namespace sandglass
