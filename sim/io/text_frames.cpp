#include "sim/io/text_frames.h"

#include "sim/io/atomic_file.h"

namespace sandglass {

void writeTextFrames(FrameSource& frames, std::size_t first, std::size_t last,
                     const std::filesystem::path& file,
                     const std::function<void(const Frame&, std::size_t i, std::string&)>& write) {
  writeAtomically(file, [&](std::ostream& out) {
    for (std::size_t i = first; i < last; ++i) {
      std::string text;
      write(*frames.load(i), i, text);
      out << text;
    }
  });
}

} // namespace sandglass
