#include "app/cli/result_files.h"

#include "sim/base/error.h"

#ifdef SANDGLASS_VIS
#include "vis/renderer.h"
#endif

#include <fmt/format.h>

#include <fstream>

namespace sandglass::cli {

namespace {

void writeText(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  out.close();
  if (!out)
    throw RunError(
        fmt::format("{}: cannot be written; check that the folder exists and has space", file.string()));
}

} // namespace

#ifdef SANDGLASS_VIS
struct ResultFiles::Painter {
  vis::Renderer renderer;
};
#else
struct ResultFiles::Painter {};
#endif

ResultFiles::ResultFiles(const std::filesystem::path& folder, bool csvOnly)
    : folder_(folder), csvOnly_(csvOnly) {
  std::error_code fault;
  std::filesystem::create_directories(folder_, fault);
  if (fault)
    throw InputError(
        fmt::format("{}: the folder for the results cannot be made: {}", folder.string(), fault.message()));
}

ResultFiles::~ResultFiles() = default;

void ResultFiles::write(const analysis::Curve& curve, const std::string& prefix) {
  const std::string stem = (folder_ / (prefix + curve.name)).string();
  writeText(stem + ".csv", analysis::toCsv(curve));
  if (csvOnly_) return;
  writeText(stem + ".json", analysis::toJson(curve));
#ifdef SANDGLASS_VIS
  // A single point is no line.
  analysis::Curve drawn = curve;
  std::erase_if(drawn.series, [](const analysis::Series& s) { return s.x.size() < 2; });
  if (drawn.series.empty()) return;
  if (!painter_) painter_ = std::make_unique<Painter>();
  auto text = curve.provenance;
  text["Software"] = "Sandglass";
  text["definition"] = curve.definition;
  vis::writePng(painter_->renderer.draw(drawn, 1200, 800), stem + ".png", text);
#endif
}

void ResultFiles::write(const analysis::Table& table, const std::string& prefix) {
  const std::string stem = (folder_ / (prefix + table.name)).string();
  writeText(stem + ".csv", analysis::toCsv(table));
  if (!csvOnly_) writeText(stem + ".json", analysis::toJson(table));
}

void ResultFiles::write(const analysis::Field& field, const std::string& prefix) {
  writeText((folder_ / (prefix + field.name)).string() + ".vti", analysis::toVti(field));
}

} // namespace sandglass::cli
