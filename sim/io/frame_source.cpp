#include "sim/base/error.h"
#include "sim/io/frame_segment.h"
#include "sim/io/import/import_settings.h"
#include "sim/io/import/reader_table.h"
#include "sim/io/import/vtkhdf.h"
#include "sim/io/run_folder.h"
#include "sim/io/segment_names.h"
#include "sim/walls/wall_registry.h"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>

namespace sandglass {

namespace fs = std::filesystem;

namespace {

/// The walls of the scene that a segment carries, made once.
std::map<std::string, std::shared_ptr<const WallShape>> wallsOf(const std::string& sceneText,
                                                                const fs::path& file) {
  std::map<std::string, std::shared_ptr<const WallShape>> walls;
  const Scene scene =
      parseScene(sceneText, file.string() + " (scene inside)", {}, file.parent_path().string());
  for (const auto& wall : scene.walls) {
    const auto& kinds = wallKinds();
    const auto kind = std::find_if(kinds.begin(), kinds.end(),
                                   [&](const WallKind& k) { return k.name == wall.shape.kind; });
    if (kind == kinds.end())
      throw InputError(fmt::format("{}: the wall '{}' is of the kind '{}', which this program does not know",
                                   file.string(), wall.name, wall.shape.kind));
    walls[wall.name] = kind->make(wall.shape.parameters);
  }
  return walls;
}

class SegmentSource final : public FrameSource {
public:
  SegmentSource(fs::path path, fs::path framesFolder)
      : path_(std::move(path)), folder_(std::move(framesFolder)) {
    if (folder_.empty())
      addSegment(path_);
    else
      SegmentSource::refresh();
  }

  std::size_t size() const override { return frames_.size(); }
  double time(std::size_t index) const override { return frames_.at(index).time; }
  std::string name() const override { return path_.string(); }

  FramePtr load(std::size_t index) const override {
    const std::lock_guard lock(mutex_); // the open segment is shared by all callers
    if (index >= frames_.size())
      throw InputError(fmt::format("{}: frame {} was asked for and there are {}; the first has number 0",
                                   path_.string(), index, frames_.size()));
    const Place& place = frames_[index];
    if (!reader_ || openSegment_ != place.segment) {
      reader_ = std::make_unique<SegmentReader>(segments_[place.segment]);
      openSegment_ = place.segment;
    }
    if (place.inSegment >= reader_->size())
      throw InputError(fmt::format("{}: the file has changed since it was opened; open the run again",
                                   segments_[place.segment].string()));
    return std::make_shared<const Frame>(reader_->load(place.inSegment, [&](const std::string& wall) {
      if (!walls_) walls_ = wallsOf(reader_->sceneText(), segments_[place.segment]);
      const auto it = walls_->find(wall);
      if (it == walls_->end())
        throw InputError(fmt::format("{}: the scene inside has no wall '{}', which the frames name",
                                     segments_[place.segment].string(), wall));
      return it->second;
    }));
  }

  std::string sceneText() const override {
    return segments_.empty() ? std::string() : SegmentReader(segments_.front()).sceneText();
  }

  bool refresh() override {
    if (folder_.empty()) return false;
    const std::lock_guard lock(mutex_);
    const auto before = frames_.size();
    const int last = segments_.empty() ? -1 : segmentNumber(segments_.back());
    for (const auto& file : segmentFiles(folder_))
      if (segmentNumber(file) > last) addSegment(file);
    return frames_.size() > before;
  }

private:
  struct Place {
    std::size_t segment, inSegment;
    double time;
  };

  void addSegment(const fs::path& file) {
    const SegmentReader reader(file);
    for (std::size_t i = 0; i < reader.size(); ++i)
      frames_.push_back({segments_.size(), i, reader.time(i)});
    segments_.push_back(file);
  }

  fs::path path_, folder_; ///< no folder: path_ is a single segment
  std::vector<fs::path> segments_;
  std::vector<Place> frames_;
  mutable std::mutex mutex_;
  mutable std::unique_ptr<SegmentReader> reader_;
  mutable std::size_t openSegment_ = 0;
  mutable std::optional<std::map<std::string, std::shared_ptr<const WallShape>>> walls_; ///< one scene a run
};

} // namespace

std::unique_ptr<FrameSource> openFrames(const fs::path& path, const ImportSettings* settings) {
  if (!fs::exists(path)) {
    auto files = filesOfPattern(path.string());
    if (files.empty()) throw InputError(fmt::format("{}: there is no such file or folder", path.string()));
    const ImportSettings chosen = settings ? *settings : settingsBeside(files.front());
    return openSequence(path.string(), std::move(files), chosen);
  }
  if (!fs::is_directory(path)) {
    if (isOwnSegment(path)) return std::make_unique<SegmentSource>(path, fs::path{});
    return openForeign(std::make_shared<const ImportFile>(path), settings ? *settings : settingsBeside(path));
  }
  const fs::path frames = path / "frames";
  if (fs::is_directory(frames)) return std::make_unique<SegmentSource>(path, frames);
  throw InputError(
      fmt::format("{}: this folder has no frames/, so it is not the folder of a run; name the run's "
                  "folder or one .vtkhdf file",
                  path.string()));
}

} // namespace sandglass
