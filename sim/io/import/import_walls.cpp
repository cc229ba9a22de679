#include "sim/io/import/import_walls.h"

#include "sim/base/error.h"
#include "sim/scene/scene.h"
#include "sim/walls/mesh_file.h"
#include "sim/walls/wall_registry.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sandglass {

namespace {

FrameWall wallOf(const std::string& name, const std::string& kindName, const Parameters& parameters,
                 const std::string& file) {
  const auto& kinds = wallKinds();
  const auto kind =
      std::find_if(kinds.begin(), kinds.end(), [&](const WallKind& k) { return k.name == kindName; });
  if (kind == kinds.end()) throw InputError(fmt::format("{}: there is no kind of wall '{}'", file, kindName));
  FrameWall wall;
  wall.name = name;
  wall.shape = kind->make(parameters);
  const auto bounds = wall.shape->bounds();
  for (int k = 0; k < 3; ++k)
    if (std::isfinite(bounds.min()[k]) && std::isfinite(bounds.max()[k]))
      wall.reference[k] = 0.5 * (bounds.min()[k] + bounds.max()[k]);
  return wall;
}

} // namespace

ImportWalls::ImportWalls(const ImportSettings& settings) {
  for (const auto& file : settings.walls) {
    if (file.extension() == ".toml") {
      if (!sceneText_.empty())
        throw InputError(fmt::format("{}: a second scene of walls; one alone can hold", file.string()));
      const Scene scene = readScene(file.string());
      sceneText_ = writeScene(scene);
      domain_ = scene.domain;
      double begins = 0;
      for (const auto& stage : scene.stages) {
        for (const auto& wall : stage.removeWalls)
          removedAt_.try_emplace(wall, begins);
        if (!stage.duration) break; // when the next one begins is not known
        begins += *stage.duration;
      }
      for (const auto& wall : scene.walls)
        walls_.push_back(wallOf(wall.name, wall.shape.kind, wall.shape.parameters, file.string()));
      continue;
    }
    Parameters given;
    given.set("file", std::filesystem::absolute(file).string());
    given.set("scale", settings.wallUnit);
    Parameters parameters = meshFromFile(given, {});
    for (const auto& kind : wallKinds())
      if (kind.name == "mesh")
        for (const auto& spec : kind.parameters)
          if (spec.fallback && !parameters.has(spec.name)) parameters.set(spec.name, *spec.fallback);
    walls_.push_back(wallOf(file.stem().string(), "mesh", parameters, file.string()));
    remarks_.push_back(
        fmt::format("the triangles of {} have two sides, so they bound no space: analyses near "
                    "walls want a scene as --walls, or limits (--limit)",
                    file.filename().string()));
  }
}

void ImportWalls::addTo(Frame& frame) const {
  for (FrameWall wall : walls_) {
    const auto removed = removedAt_.find(wall.name);
    wall.active = removed == removedAt_.end() || frame.time < removed->second;
    frame.walls.push_back(std::move(wall));
  }
}

} // namespace sandglass
