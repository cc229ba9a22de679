#include "sim/io/table_export.h"

#include "sim/base/error.h"
#include "sim/io/atomic_file.h"
#include "sim/io/frame_segment.h"
#include "sim/io/text_frames.h"

#include <fmt/format.h>

namespace sandglass {

void exportCsv(FrameSource& frames, std::size_t first, std::size_t last, const std::filesystem::path& file) {
  std::vector<std::string> scalars, vectors;
  bool named = false;
  writeTextFrames(frames, first, last, file, [&](const Frame& frame, std::size_t i, std::string& text) {
    // The columns are those of the first frame that holds grains: an empty one of another program names none.
    if (!named && (frame.size() > 0 || i + 1 == last)) {
      named = true;
      for (const auto& [key, value] : frame.provenance)
        text += fmt::format("# {}: {}\n", key, value);
      text += "time,step,id,x,y,z";
      for (const auto& [name, values] : frame.scalars)
        text += "," + scalars.emplace_back(name);
      for (const auto& [name, values] : frame.vectors)
        text += fmt::format(",{0}.x,{0}.y,{0}.z", vectors.emplace_back(name));
      text += "\n";
    }
    std::vector<const std::vector<double>*> numbers;
    std::vector<const std::vector<Vec3>*> triples;
    for (const auto& name : scalars)
      numbers.push_back(&frame.scalar(name));
    for (const auto& name : vectors)
      triples.push_back(&frame.vector(name));
    for (std::size_t g = 0; g < frame.size(); ++g) {
      const Vec3& x = frame.position[g];
      text += fmt::format("{},{},{},{},{},{}", frame.time, frame.step, frame.id[g], x[0], x[1], x[2]);
      for (const auto* v : numbers)
        text += fmt::format(",{}", (*v)[g]);
      for (const auto* v : triples)
        text += fmt::format(",{},{},{}", (*v)[g][0], (*v)[g][1], (*v)[g][2]);
      text += "\n";
    }
  });
}

void exportVtkhdf(FrameSource& frames, const std::string& sceneText, bool singlePrecisionPositions,
                  const std::filesystem::path& file) {
  if (frames.size() == 0) throw InputError(fmt::format("{}: there are no frames to write", frames.name()));
  SegmentWriter writer(temporaryName(file), sceneText, *frames.load(0), singlePrecisionPositions);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const FramePtr frame = frames.load(i);
    if (!writer.accepts(*frame))
      throw InputError(
          fmt::format("{}: frame {} at {:.6g} s has other quantities, walls or provenance than the first, "
                      "and one .vtkhdf file holds one set; convert to .pvd instead",
                      frames.name(), i, frame->time));
    writer.append(*frame);
  }
  writer.close();
  publish(file);
}

} // namespace sandglass
