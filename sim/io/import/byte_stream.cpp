#include "sim/io/import/byte_stream.h"

#include "sim/base/error.h"
#include "sim/io/import/unpacking.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>

#include <fcntl.h>
#include <unistd.h>

namespace sandglass {

namespace fs = std::filesystem;

namespace {

class PlainFile final : public ByteStream {
public:
  PlainFile(const fs::path& path, const std::string& name) : name_(name) {
    descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor_ < 0)
      throw InputError(fmt::format("{}: the file cannot be opened ({}); check its name and its permissions",
                                   name_, std::strerror(errno)));
  }
  ~PlainFile() override { ::close(descriptor_); }

  std::size_t read(char* to, std::size_t most) override {
    for (;;) {
      const ssize_t got = ::read(descriptor_, to, most);
      if (got >= 0) return static_cast<std::size_t>(got);
      if (errno != EINTR)
        throw InputError(fmt::format("{}: the file cannot be read ({})", name_, std::strerror(errno)));
    }
  }
  void seek(std::uint64_t offset) override {
    if (::lseek(descriptor_, static_cast<off_t>(offset), SEEK_SET) < 0)
      throw InputError(
          fmt::format("{}: byte {}: the file has no such place ({})", name_, offset, std::strerror(errno)));
  }

private:
  std::string name_;
  int descriptor_ = -1;
};

class Memory final : public ByteStream {
public:
  explicit Memory(std::shared_ptr<const std::string> bytes) : bytes_(std::move(bytes)) {}
  std::size_t read(char* to, std::size_t most) override {
    const std::size_t got = std::min(most, bytes_->size() - at_);
    std::memcpy(to, bytes_->data() + at_, got);
    at_ += got;
    return got;
  }
  void seek(std::uint64_t offset) override { at_ = std::min<std::uint64_t>(offset, bytes_->size()); }

private:
  std::shared_ptr<const std::string> bytes_;
  std::size_t at_ = 0;
};

/// Fewer where the file ends or its packing breaks off: who reads on will meet the fault with its place.
std::string firstBytes(ByteStream& stream, std::size_t most) {
  constexpr std::size_t firstRoom = std::size_t{1} << 12;
  std::string bytes;
  std::size_t have = 0;
  try {
    while (have < most) {
      if (have == bytes.size()) bytes.resize(std::min(most, std::max(firstRoom, 2 * have)));
      const std::size_t got = stream.read(bytes.data() + have, bytes.size() - have);
      if (got == 0) break;
      have += got;
    }
  } catch (const InputError&) {
    if (have == 0) throw;
  }
  bytes.resize(have);
  return bytes;
}

} // namespace

ImportFile::ImportFile(fs::path path)
    : name_(path.string()), path_(std::move(path)),
      unpackedLimit_(std::numeric_limits<std::uint64_t>::max()) {
  if (!fs::is_regular_file(path_))
    throw InputError(fmt::format("{}: there is no such file; check its name", name_));
  packing_ = packingOf(*raw());
}

ImportFile::ImportFile(std::string name, std::string bytes, std::uint64_t unpackedLimit)
    : name_(std::move(name)), bytes_(std::make_shared<const std::string>(std::move(bytes))),
      unpackedLimit_(unpackedLimit) {
  packing_ = packingOf(*raw());
}

std::unique_ptr<ByteStream> ImportFile::raw() const {
  if (bytes_) return std::make_unique<Memory>(bytes_);
  return std::make_unique<PlainFile>(path_, name_);
}

ImportFile::Packing ImportFile::packingOf(ByteStream& raw) {
  const std::string magic = firstBytes(raw, 4);
  if (magic.starts_with("\x1f\x8b")) return Packing::gzip;
  if (magic == "\x28\xb5\x2f\xfd") return Packing::zstd;
  return Packing::none;
}

std::unique_ptr<ByteStream> ImportFile::open() const {
  const auto source = [this] { return raw(); };
  if (packing_ == Packing::gzip) return openGzip(source, name_, unpackedLimit_);
  if (packing_ == Packing::zstd) return openZstd(source, name_, unpackedLimit_);
  return raw();
}

std::string ImportFile::head(std::size_t most) const {
  return firstBytes(*open(), most);
}

std::optional<std::uint64_t> ImportFile::size() const {
  if (packing_ != Packing::none) return std::nullopt;
  if (bytes_) return bytes_->size();
  std::error_code fault;
  const std::uint64_t size = fs::file_size(path_, fault);
  return fault ? std::optional<std::uint64_t>{} : size;
}

} // namespace sandglass
