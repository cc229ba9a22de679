// Walls from STL files: any bytes.

#include "sim/base/error.h"
#include "sim/walls/stl_reader.h"

#include <cstdint>
#include <cstdlib>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sandglass;
  try {
    const TriangleMesh mesh = parseStl({reinterpret_cast<const char*>(data), size}, "input");
    for (const auto& triangle : mesh.triangles)
      for (const int corner : triangle)
        if (corner < 0 || static_cast<std::size_t>(corner) >= mesh.points.size()) std::abort();
  } catch (const InputError&) {
  }
  return 0;
}
