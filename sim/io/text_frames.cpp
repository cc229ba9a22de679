#include "sim/io/text_frames.h"

#include "sim/base/error.h"
#include "sim/io/atomic_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>

namespace sandglass {

void writeTextFrames(FrameSource& frames, std::size_t first, std::size_t last,
                     const std::filesystem::path& file,
                     const std::function<void(const Frame&, std::size_t i, std::string&)>& write) {
  std::ofstream out(temporaryName(file), std::ios::binary | std::ios::trunc);
  for (std::size_t i = first; i < last; ++i) {
    std::string text;
    write(*frames.load(i), i, text);
    out << text;
  }
  out.close();
  if (!out)
    throw RunError(fmt::format("{}: cannot be written ({}); check the folder and the free space",
                               file.string(), std::strerror(errno)));
  publish(file);
}

} // namespace sandglass
