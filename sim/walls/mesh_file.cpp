#include "sim/walls/mesh_file.h"

#include "sim/base/error.h"
#include "sim/scene/from_file.h"
#include "sim/walls/stl_reader.h"

#include <fmt/format.h>

namespace sandglass {

namespace {

ReadersByExtension<MeshReader>& readers() {
  static ReadersByExtension<MeshReader> all{{".stl", readStl}};
  return all;
}

} // namespace

void registerMeshReader(const std::string& extension, MeshReader reader) {
  readers().add(extension, std::move(reader));
}

TriangleMesh readMeshFile(const std::filesystem::path& file) {
  const MeshReader* reader = readers().find(file);
  if (!reader)
    throw InputError(fmt::format("{}: meshes are read from {}; convert the file to one of them",
                                 file.string(), readers().known()));
  return welded((*reader)(file));
}

Parameters meshFromFile(const Parameters& parameters, const std::filesystem::path& baseFolder) {
  Parameters out;
  for (const auto& [name, value] : parameters.all())
    if (name != "file" && name != "scale" && name != "shift") out.set(name, value);
  if (out.has("points") || out.has("corners"))
    throw InputError("it has both 'file' and 'points' or 'corners'; give one of them");
  const double scale = scaleOf(parameters, "1 mm");
  TriangleMesh mesh = readMeshFile((baseFolder / parameters.text("file")).lexically_normal());
  const Vec3 shift = shiftOf(parameters);
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
