// Many files as one source.

#include "sim/base/error.h"
#include "sim/io/import/reader_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <mutex>

#include <glob.h>

namespace sandglass {

namespace fs = std::filesystem;

namespace {

constexpr std::chrono::milliseconds refreshTime{100};

/// dump.2 before dump.10: runs of digits compare as numbers.
bool naturallyBefore(const std::string& a, const std::string& b) {
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (!digit(a[i]) || !digit(b[j])) {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i, ++j;
      continue;
    }
    while (i < a.size() && a[i] == '0')
      ++i;
    while (j < b.size() && b[j] == '0')
      ++j;
    const std::size_t fromA = i, fromB = j;
    while (i < a.size() && digit(a[i]))
      ++i;
    while (j < b.size() && digit(b[j]))
      ++j;
    if (i - fromA != j - fromB) return i - fromA < j - fromB;
    if (const int order = a.compare(fromA, i - fromA, b, fromB, j - fromB); order != 0) return order < 0;
  }
  return a.size() - i < b.size() - j;
}

/// The last number in a name, its ending left out: 1200 of dump1200.vtk.
std::optional<std::int64_t> numberInName(const fs::path& file) {
  const std::string name = file.stem().string();
  std::size_t end = name.size();
  while (end > 0 && !std::isdigit(static_cast<unsigned char>(name[end - 1])))
    --end;
  std::size_t from = end;
  while (from > 0 && end - from < 15 && std::isdigit(static_cast<unsigned char>(name[from - 1])))
    --from;
  return from < end ? std::optional<std::int64_t>(std::stoll(name.substr(from, end - from))) : std::nullopt;
}

class SequenceSource final : public FrameSource {
public:
  SequenceSource(std::string name, std::vector<fs::path> files, const ImportSettings& settings)
      : name_(std::move(name)), files_(std::move(files)), settings_(settings) {
    while (frames_.empty() && !over())
      walk();
    if (frames_.empty())
      throw InputError(faults_.empty() ? name_ + ": there are no frames" : faults_.front());
  }

  std::size_t size() const override {
    const std::lock_guard lock(mutex_);
    return frames_.size();
  }
  double time(std::size_t index) const override {
    const std::lock_guard lock(mutex_);
    return frames_.at(index).time;
  }
  std::string name() const override { return name_; }
  std::string sceneText() const override {
    const std::lock_guard lock(mutex_);
    return source(frames_.front().file).sceneText();
  }
  bool complete() const override {
    const std::lock_guard lock(mutex_);
    return over();
  }
  FramePtr load(std::size_t index) const override {
    const std::lock_guard lock(mutex_);
    if (index >= frames_.size())
      throw InputError(fmt::format("{}: frame {} was asked for and there are {}; the first has number 0",
                                   name_, index, frames_.size()));
    const Place& place = frames_[index];
    FrameSource& file = source(place.file);
    FramePtr frame = file.load(place.inFile);
    keepRemarks(file);
    return frame;
  }
  bool refresh() override {
    const std::lock_guard lock(mutex_);
    const std::size_t before = frames_.size();
    const auto end = std::chrono::steady_clock::now() + refreshTime;
    while (!over() && std::chrono::steady_clock::now() < end)
      walk();
    return frames_.size() > before;
  }
  std::vector<std::string> remarks() const override {
    const std::lock_guard lock(mutex_);
    std::vector<std::string> all = remarks_;
    all.insert(all.end(), faults_.begin(), faults_.end());
    return all;
  }

private:
  struct Place {
    std::size_t file, inFile;
    double time;
  };
  bool over() const { return nextFile_ == files_.size(); }

  std::unique_ptr<FrameSource> open(std::size_t file, std::size_t firstFrame) const {
    auto source = openForeign(std::make_shared<const ImportFile>(files_[file]), settings_,
                              {numberInName(files_[file]), firstFrame});
    while (!source->complete())
      source->refresh();
    return source;
  }

  /// Over one more file. One that cannot be read is left out and told.
  void walk() {
    const std::size_t file = nextFile_++;
    try {
      const auto source = open(file, frames_.size());
      firstFrames_.push_back(frames_.size());
      for (std::size_t k = 0; k < source->size(); ++k)
        frames_.push_back({file, k, source->time(k)});
      keepRemarks(*source);
    } catch (const InputError& e) {
      firstFrames_.push_back(frames_.size());
      constexpr std::size_t most = 20;
      if (faults_.size() < most) faults_.emplace_back(e.what());
    }
  }

  FrameSource& source(std::size_t file) const {
    if (!open_ || openFile_ != file) {
      open_ = open(file, firstFrames_[file]);
      openFile_ = file;
    }
    return *open_;
  }

  /// Those of the first file with any; the others say the same.
  void keepRemarks(const FrameSource& file) const {
    if (remarks_.empty()) remarks_ = file.remarks();
  }

  std::string name_;
  std::vector<fs::path> files_;
  ImportSettings settings_;
  std::vector<Place> frames_;
  std::vector<std::size_t> firstFrames_;
  std::size_t nextFile_ = 0;
  std::vector<std::string> faults_;
  mutable std::vector<std::string> remarks_;
  mutable std::unique_ptr<FrameSource> open_;
  mutable std::size_t openFile_ = 0;
  mutable std::mutex mutex_;
};

} // namespace

std::unique_ptr<FrameSource> openSequence(const std::string& name, std::vector<fs::path> files,
                                          const ImportSettings& settings) {
  return std::make_unique<SequenceSource>(name, std::move(files), settings);
}

std::vector<fs::path> filesOfPattern(const std::string& name) {
  std::vector<fs::path> files;
  if (name.find_first_of("*?[") == std::string::npos || fs::exists(name)) return files;
  glob_t found{};
  if (::glob(name.c_str(), GLOB_NOSORT, nullptr, &found) == 0)
    for (std::size_t k = 0; k < found.gl_pathc; ++k)
      files.emplace_back(found.gl_pathv[k]);
  ::globfree(&found);
  std::sort(files.begin(), files.end(),
            [](const fs::path& a, const fs::path& b) { return naturallyBefore(a.string(), b.string()); });
  return files;
}

} // namespace sandglass
