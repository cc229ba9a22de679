// The frames of one foreign file behind the common interface.

#include "sim/base/error.h"
#include "sim/io/import/frame_builder.h"
#include "sim/io/import/import_walls.h"
#include "sim/io/import/reader_table.h"

#include <fmt/format.h>

#include <chrono>
#include <mutex>

namespace sandglass {

namespace {

constexpr std::chrono::milliseconds refreshTime{100};

class ForeignSource final : public FrameSource {
public:
  ForeignSource(std::shared_ptr<const ImportFile> file, const ImportSettings& settings,
                const SequencePlace& place)
      : file_(std::move(file)), settings_(settings), place_(place), kind_(readerFor(*file_)),
        format_(kind_.open(*file_, settings_)), walls_(settings_) {
    remarks_ = walls_.remarks();
    walk();
    if (marks_.empty()) {
      if (!fault_.empty()) throw InputError(fault_);
      throw InputError(fmt::format("{}: there are no frames in it", file_->name()));
    }
    if (!timeIsKnown(marks_[0].time, marks_[0].step, settings_))
      remarks_.push_back(fmt::format("the file says no time: its {} count as seconds; give --time-step or "
                                     "--frame-interval",
                                     marks_[0].step ? "steps" : "frames"));
  }

  std::size_t size() const override {
    const std::lock_guard lock(mutex_);
    return marks_.size();
  }
  double time(std::size_t index) const override {
    const std::lock_guard lock(mutex_);
    const FrameMark& mark = marks_.at(index);
    return importTime(mark.time, mark.step, place_.firstFrame + index, settings_);
  }
  std::string name() const override { return file_->name(); }
  std::string sceneText() const override { return walls_.sceneText(); }
  bool complete() const override {
    const std::lock_guard lock(mutex_);
    return over_;
  }

  FramePtr load(std::size_t index) const override {
    const std::lock_guard lock(mutex_);
    if (index >= marks_.size())
      throw InputError(fmt::format("{}: frame {} was asked for and there are {}; the first has number 0",
                                   file_->name(), index, marks_.size()));
    RawFrame raw = format_->read(marks_[index]);
    raw.time = marks_[index].time;
    raw.step = marks_[index].step;
    if (!raw.box && !settings_.lower && walls_.domain()) {
      raw.box = walls_.domain();
      raw.box->lower /= settings_.length;
      raw.box->upper /= settings_.length;
    }
    auto frame = std::make_shared<Frame>(
        buildFrame(raw, place_.firstFrame + index, settings_, file_->name(), remarks_));
    walls_.addTo(*frame);
    frame->provenance = {{"source", file_->name()}, {"format", kind_.name}};
    return frame;
  }

  bool refresh() override {
    const std::lock_guard lock(mutex_);
    const std::size_t before = marks_.size();
    const auto end = std::chrono::steady_clock::now() + refreshTime;
    while (!over_ && std::chrono::steady_clock::now() < end)
      walk();
    return marks_.size() > before;
  }

  std::vector<std::string> remarks() const override {
    const std::lock_guard lock(mutex_);
    std::vector<std::string> all = remarks_;
    for (auto& remark : all)
      remark = file_->name() + ": " + remark;
    if (!fault_.empty())
      all.push_back(fault_ + (marks_.size() == 1
                                  ? "; frame 0 before it is kept"
                                  : fmt::format("; frames 0 to {} before it are kept", marks_.size() - 1)));
    return all;
  }

private:
  void walk() {
    try {
      if (auto mark = format_->next()) {
        if (!mark->time && !mark->step) mark->step = place_.step;
        marks_.push_back(*mark);
        return;
      }
    } catch (const InputError& e) {
      fault_ = e.what();
    }
    over_ = true;
  }

  std::shared_ptr<const ImportFile> file_;
  ImportSettings settings_;
  SequencePlace place_;
  const ReaderKind kind_;
  std::unique_ptr<FrameFormat> format_;
  ImportWalls walls_;
  std::vector<FrameMark> marks_;
  bool over_ = false;
  std::string fault_;
  mutable std::vector<std::string> remarks_;
  mutable std::mutex mutex_;
};

} // namespace

std::unique_ptr<FrameSource> openForeign(std::shared_ptr<const ImportFile> file,
                                         const ImportSettings& settings, const SequencePlace& place) {
  return std::make_unique<ForeignSource>(std::move(file), settings, place);
}

} // namespace sandglass
