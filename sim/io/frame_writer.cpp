#include "sim/base/error.h"
#include "sim/io/atomic_file.h"
#include "sim/io/frame_segment.h"
#include "sim/io/run_folder.h"
#include "sim/io/segment_names.h"

#include <fmt/format.h>

#include <chrono>

namespace sandglass {

namespace {

constexpr std::uint64_t segmentBytes = 64'000'000;
constexpr std::chrono::seconds segmentAge{30}; ///< what a kill can cost, beside the bytes

class SegmentedWriter final : public FrameWriter {
public:
  SegmentedWriter(const std::filesystem::path& runFolder, const Scene& scene)
      : folder_(runFolder / "frames"), sceneText_(writeScene(scene)),
        singlePrecision_(scene.output.singlePrecisionPositions) {
    std::error_code fault;
    std::filesystem::create_directories(folder_, fault);
    if (fault)
      throw RunError(fmt::format("{}: the folder cannot be made ({})", folder_.string(), fault.message()));
    removeParts(folder_);
    const auto segments = segmentFiles(folder_);
    next_ = segments.empty() ? 0 : segmentNumber(segments.back()) + 1;
  }

  ~SegmentedWriter() override {
    try {
      closeSegment();
    } catch (const Error&) { // the segment is lost as if killed; who must know calls closeSegment()
    }
  }

  void write(const Frame& frame) override {
    if (segment_ && !segment_->accepts(frame)) closeSegment();
    if (!segment_) {
      file_ = folder_ / segmentName(next_);
      segment_ = std::make_unique<SegmentWriter>(temporaryName(file_), sceneText_, frame, singlePrecision_);
      opened_ = std::chrono::steady_clock::now();
    }
    segment_->append(frame);
    if (segment_->bytes() >= segmentBytes) closeSegment();
    closeIfOld();
  }

  void closeIfOld() override {
    if (segment_ && std::chrono::steady_clock::now() - opened_ >= segmentAge) closeSegment();
  }

  void closeSegment() override {
    if (!segment_) return;
    const auto segment = std::move(segment_);
    segment->close();
    publish(file_);
    ++next_;
  }

private:
  std::filesystem::path folder_, file_;
  std::string sceneText_;
  bool singlePrecision_;
  int next_ = 0;
  std::unique_ptr<SegmentWriter> segment_;
  std::chrono::steady_clock::time_point opened_;
};

} // namespace

std::unique_ptr<FrameWriter> makeFrameWriter(const std::filesystem::path& runFolder, const Scene& scene) {
  return std::make_unique<SegmentedWriter>(runFolder, scene);
}

} // namespace sandglass
