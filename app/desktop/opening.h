#pragma once
// From a path to what the window shows of it.

#include "app/desktop/frame_store.h"
#include "app/desktop/probe_series.h"
#include "app/desktop/sweep_points.h"
#include "sim/scene/scene.h"
#include "vis/view.h"

#include <QString>

#include <filesystem>
#include <memory>
#include <optional>

namespace sandglass::desktop {

/// Everything read from one path.
struct Opened {
  std::filesystem::path path;
  QString sceneText; ///< as the user wrote it; empty when there is no scene
  QString resolved;  ///< the scene with all numbers in SI units
  std::optional<Scene> scene;
  std::filesystem::path runFolder;   ///< empty for a scene that was not run
  std::shared_ptr<FrameStore> store; ///< may be empty, never null
  ProbeSeries series;
  std::optional<vis::View> view; ///< of the picture that was opened, or of view.toml beside the scene
  std::optional<double> time;    ///< [s], frame to show; absent: the last one
  std::shared_ptr<const SweepData> sweep;      ///< null unless this is a sweep
  bool canResume = false;                      ///< there is a checkpoint
  std::optional<std::filesystem::path> beside; ///< the other run of a picture of two
};

/// A scene, a run folder, a segment of frames, a file of another program or a pattern of such, a sweep, or a
/// picture or film that leads back to its run. Settings for foreign files are those beside them unless some
/// are given. Throws InputError.
Opened openAny(const std::filesystem::path& path, const std::optional<ImportSettings>& settings = {});

/// The run behind a row of a sweep: the one in the sweep's folder `runs` where it has been computed again,
/// else its scene, to be run into that folder.
Opened openSweepRun(const std::filesystem::path& sweep, int run);

bool hasCheckpoint(const std::filesystem::path& runFolder);

/// Folder for a new run of the scene in `sceneFile`: below `runsFolder`, numbered where the name is taken.
std::filesystem::path newRunFolder(const std::filesystem::path& runsFolder,
                                   const std::filesystem::path& sceneFile);

} // namespace sandglass::desktop
