#pragma once
// STL files, text or binary: the triangles of a wall as other programs write them.

#include "sim/base/mesh.h"

#include <filesystem>
#include <string_view>

namespace sandglass {

/// Triangles in the file's own units; corners with equal coordinates become one point, triangles with two
/// equal corners are left out, and normals in the file are not read: the order of the corners says which side
/// is outside. Throws InputError: file, line (text) or byte (binary), what was found, what is due.
TriangleMesh readStl(const std::filesystem::path& file);

/// The same from bytes that are in memory; `name` stands for the file in messages.
TriangleMesh parseStl(std::string_view bytes, const std::string& name);

/// Points that are equal in all coordinates become one; triangles that lose a corner by that go.
TriangleMesh welded(const TriangleMesh& mesh);

} // namespace sandglass
