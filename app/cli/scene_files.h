#pragma once
// Where a scene named on the command line lies, and what is to be changed in it.

#include <filesystem>
#include <string>
#include <vector>

namespace sandglass::cli {

struct SceneFiles {
  std::string scene;                   ///< the TOML file
  std::vector<std::string> overrides;  ///< from quick.set if asked for, then the command line's
  std::filesystem::path defaultFolder; ///< out/<name>; the folder itself when a run's folder was named
};

/// `scene`: a file, or a folder that holds scene.toml. With `quick`, the lines of quick.set beside the scene
/// (key=value, # begins a comment) come before `overrides`. Throws InputError.
SceneFiles locateScene(const std::string& scene, bool quick, const std::vector<std::string>& overrides);

} // namespace sandglass::cli
