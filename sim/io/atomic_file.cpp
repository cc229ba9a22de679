#include "sim/io/atomic_file.h"

#include "sim/base/error.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <unistd.h>

namespace sandglass {

namespace {

void syncPath(const std::filesystem::path& path, int flags) {
  const int descriptor = ::open(path.c_str(), flags);
  const bool good = descriptor >= 0 && ::fsync(descriptor) == 0;
  const int fault = errno;
  if (descriptor >= 0) ::close(descriptor);
  // Some network file systems refuse to sync a folder; the file itself must always reach the disk.
  if (!good && !((flags & O_DIRECTORY) != 0 && fault == EINVAL))
    throw RunError(fmt::format("{}: cannot be synced to disk ({}); is the disk full or gone?", path.string(),
                               std::strerror(fault)));
}

} // namespace

std::filesystem::path temporaryName(const std::filesystem::path& file) {
  return std::filesystem::path(file).concat(".part");
}

void syncFile(const std::filesystem::path& file) {
  syncPath(file, O_RDONLY);
}

void publish(const std::filesystem::path& file) {
  const auto temporary = temporaryName(file);
  syncPath(temporary, O_RDONLY);
  std::error_code fault;
  std::filesystem::rename(temporary, file, fault);
  if (fault)
    throw RunError(fmt::format("{}: cannot be renamed into place ({})", file.string(), fault.message()));
  const auto folder = file.parent_path();
  syncPath(folder.empty() ? "." : folder, O_RDONLY | O_DIRECTORY);
}

void writeAtomically(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write) {
  {
    std::ofstream out(temporaryName(file), std::ios::binary | std::ios::trunc);
    write(out);
    out.close();
    if (!out)
      throw RunError(fmt::format("{}: cannot be written ({}); check the folder and the free space",
                                 file.string(), std::strerror(errno)));
  }
  publish(file);
}

void writeAtomically(const std::filesystem::path& file, std::string_view content) {
  writeAtomically(file, [content](std::ostream& out) {
    out.write(content.data(), static_cast<std::streamsize>(content.size()));
  });
}

} // namespace sandglass
