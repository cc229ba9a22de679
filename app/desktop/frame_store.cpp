#include "app/desktop/frame_store.h"

#include "sim/base/error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sandglass::desktop {

namespace {

constexpr std::size_t refreshEvery = 20; ///< frames; a look at a folder costs little, but not nothing

} // namespace

FrameStore::FrameStore(std::filesystem::path path) : path_(std::move(path)) {}

std::shared_ptr<FrameStore> FrameStore::open(const std::filesystem::path& path,
                                             const std::optional<ImportSettings>& settings) {
  auto store = std::make_shared<FrameStore>(path);
  store->disk_ = openFrames(path, settings ? &*settings : nullptr);
  if (!store->disk_->complete()) store->disk_->refresh(); // short files are known at once
  store->onDisk_ = store->disk_->size();
  store->listTimes();
  return store;
}

void FrameStore::listTimes() {
  std::vector<double> times;
  for (std::size_t k = 0; k < onDisk_; ++k)
    times.push_back(disk_->time(k));
  for (const auto& frame : memory_)
    times.push_back(frame->time);
  const std::lock_guard lock(timesMutex_);
  times_ = std::move(times);
}

std::size_t FrameStore::size() const {
  const std::lock_guard lock(timesMutex_);
  return times_.size();
}

double FrameStore::time(std::size_t index) const {
  const std::lock_guard lock(timesMutex_);
  return times_.empty() ? 0 : times_[std::min(index, times_.size() - 1)];
}

FramePtr FrameStore::load(std::size_t index) const {
  const std::lock_guard lock(mutex_);
  const std::size_t count = onDisk_ + memory_.size();
  if (count == 0) throw InputError(path_.string() + ": there is no saved frame yet");
  index = std::min(index, count - 1);
  return index < onDisk_ ? disk_->load(index) : memory_[index - onDisk_];
}

bool FrameStore::refresh() {
  const std::lock_guard lock(mutex_);
  const std::size_t before = onDisk_;
  refreshLocked();
  return onDisk_ > before;
}

void FrameStore::refreshLocked() {
  sinceRefresh_ = 0;
  if (disk_ && !disk_->complete()) { // a long file: its index grows
    disk_->refresh();
    onDisk_ = disk_->size();
    return listTimes();
  }
  const bool isFolder = std::filesystem::is_directory(path_ / "frames");
  if (!isFolder) return;
  auto disk = openFrames(path_);
  // What is on disk up to the first frame in memory stays; then frames count that memory holds as well.
  std::size_t count = 0;
  const double firstInMemory = memory_.empty() ? std::numeric_limits<double>::infinity() : memory_[0]->time;
  while (count < disk->size() && disk->time(count) < firstInMemory)
    ++count;
  if (count < onDisk_) return;
  std::size_t moved = 0;
  while (moved < memory_.size() && count < disk->size() && disk->time(count) == memory_[moved]->time)
    ++moved, ++count;
  disk_ = std::move(disk);
  onDisk_ = count;
  memory_.erase(memory_.begin(), memory_.begin() + static_cast<std::ptrdiff_t>(moved));
  listTimes();
}

bool FrameStore::complete() const {
  const std::lock_guard lock(mutex_);
  return !disk_ || disk_->complete();
}

std::vector<std::string> FrameStore::remarks() const {
  const std::lock_guard lock(mutex_);
  return disk_ ? disk_->remarks() : std::vector<std::string>{};
}

void FrameStore::append(FramePtr frame) {
  const std::lock_guard lock(mutex_);
  memory_.push_back(std::move(frame));
  listTimes();
  if (++sinceRefresh_ < refreshEvery) return;
  try {
    refreshLocked();
  } catch (const Error&) {
    // A segment that cannot be read now stays in memory; opening the run again will tell.
  }
}

void FrameStore::restartFrom(double time) {
  const std::lock_guard lock(mutex_);
  std::erase_if(memory_, [&](const FramePtr& f) { return f->time > time; });
  if (!disk_) return listTimes();
  std::size_t count = 0;
  while (count < disk_->size() && disk_->time(count) <= time)
    ++count;
  disk_ = openFrames(path_); // segments were cut, and the old reader may hold one open
  onDisk_ = std::min(count, disk_->size());
  listTimes();
}

std::size_t FrameStore::nearest(double time) const {
  const std::size_t count = size();
  std::size_t best = 0;
  for (std::size_t k = 1; k < count; ++k)
    if (std::abs(this->time(k) - time) < std::abs(this->time(best) - time)) best = k;
  return best;
}

} // namespace sandglass::desktop
