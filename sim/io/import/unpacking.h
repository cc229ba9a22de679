#pragma once
// Packed streams: gzip through zlib, zstd through its library.

#include "sim/io/import/byte_stream.h"

#include <functional>

namespace sandglass {

using OpenRaw = std::function<std::unique_ptr<ByteStream>()>;

/// Members that follow each other in one file are read as one. After `limit` unpacked bytes the stream ends.
/// Memory: some hundred kB for gzip, 128 MB at most for zstd, which refuses files with a larger window.
std::unique_ptr<ByteStream> openGzip(OpenRaw raw, const std::string& name, std::uint64_t limit);
std::unique_ptr<ByteStream> openZstd(OpenRaw raw, const std::string& name, std::uint64_t limit);

} // namespace sandglass
