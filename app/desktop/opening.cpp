#include "app/desktop/opening.h"

#include "sim/base/error.h"
#include "sim/io/atomic_file.h"
#include "sim/run/checkpoint_store.h"
#include "vis/picture_record.h"

#include <fmt/format.h>

#include <fstream>
#include <sstream>

namespace sandglass::desktop {

namespace fs = std::filesystem;

namespace {

std::string textOf(const fs::path& file) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

void readSceneInto(Opened& opened, const fs::path& file) {
  opened.scene = readScene(file.string());
  opened.sceneText = QString::fromStdString(textOf(file));
  opened.resolved = QString::fromStdString(writeScene(*opened.scene));
  const fs::path view = file.parent_path() / "view.toml";
  if (fs::exists(view)) opened.view = vis::readView(view.string());
}

bool isRunFolder(const fs::path& folder) {
  return fs::is_directory(folder / "frames") || fs::is_directory(folder / "checkpoints");
}

Opened openScene(const fs::path& file) {
  Opened opened;
  opened.path = file;
  readSceneInto(opened, file);
  opened.store = std::make_shared<FrameStore>(file);
  return opened;
}

Opened openRun(const fs::path& folder) {
  Opened opened;
  opened.path = opened.runFolder = folder;
  if (fs::exists(folder / "scene.toml")) readSceneInto(opened, folder / "scene.toml");
  opened.store =
      fs::is_directory(folder / "frames") ? FrameStore::open(folder) : std::make_shared<FrameStore>(folder);
  opened.series.load(folder);
  opened.canResume = opened.scene && hasCheckpoint(folder);
  return opened;
}

/// A picture or a film of ours, which leads back to its run.
Opened openPicture(const fs::path& file) {
  const vis::PictureRecord record = vis::readRecord(file);
  Opened opened = openAny(vis::locateSource(record, file));
  opened.view = record.view;
  opened.time = record.time;
  opened.beside = vis::locateRightSource(record, file);
  return opened;
}

Opened openSweep(const fs::path& path) {
  Opened opened;
  opened.sweep = readSweepData(path);
  opened.path = opened.sweep->folder;
  opened.store = std::make_shared<FrameStore>(opened.path);
  return opened;
}

} // namespace

Opened openSweepRun(const fs::path& sweep, int run) {
  const analysis::SweepTable table(sweep);
  const analysis::SweepRow row = table.row(run);
  const fs::path folder = sweep / "runs" / fmt::format("point_{:05}_seed_{}", row.point, row.seed);
  if (isRunFolder(folder)) return openRun(folder);
  fs::create_directories(folder.parent_path());
  const fs::path file = folder.string() + ".toml";
  writeAtomically(file, writeScene(table.scene(run)));
  Opened opened = openScene(file);
  opened.runFolder = folder;
  return opened;
}

bool hasCheckpoint(const fs::path& runFolder) {
  return !checkpointFiles(runFolder).empty();
}

fs::path newRunFolder(const fs::path& runsFolder, const fs::path& sceneFile) {
  const fs::path whole = fs::absolute(sceneFile);
  const std::string stem =
      whole.filename() == "scene.toml" ? whole.parent_path().filename().string() : whole.stem().string();
  fs::path folder = runsFolder / stem;
  for (int number = 2; fs::exists(folder); ++number)
    folder = runsFolder / fmt::format("{}-{}", stem, number);
  return folder;
}

Opened openAny(const fs::path& path, const std::optional<ImportSettings>& settings) {
  if (isSweep(path)) return openSweep(path);
  if (fs::is_directory(path)) {
    if (isRunFolder(path)) return openRun(path);
    if (fs::exists(path / "scene.toml")) return openScene(path / "scene.toml");
    throw InputError(
        fmt::format("{}: this folder holds neither a run (frames/) nor a scene (scene.toml)", path.string()));
  }
  if (path.extension() == ".toml") {
    // The scene inside a run folder stands for the run.
    const fs::path folder = fs::absolute(path).parent_path();
    return path.filename() == "scene.toml" && isRunFolder(folder) ? openRun(folder) : openScene(path);
  }
  if (vis::isPicture(path)) return openPicture(path);
  Opened opened;
  opened.path = path;
  opened.store = FrameStore::open(path, settings);
  return opened;
}

} // namespace sandglass::desktop
