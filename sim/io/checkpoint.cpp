#include "sim/base/error.h"
#include "sim/io/atomic_file.h"
#include "sim/io/run_folder.h"

#include <fmt/format.h>
#define XXH_INLINE_ALL // header-only: nothing to link
#include <xxhash.h>

#include <array>
#include <bit>
#include <cstring>
#include <fstream>

namespace sandglass {

// Layout, little-endian: magic, u32 version, u32 number of entries; each entry u64 length and name, u64
// length and bytes; at the end XXH128 of all that precedes it.
static_assert(std::endian::native == std::endian::little);

namespace {

constexpr std::string_view magic{"Sandglass checkpoint\n"};
constexpr std::uint32_t version = 1;

std::string digest(std::string_view content) {
  XXH128_canonical_t canonical;
  XXH128_canonicalFromHash(&canonical, XXH3_128bits(content.data(), content.size()));
  return {reinterpret_cast<const char*>(canonical.digest), sizeof canonical.digest};
}

template <class T> void put(std::string& out, T value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Takes pieces off the front; false once there is too little.
class Cursor {
public:
  explicit Cursor(std::string_view rest) : rest_(rest) {}
  template <class T> bool take(T& value) {
    std::string_view bytes;
    if (!take(sizeof value, bytes)) return false;
    std::memcpy(&value, bytes.data(), sizeof value);
    return true;
  }
  bool take(std::uint64_t count, std::string_view& bytes) {
    if (count > rest_.size()) return false;
    bytes = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return true;
  }
  bool empty() const { return rest_.empty(); }

private:
  std::string_view rest_;
};

} // namespace

void writeCheckpoint(const std::filesystem::path& file, const Solver::State& state) {
  std::string content(magic);
  put(content, version);
  put(content, static_cast<std::uint32_t>(state.size()));
  for (const auto& [name, bytes] : state) {
    put(content, static_cast<std::uint64_t>(name.size()));
    content += name;
    put(content, static_cast<std::uint64_t>(bytes.size()));
    content.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }
  content += digest(content);
  writeAtomically(file, content);
}

Solver::State readCheckpoint(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InputError(fmt::format("{}: the checkpoint cannot be opened", file.string()));
  const std::string content{std::istreambuf_iterator<char>(in), {}};
  const std::string_view whole(content);
  if (!whole.starts_with(magic))
    throw InputError(fmt::format("{}: this is not a checkpoint of Sandglass (it does not begin with '{}')",
                                 file.string(), magic.substr(0, magic.size() - 1)));
  constexpr std::size_t digestSize = 16;
  if (whole.size() < magic.size() + 8 + digestSize ||
      digest(whole.substr(0, whole.size() - digestSize)) != whole.substr(whole.size() - digestSize))
    throw InputError(fmt::format(
        "{}: the checkpoint is torn or damaged (its checksum is wrong); use an older one", file.string()));
  Cursor cursor(whole.substr(magic.size(), whole.size() - magic.size() - digestSize));
  std::uint32_t found = 0, entries = 0;
  cursor.take(found);
  if (found != version)
    throw InputError(fmt::format("{}: the checkpoint has version {} and this program reads {}", file.string(),
                                 found, version));
  cursor.take(entries);
  Solver::State state;
  for (std::uint32_t i = 0; i < entries; ++i) {
    std::uint64_t nameLength = 0, length = 0;
    std::string_view name, bytes;
    if (!cursor.take(nameLength) || !cursor.take(nameLength, name) || !cursor.take(length) ||
        !cursor.take(length, bytes))
      throw InputError(
          fmt::format("{}: the checkpoint ends inside entry {} of {}", file.string(), i + 1, entries));
    const auto* data = reinterpret_cast<const std::byte*>(bytes.data());
    state[std::string(name)].assign(data, data + bytes.size());
  }
  return state;
}

} // namespace sandglass
