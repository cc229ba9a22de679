#include "vis/chart.h"

#include <fmt/format.h>

namespace sandglass::vis {

void writeChart(Renderer& renderer, const analysis::Curve& curve, const std::filesystem::path& file,
                int width, int height) {
  std::map<std::string, std::string> text = curve.provenance;
  text["Title"] = curve.title;
  text["Description"] = curve.definition;
  text["Software"] = "Sandglass";
  for (const auto& [name, value] : curve.numbers)
    text["number " + name] = fmt::format("{:.17g}", value);
  writePng(renderer.draw(curve, width, height), file, text);
}

void writeChart(const analysis::Curve& curve, const std::filesystem::path& file, GlBackend backend) {
  Renderer renderer(backend);
  writeChart(renderer, curve, file);
}

} // namespace sandglass::vis
