#include "sim/scene/scene.h"

#include "sim/base/error.h"
#include "sim/math/sector.h"
#include "sim/scene/presets.h"
#include "sim/scene/scene_checks.h"
#include "sim/scene/scene_reader.h"
#include "sim/scene/scene_writer.h"

#include <fmt/format.h>
#define XXH_INLINE_ALL // header only: no library to link
#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

namespace sandglass {

namespace {

template <class T> const T& named(const std::vector<T>& all, const std::string& name, const char* what) {
  const auto it = std::find_if(all.begin(), all.end(), [&](const T& t) { return t.name == name; });
  if (it == all.end()) throw InputError(fmt::format("the scene has no {} '{}'", what, name));
  return *it;
}

} // namespace

int WedgeSpec::sectors() const {
  return static_cast<int>(std::lround(2.0 * std::numbers::pi / angle));
}

Sector Scene::sector() const {
  return wedge ? Sector(wedge->sectors(), wedge->axis[0] - 'x') : Sector();
}

const Material& Scene::material(const std::string& name) const {
  return named(materials, name, "material");
}
const Species& Scene::speciesNamed(const std::string& name) const {
  return named(species, name, "species");
}

const ContactSpec& Scene::contact(const std::string& a, const std::string& b) const {
  for (const auto& c : contacts)
    if ((c.first == a && c.second == b) || (c.first == b && c.second == a)) return c;
  throw InputError(fmt::format("the scene has no contact between '{}' and '{}'", a, b));
}

Scene readScene(const std::string& file, const std::vector<std::string>& overrides) {
  std::ifstream in(file, std::ios::binary);
  if (!in || std::filesystem::is_directory(file))
    throw InputError(fmt::format("{}: the scene file cannot be opened; check the path", file));
  std::ostringstream text;
  text << in.rdbuf();
  const auto folder = std::filesystem::path(file).parent_path();
  return parseScene(text.str(), file, overrides, folder.empty() ? "." : folder.string());
}

Scene parseScene(const std::string& tomlText, const std::string& nameForMessages,
                 const std::vector<std::string>& overrides, const std::string& baseFolder) {
  Value root = parseDocument(tomlText, nameForMessages);
  FaultList faults(nameForMessages);
  for (const auto& assignment : overrides) {
    try {
      applyOverride(root, assignment);
    } catch (const InputError& problem) {
      faults.foreign(problem.what());
    }
  }
  applyPreset(root);
  Scene scene = readSceneDocument(root, baseFolder, faults);
  scene.file = nameForMessages;
  checkScene(scene, faults);
  faults.throwIfAny();
  return scene;
}

std::string writeScene(const Scene& scene) {
  return sceneText(scene, true);
}

std::string sceneHash(const Scene& scene) {
  const std::string text = sceneText(scene, false);
  const XXH128_hash_t hash = XXH3_128bits(text.data(), text.size());
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

} // namespace sandglass
