#include "sim/walls/mesh_file.h"

#include "sim/base/error.h"
#include "sim/walls/stl_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace sandglass {

namespace {

std::map<std::string, MeshReader>& readers() {
  static std::map<std::string, MeshReader> all{{".stl", readStl}};
  return all;
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

} // namespace

void registerMeshReader(const std::string& extension, MeshReader reader) {
  readers()[extension] = std::move(reader);
}

TriangleMesh readMeshFile(const std::filesystem::path& file) {
  const auto it = readers().find(lower(file.extension().string()));
  if (it == readers().end()) {
    std::string known;
    for (const auto& [extension, reader] : readers())
      known += (known.empty() ? "" : ", ") + extension;
    throw InputError(
        fmt::format("{}: meshes are read from {}; convert the file to one of them", file.string(), known));
  }
  return welded(it->second(file));
}

Parameters meshFromFile(const Parameters& parameters, const std::filesystem::path& baseFolder) {
  Parameters out;
  for (const auto& [name, value] : parameters.all())
    if (name != "file" && name != "scale" && name != "shift") out.set(name, value);
  if (out.has("points") || out.has("corners"))
    throw InputError("it has both 'file' and 'points' or 'corners'; give one of them");
  if (!parameters.has("scale"))
    throw InputError(
        "it lacks the key 'scale', the length of one unit of the file, such as scale = \"1 mm\"");
  TriangleMesh mesh = readMeshFile((baseFolder / parameters.text("file")).lexically_normal());
  const double scale = parameters.number("scale");
  const Vec3 shift = parameters.has("shift") ? parameters.vector("shift") : Vec3(Vec3::Zero());
  for (Vec3& p : mesh.points)
    p = scale * p + shift;
  std::vector<double> corners;
  for (const auto& t : mesh.triangles)
    corners.insert(corners.end(), t.begin(), t.end());
  out.set("points", std::move(mesh.points));
  out.set("corners", std::move(corners));
  return out;
}

} // namespace sandglass
