#pragma once
// The bytes of a file of frames, unpacked where it is gzip or zstd (through their libraries), or of memory.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace sandglass {

/// One reading position. Every function throws InputError with file and byte when the file cannot be read or
/// its packing is damaged.
class ByteStream {
public:
  virtual ~ByteStream() = default;
  /// Up to `most` bytes; 0 at the end alone.
  virtual std::size_t read(char* to, std::size_t most) = 0;
  /// To a place counted in unpacked bytes. A packed stream gets there by unpacking what lies between, from
  /// the start when the place is behind it.
  virtual void seek(std::uint64_t offset) = 0;
};

/// A file, or bytes that stand for one, of which any number of streams can be had.
class ImportFile {
public:
  /// Throws InputError when it cannot be opened or is no regular file.
  explicit ImportFile(std::filesystem::path path);
  /// Bytes in memory. Packed ones unfold to `unpackedLimit` bytes at most, then they end.
  ImportFile(std::string name, std::string bytes, std::uint64_t unpackedLimit);

  std::unique_ptr<ByteStream> open() const;
  /// The first bytes, unpacked.
  std::string head(std::size_t most) const;
  const std::string& name() const { return name_; }
  const std::filesystem::path& path() const { return path_; }
  /// Of the unpacked file; unknown for a packed one.
  std::optional<std::uint64_t> size() const;

private:
  enum class Packing { none, gzip, zstd };
  std::unique_ptr<ByteStream> raw() const;
  static Packing packingOf(ByteStream& raw);
  std::string name_;
  std::filesystem::path path_;
  std::shared_ptr<const std::string> bytes_;
  std::uint64_t unpackedLimit_;
  Packing packing_ = Packing::none;
};

} // namespace sandglass
