#pragma once
// Reading files with other people's readers in a process of their own, with limits of memory and time: a file
// that makes a reader crash, swell or hang costs a sentence, not the run.

#include "sim/base/mesh.h"
#include "sim/frame/frame.h"
#include "sim/io/import/raw_frame.h"

#include <cstddef>
#include <filesystem>

namespace sandglass::vis {

struct ReaderLimits {
  std::size_t memory = std::size_t{4} << 30; ///< [bytes] of address space
  int cpuSeconds = 60, wallSeconds = 120;
  std::size_t answer = std::size_t{1} << 30; ///< [bytes] that the child may send back
};

/// What a program's main() does first: where it was started as a reader by readVtpApart(), readVtiApart()
/// or readVtkApart(), reads, answers on standard output, and returns true with its exit code.
bool serveAsReader(int argc, char** argv, int& code);

/// readVtpMesh() in a child process. `program` is one that calls serveAsReader(); empty: this one. What comes
/// back is checked. Throws InputError (a sentence that begins with the file).
TriangleMesh readVtpApart(const std::filesystem::path& file, const ReaderLimits& limits = {},
                          const std::filesystem::path& program = {});

/// readVtiField() in the same way; vectors alone come back.
FrameField readVtiApart(const std::filesystem::path& file, const ReaderLimits& limits = {},
                        const std::filesystem::path& program = {});

/// readVtkFrame() in the same way.
RawFrame readVtkApart(const std::filesystem::path& file, const ReaderLimits& limits = {},
                      const std::filesystem::path& program = {});

} // namespace sandglass::vis
