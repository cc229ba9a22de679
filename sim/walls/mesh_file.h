#pragma once
// Triangles of a wall from a file, by its extension. The program adds readers that need other libraries.

#include "sim/base/mesh.h"
#include "sim/scene/parameters.h"

#include <filesystem>
#include <functional>
#include <string>

namespace sandglass {

using MeshReader = std::function<TriangleMesh(const std::filesystem::path&)>;

/// From then on files with that extension (".vtp") are read so. To be called before scenes are read.
void registerMeshReader(const std::string& extension, MeshReader reader);

/// In the file's own units. Throws InputError (a sentence that begins with the file).
TriangleMesh readMeshFile(const std::filesystem::path& file);

/// Parameters of a mesh wall in which `file`, `scale` and `shift` have become `points` and `corners`; a name
/// that is not absolute is looked up in `baseFolder`. Throws InputError.
Parameters meshFromFile(const Parameters& parameters, const std::filesystem::path& baseFolder);

} // namespace sandglass
