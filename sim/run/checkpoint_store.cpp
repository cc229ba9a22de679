#include "sim/run/checkpoint_store.h"

#include "sim/base/error.h"
#include "sim/io/run_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace sandglass {

namespace fs = std::filesystem;

std::int64_t checkpointStep(const fs::path& file) {
  const std::string stem = file.stem().string();
  std::int64_t step = -1;
  const auto [end, fault] = std::from_chars(stem.data(), stem.data() + stem.size(), step);
  return file.extension() == ".checkpoint" && fault == std::errc{} && end == stem.data() + stem.size() ? step
                                                                                                       : -1;
}

std::vector<fs::path> checkpointFiles(const fs::path& runFolder) {
  std::vector<fs::path> files;
  std::error_code missing;
  for (const auto& entry : fs::directory_iterator(runFolder / "checkpoints", missing))
    if (checkpointStep(entry.path()) >= 0) files.push_back(entry.path());
  std::sort(files.begin(), files.end(),
            [](const fs::path& a, const fs::path& b) { return checkpointStep(a) < checkpointStep(b); });
  return files;
}

CheckpointStore::CheckpointStore(fs::path runFolder, Schedule schedule)
    : folder_(std::move(runFolder)), schedule_(schedule) {
  fs::create_directories(folder_ / "checkpoints");
}

fs::path CheckpointStore::write(std::int64_t step, const Solver::State& state) {
  const fs::path file = folder_ / "checkpoints" / fmt::format("{:012}.checkpoint", step);
  writeCheckpoint(file, state);
  thinOut();
  return file;
}

void CheckpointStore::thinOut() const {
  const auto files = checkpointFiles(folder_);
  if (files.size() <= 2) return;
  const std::int64_t newest = std::max<std::int64_t>(schedule_.index(checkpointStep(files.back())), 0);
  std::int64_t stride = 1;
  while (newest / stride > 20)
    stride *= 2;
  for (std::size_t i = 0; i + 2 < files.size(); ++i) {
    const std::int64_t step = checkpointStep(files[i]);
    const bool spaced = schedule_.isDue(step) && schedule_.index(step) % stride == 0;
    if (!spaced) fs::remove(files[i]);
  }
}

std::optional<CheckpointStore::Found> CheckpointStore::newest(const Log& log) const {
  auto files = checkpointFiles(folder_);
  for (; !files.empty(); files.pop_back()) {
    try {
      return Found{files.back(), readCheckpoint(files.back())};
    } catch (const InputError& error) {
      report(log, LogLevel::warning, error.what());
    }
  }
  return std::nullopt;
}

} // namespace sandglass
