#include "app/cli/scene_files.h"

#include "sim/base/error.h"

#include <fmt/format.h>

#include <fstream>

namespace sandglass::cli {

namespace fs = std::filesystem;

SceneFiles locateScene(const std::string& scene, bool quick, const std::vector<std::string>& overrides) {
  SceneFiles files;
  fs::path file(scene);
  const bool isRun =
      fs::is_directory(file) && (fs::exists(file / "checkpoints") || fs::exists(file / "frames"));
  if (isRun) files.defaultFolder = file;
  if (fs::is_directory(file)) file /= "scene.toml";
  if (!fs::exists(file)) throw InputError(fmt::format("{}: there is no such scene file", file.string()));
  files.scene = file.string();
  if (!isRun) {
    const fs::path absolute = fs::absolute(file).lexically_normal();
    const fs::path name =
        absolute.filename() == "scene.toml" ? absolute.parent_path().filename() : absolute.stem();
    files.defaultFolder = fs::path("out") / (quick ? name.string() + "_quick" : name.string());
  }
  if (quick) {
    const fs::path set = file.parent_path() / "quick.set";
    std::ifstream in(set);
    if (!in)
      throw InputError(
          fmt::format("{}: --quick takes its changes from this file, and it is not there", set.string()));
    for (std::string line; std::getline(in, line);) {
      const auto begin = line.find_first_not_of(" \t\r");
      if (begin == std::string::npos || line[begin] == '#') continue;
      files.overrides.push_back(line.substr(begin, line.find_last_not_of(" \t\r") + 1 - begin));
    }
  }
  files.overrides.insert(files.overrides.end(), overrides.begin(), overrides.end());
  return files;
}

} // namespace sandglass::cli
