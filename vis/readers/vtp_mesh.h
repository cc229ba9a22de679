#pragma once
// Walls of triangles from ParaView's polygon files (VTP).

#include "sim/base/mesh.h"

#include <filesystem>

namespace sandglass::vis {

/// Polygons and strips as triangles, in the file's own units. Throws InputError.
TriangleMesh readVtpMesh(const std::filesystem::path& file);

/// From then on scenes may name ".vtp" files as meshes; they are read in a child process (child_reader.h),
/// for which the program's main() calls serveAsReader() first.
void registerMeshReaders();

} // namespace sandglass::vis
