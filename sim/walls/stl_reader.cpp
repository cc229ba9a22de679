#include "sim/walls/stl_reader.h"

#include "sim/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <tuple>

namespace sandglass {

namespace {

constexpr std::size_t headerBytes = 84, triangleBytes = 50;
constexpr std::size_t mostTriangles = 50'000'000; ///< more would not fit into memory beside a run

/// What a reader found, short and printable.
std::string shown(std::string_view found) {
  std::string text;
  for (const char c : found.substr(0, 24))
    text += c >= 0x20 && c < 0x7f ? c : '?';
  return found.empty() ? "the end of the file" : "'" + text + (found.size() > 24 ? "…'" : "'");
}

class TextReader {
public:
  TextReader(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  TriangleMesh read() {
    expect("solid");
    skipLine(); // its name
    TriangleMesh mesh;
    for (;;) {
      const std::string_view word = next();
      if (word == "endsolid") break;
      if (word != "facet") fail(word, "'facet' or 'endsolid'");
      expect("normal");
      for (int k = 0; k < 3; ++k)
        number();
      expect("outer");
      expect("loop");
      const int first = static_cast<int>(mesh.points.size());
      for (int corner = 0; corner < 3; ++corner) {
        expect("vertex");
        const double x = number(), y = number(), z = number();
        mesh.points.emplace_back(x, y, z);
      }
      expect("endloop");
      expect("endfacet");
      mesh.triangles.push_back({first, first + 1, first + 2});
    }
    skipLine();
    const std::string_view rest = next();
    if (!rest.empty()) fail(rest, "nothing after 'endsolid'; keep one solid in a file");
    return mesh;
  }

private:
  std::string_view next() {
    while (at_ < bytes_.size() && std::strchr(" \t\r\n", bytes_[at_]) && bytes_[at_] != '\0') {
      if (bytes_[at_] == '\n') ++line_;
      ++at_;
    }
    const std::size_t from = at_;
    while (at_ < bytes_.size() && (bytes_[at_] == '\0' || !std::strchr(" \t\r\n", bytes_[at_])))
      ++at_;
    return bytes_.substr(from, at_ - from);
  }
  void skipLine() {
    while (at_ < bytes_.size() && bytes_[at_] != '\n')
      ++at_;
  }
  void expect(const char* word) {
    const std::string_view found = next();
    if (found != word) fail(found, fmt::format("'{}'", word));
  }
  double number() {
    const std::string_view word = next();
    double value = 0;
    const char* begin = word.data() + (!word.empty() && word.front() == '+' ? 1 : 0);
    const auto [end, fault] = std::from_chars(begin, word.data() + word.size(), value);
    if (word.empty() || fault != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
      fail(word, "a finite number");
    return value;
  }
  [[noreturn]] void fail(std::string_view found, const std::string& due) const {
    throw InputError(
        fmt::format("{}:{}: found {}, but {} is due in a text STL", name_, line_, shown(found), due));
  }

  std::string_view bytes_;
  const std::string& name_;
  std::size_t at_ = 0;
  int line_ = 1;
};

std::uint32_t littleEndian(const char* bytes) {
  const auto* b = reinterpret_cast<const unsigned char*>(bytes);
  return b[0] | b[1] << 8 | b[2] << 16 | static_cast<std::uint32_t>(b[3]) << 24;
}

TriangleMesh readBinary(std::string_view bytes, const std::string& name) {
  const std::size_t count = littleEndian(bytes.data() + headerBytes - 4);
  TriangleMesh mesh;
  mesh.points.reserve(3 * count);
  mesh.triangles.reserve(count);
  for (std::size_t t = 0; t < count; ++t) {
    const std::size_t corners = headerBytes + t * triangleBytes + 12; // after the normal
    for (std::size_t k = 0; k < 9; ++k) {
      const std::uint32_t word = littleEndian(bytes.data() + corners + 4 * k);
      float value = 0;
      std::memcpy(&value, &word, sizeof value);
      if (!std::isfinite(value))
        throw InputError(
            fmt::format("{}: byte {}: found {}, but a finite number is due (corner {} of triangle {})", name,
                        corners + 4 * k, value, k / 3 + 1, t + 1));
      if (k % 3 == 0) mesh.points.emplace_back();
      mesh.points.back()[static_cast<int>(k % 3)] = value;
    }
    const int first = static_cast<int>(3 * t);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

} // namespace

TriangleMesh parseStl(std::string_view bytes, const std::string& name) {
  // Binary files may begin with "solid" as well, so the size decides.
  const bool solid = bytes.starts_with("solid");
  const std::size_t count = bytes.size() >= headerBytes ? littleEndian(bytes.data() + headerBytes - 4) : 0;
  const bool fits = bytes.size() >= headerBytes && bytes.size() == headerBytes + count * triangleBytes;
  if (!fits && !solid) {
    if (bytes.size() < headerBytes)
      throw InputError(
          fmt::format("{}: byte {}: the file ends, but an STL begins with 'solid' (text) or has at least "
                      "{} bytes (binary)",
                      name, bytes.size(), headerBytes));
    throw InputError(
        fmt::format("{}: byte 80: found {} triangles in a file of {} bytes, but a binary STL of so many "
                    "has {} bytes, and a text STL begins with 'solid'",
                    name, count, bytes.size(), headerBytes + count * triangleBytes));
  }
  if (count > mostTriangles && fits)
    throw InputError(fmt::format("{}: byte 80: found {} triangles, but at most {} can be read", name, count,
                                 mostTriangles));
  const TriangleMesh mesh = welded(fits ? readBinary(bytes, name) : TextReader(bytes, name).read());
  if (mesh.triangles.empty())
    throw InputError(
        fmt::format("{}: the file has no triangle with three different corners, but a wall needs one", name));
  return mesh;
}

TriangleMesh readStl(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in || std::filesystem::is_directory(file))
    throw InputError(fmt::format("{}: the file cannot be opened; check its name", file.string()));
  const std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  return parseStl(bytes, file.string());
}

TriangleMesh welded(const TriangleMesh& mesh) {
  TriangleMesh out;
  std::map<std::tuple<double, double, double>, int> known;
  std::vector<int> now(mesh.points.size());
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const Vec3& p = mesh.points[i];
    const auto [it, fresh] = known.try_emplace({p.x(), p.y(), p.z()}, static_cast<int>(out.points.size()));
    if (fresh) out.points.push_back(p);
    now[i] = it->second;
  }
  for (const auto& t : mesh.triangles) {
    const std::array<int, 3> w{now[t[0]], now[t[1]], now[t[2]]};
    if (w[0] != w[1] && w[1] != w[2] && w[2] != w[0]) out.triangles.push_back(w);
  }
  return out;
}

} // namespace sandglass
