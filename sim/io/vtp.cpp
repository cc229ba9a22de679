// VTK's XML PolyData form: a header in XML, then the arrays as raw little-endian bytes behind each other,
// each with its length (UInt64) in front. Read by VTK and ParaView of any age.

#include "sim/base/error.h"
#include "sim/io/atomic_file.h"
#include "sim/io/run_folder.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <numeric>

namespace sandglass {

static_assert(std::endian::native == std::endian::little);

namespace {

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

/// Collects arrays and hands out their XML elements.
class Appended {
public:
  std::string array(const char* type, const std::string& name, int components, const void* data,
                    std::size_t bytes) {
    const std::string element = fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n",
        type, escaped(name), components, bytes_.size());
    const auto length = static_cast<std::uint64_t>(bytes);
    bytes_.append(reinterpret_cast<const char*>(&length), sizeof length);
    if (bytes > 0) bytes_.append(static_cast<const char*>(data), bytes);
    return element;
  }
  std::string numbers(const std::string& name, const std::vector<double>& v) {
    return array("Float64", name, 1, v.data(), v.size() * sizeof(double));
  }
  std::string whole(const std::string& name, const std::vector<std::int64_t>& v) {
    return array("Int64", name, 1, v.data(), v.size() * sizeof(std::int64_t));
  }
  std::string vectors(const std::string& name, const std::vector<Vec3>& v) {
    static_assert(sizeof(Vec3) == 3 * sizeof(double));
    return array("Float64", name, 3, v.data(), v.size() * sizeof(Vec3));
  }
  const std::string& bytes() const { return bytes_; }

private:
  std::string bytes_;
};

/// Text in field data is a list of character codes that ends with 0.
std::string textArray(const std::string& name, const std::string& text) {
  std::string codes;
  for (const char c : text)
    codes += fmt::format("{} ", static_cast<unsigned char>(c));
  return fmt::format("<Array type=\"String\" Name=\"{}\" NumberOfTuples=\"1\" format=\"ascii\">{}0</Array>\n",
                     escaped(name), codes);
}

} // namespace

void exportVtp(const Frame& frame, const std::filesystem::path& file) {
  const std::size_t n = frame.size();
  std::vector<std::int64_t> connectivity(n), offsets(n);
  std::iota(connectivity.begin(), connectivity.end(), 0);
  std::iota(offsets.begin(), offsets.end(), 1);

  Appended appended;
  std::string xml =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<PolyData>\n<FieldData>\n";
  xml += fmt::format(
      "<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">{}</DataArray>\n",
      frame.time);
  xml += fmt::format(
      "<DataArray type=\"Int64\" Name=\"step\" NumberOfTuples=\"1\" format=\"ascii\">{}</DataArray>\n",
      frame.step);
  for (const auto& [key, value] : frame.provenance)
    xml += textArray(key, value);
  xml += fmt::format("</FieldData>\n<Piece NumberOfPoints=\"{0}\" NumberOfVerts=\"{0}\" NumberOfLines=\"0\" "
                     "NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n<PointData>\n",
                     n);
  xml += appended.whole("id", frame.id);
  for (const auto& [name, values] : frame.scalars)
    xml += appended.numbers(name, values);
  for (const auto& [name, values] : frame.vectors)
    xml += appended.vectors(name, values);
  if (!frame.orientation.empty()) {
    std::vector<double> turns;
    turns.reserve(4 * n);
    for (const auto& q : frame.orientation)
      turns.insert(turns.end(), {q.w(), q.x(), q.y(), q.z()});
    xml += appended.array("Float64", quantity::orientation, 4, turns.data(), turns.size() * sizeof(double));
  }
  xml += "</PointData>\n<Points>\n" + appended.vectors("Points", frame.position) + "</Points>\n<Verts>\n";
  xml += appended.whole("connectivity", connectivity) + appended.whole("offsets", offsets);
  xml += "</Verts>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_" + appended.bytes();
  xml += "\n</AppendedData>\n</VTKFile>\n";
  writeAtomically(file, xml);
}

void exportPvd(FrameSource& frames, const std::filesystem::path& pvdFile, const Log& log) {
  const std::string stem = pvdFile.stem().string();
  const auto folder = pvdFile.parent_path() / stem;
  std::error_code fault;
  std::filesystem::create_directories(folder, fault);
  if (fault)
    throw RunError(
        fmt::format("{}: the folder for the frames cannot be made ({})", folder.string(), fault.message()));
  std::string xml = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const std::string name = fmt::format("{:06}.vtp", i);
    exportVtp(*frames.load(i), folder / name);
    xml += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}/{}\"/>\n", frames.time(i),
                       escaped(stem), name);
  }
  writeAtomically(pvdFile, xml + "</Collection>\n</VTKFile>\n");
  report(log, LogLevel::info,
         fmt::format("{}: {} frames in {}", pvdFile.string(), frames.size(), folder.string()));
}

} // namespace sandglass
