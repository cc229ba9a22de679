#include "analysis/field.h"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <cstring>

namespace sandglass::analysis {

namespace {

static_assert(std::endian::native == std::endian::little, "the file says little-endian");

std::string base64(const std::string& bytes) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) {
      return i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u;
    };
    const std::uint32_t three = byte(0) << 16 | byte(1) << 8 | byte(2);
    for (int k = 0; k < 4; ++k)
      out += i + static_cast<std::size_t>(k) > bytes.size() ? '=' : digits[three >> (18 - 6 * k) & 63];
  }
  return out;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text)
    out += c == '&'   ? "&amp;"
           : c == '<' ? "&lt;"
           : c == '>' ? "&gt;"
           : c == '"' ? "&quot;"
                      : std::string(1, c);
  return out;
}

/// A VTK binary block: its length in bytes as UInt64, then the bytes.
std::string dataArray(const std::string& name, int components, const double* values, std::size_t count) {
  const std::uint64_t length = count * sizeof(double);
  std::string bytes(sizeof length + length, '\0');
  std::memcpy(bytes.data(), &length, sizeof length);
  if (length > 0) std::memcpy(bytes.data() + sizeof length, values, length);
  return fmt::format(
      "<DataArray type=\"Float64\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"binary\">\n{}\n"
      "</DataArray>\n",
      escaped(name), components, base64(bytes));
}

std::string textArray(const std::string& name, const std::string& text) {
  std::string codes;
  for (const unsigned char c : text)
    codes += fmt::format("{} ", static_cast<int>(c));
  return fmt::format("<DataArray type=\"String\" Name=\"{}\" NumberOfTuples=\"1\" format=\"ascii\">\n{}0\n"
                     "</DataArray>\n",
                     escaped(name), codes);
}

} // namespace

std::string toVti(const Field& field) {
  const std::string extent =
      fmt::format("0 {} 0 {} 0 {}", field.count[0] - 1, field.count[1] - 1, field.count[2] - 1);
  std::string out = fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<ImageData WholeExtent=\"{}\" Origin=\"{} {} {}\" Spacing=\"{} {} {}\">\n",
      extent, field.origin.x(), field.origin.y(), field.origin.z(), field.spacing.x(), field.spacing.y(),
      field.spacing.z());
  out += "<FieldData>\n" + textArray("definition", field.definition);
  for (const auto& [name, unit] : field.units)
    out += textArray("unit " + name, unit);
  for (const auto& [name, value] : field.provenance)
    out += textArray("provenance " + name, value);
  out += fmt::format("</FieldData>\n<Piece Extent=\"{}\">\n<PointData>\n", extent);
  for (const auto& [name, values] : field.scalars)
    out += dataArray(name, 1, values.data(), values.size());
  for (const auto& [name, values] : field.vectors)
    out += dataArray(name, 3, values.data()->data(), 3 * values.size());
  for (const auto& [name, values] : field.tensors)
    out += dataArray(name, 9, values.data()->data(), 9 * values.size());
  return out + "</PointData>\n</Piece>\n</ImageData>\n</VTKFile>\n";
}

} // namespace sandglass::analysis
