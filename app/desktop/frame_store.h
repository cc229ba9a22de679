#pragma once
// The saved frames of what is open: those on disk, and those of a run going on that are not in a closed
// segment yet and so live in memory.

#include "sim/io/import/import_settings.h"
#include "sim/io/run_folder.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace sandglass::desktop {

/// Safe from all threads.
class FrameStore final : public FrameSource {
public:
  /// Nothing on disk yet: frames will come by append().
  explicit FrameStore(std::filesystem::path path);
  /// A run folder, one segment, a file of another program or a pattern of such. Settings for foreign files
  /// are those beside them unless some are given. Throws InputError.
  static std::shared_ptr<FrameStore> open(const std::filesystem::path& path,
                                          const std::optional<ImportSettings>& settings = {});

  std::size_t size() const override;
  double time(std::size_t index) const override;
  /// The last frame when the index is past the end: a run that goes on from a checkpoint may have dropped
  /// some.
  FramePtr load(std::size_t index) const override;
  std::string name() const override { return path_.string(); }

  /// Looks for further frames of a foreign file, or for closed segments, and frees the memory of frames that
  /// are in them.
  bool refresh() override;
  bool complete() const override;
  std::vector<std::string> remarks() const override;

  /// Adds a saved frame of the run; from time to time calls refresh().
  void append(FramePtr frame);

  /// Forgets frames later than `time`: a resumed run makes them again.
  void restartFrom(double time);

  /// Index of the frame nearest in time; there must be one.
  std::size_t nearest(double time) const;

private:
  void refreshLocked();
  void listTimes();

  std::filesystem::path path_;
  mutable std::mutex mutex_; ///< held while files are read
  std::unique_ptr<FrameSource> disk_;
  std::size_t onDisk_ = 0;       ///< frames of disk_ that count
  std::vector<FramePtr> memory_; ///< follow those on disk
  std::size_t sinceRefresh_ = 0;

  mutable std::mutex timesMutex_; ///< never held for long: the window asks for size and times
  std::vector<double> times_;
};

} // namespace sandglass::desktop
