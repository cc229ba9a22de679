#include "sim/fields/flow_file.h"

#include "sim/base/error.h"
#include "sim/scene/from_file.h"

#include <fmt/format.h>

#include <cmath>

namespace sandglass {

namespace {

ReadersByExtension<FlowReader>& readers() {
  static ReadersByExtension<FlowReader> all;
  return all;
}

FrameField readFlow(const std::filesystem::path& file) {
  if (const FlowReader* reader = readers().find(file)) return (*reader)(file);
  const std::string known = readers().known();
  throw InputError(fmt::format("{}: a wind on a grid is read from {}; convert the file", file.string(),
                               known.empty() ? "no file by this program" : known));
}

/// The array that is named, or the only one.
const std::vector<Vec3>& velocitiesOf(const FrameField& grid, const Parameters& p, const std::string& file) {
  std::string names;
  for (const auto& [name, values] : grid.vectors)
    names += (names.empty() ? "'" : ", '") + name + "'";
  if (names.empty())
    throw InputError(
        fmt::format("{}: it holds no vectors at its points, but a wind is one; give it an array of three "
                    "components at the points",
                    file));
  if (!p.has("array")) {
    if (grid.vectors.size() == 1) return grid.vectors.begin()->second;
    throw InputError(fmt::format("{}: it holds the vectors {}; say which with the key 'array'", file, names));
  }
  const auto it = grid.vectors.find(p.text("array"));
  if (it == grid.vectors.end())
    throw InputError(fmt::format("{}: it holds no vectors '{}' at its points; there are {}", file,
                                 p.text("array"), names));
  return it->second;
}

void check(const FrameField& grid, const std::vector<Vec3>& velocities, const std::string& file) {
  for (int k = 0; k < 3; ++k)
    if (grid.points[k] < 1 || (grid.points[k] > 1 && !(grid.spacing[k] > 0.0)) ||
        !std::isfinite(grid.spacing[k]) || !std::isfinite(grid.origin[k]))
      throw InputError(fmt::format("{}: along {} it has {} points with a spacing of {} from {} on, but "
                                   "numbers are due, the spacing above 0",
                                   file, "xyz"[k], grid.points[k], grid.spacing[k], grid.origin[k]));
  if (velocities.size() > largestFlowGrid)
    throw InputError(fmt::format("{}: it has {} points, and a scene takes {} at most; thin it out", file,
                                 velocities.size(), largestFlowGrid));
  for (std::size_t k = 0; k < velocities.size(); ++k)
    if (!velocities[k].allFinite()) {
      const auto nx = static_cast<std::size_t>(grid.points[0]), ny = static_cast<std::size_t>(grid.points[1]);
      throw InputError(fmt::format("{}: the velocity at the point {} {} {} of the grid is ({}, {}, {}), but "
                                   "finite numbers are due; fill such "
                                   "places",
                                   file, k % nx, k / nx % ny, k / nx / ny, velocities[k].x(),
                                   velocities[k].y(), velocities[k].z()));
    }
}

} // namespace

void registerFlowReader(const std::string& extension, FlowReader reader) {
  readers().add(extension, std::move(reader));
}

Parameters flowFromFile(const Parameters& p, const std::filesystem::path& baseFolder) {
  Parameters out;
  for (const auto& [name, value] : p.all())
    if (name != "file" && name != "array" && name != "scale" && name != "shift" && name != "velocity_scale")
      out.set(name, value);
  for (const char* key : {"points", "origin", "spacing", "velocities"})
    if (out.has(key)) throw InputError(fmt::format("it has both 'file' and '{}'; give one of them", key));
  const double scale = scaleOf(p, "1 m");
  const std::filesystem::path file = (baseFolder / p.text("file")).lexically_normal();
  const FrameField grid = readFlow(file);
  std::vector<Vec3> velocities = velocitiesOf(grid, p, file.string());
  check(grid, velocities, file.string());
  const double speed = p.number("velocity_scale", 1.0);
  for (Vec3& v : velocities)
    v *= speed;
  out.set("points", std::vector<double>(grid.points.begin(), grid.points.end()));
  out.set("origin", Vec3(scale * grid.origin + shiftOf(p)));
  Vec3 spacing = scale * grid.spacing;
  for (int k = 0; k < 3; ++k)
    if (grid.points[k] == 1) spacing[k] = 1.0; // a slice may have any
  out.set("spacing", spacing);
  out.set("velocities", std::move(velocities));
  return out;
}

} // namespace sandglass
