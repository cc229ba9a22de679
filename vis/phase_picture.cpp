#include "vis/phase_picture.h"

#include "vis/chart.h"

#include <fmt/format.h>

#include <algorithm>

namespace sandglass::vis {

namespace {

constexpr std::size_t columns = 2;

void paste(Image& onto, const Image& part, int left, int top) {
  for (int row = 0; row < part.height && top + row < onto.height; ++row) {
    const auto from = part.rgba.begin() + static_cast<std::ptrdiff_t>(row) * part.width * 4;
    const int width = std::min(part.width, onto.width - left);
    std::copy(from, from + static_cast<std::ptrdiff_t>(width) * 4,
              onto.rgba.begin() + (static_cast<std::ptrdiff_t>(top + row) * onto.width + left) * 4);
  }
}

} // namespace

Image phasePicture(Renderer& renderer, const analysis::Curve& chart,
                   const std::vector<PhaseExample>& examples) {
  int cellWidth = 0, cellHeight = 0;
  for (const auto& example : examples) {
    cellWidth = std::max(cellWidth, example.view.width);
    cellHeight = std::max(cellHeight, example.view.height);
  }
  const int rows = static_cast<int>((examples.size() + columns - 1) / columns);
  Image whole;
  whole.height = std::max(chartHeight, rows * cellHeight);
  whole.width = chartWidth + static_cast<int>(std::min(columns, examples.size())) * cellWidth;
  whole.rgba.assign(static_cast<std::size_t>(whole.width) * static_cast<std::size_t>(whole.height) * 4, 255);
  paste(whole, renderer.draw(chart, chartWidth, whole.height), 0, 0);
  for (std::size_t k = 0; k < examples.size(); ++k)
    paste(whole, renderer.draw(*examples[k].frame, examples[k].view),
          chartWidth + static_cast<int>(k % columns) * cellWidth, static_cast<int>(k / columns) * cellHeight);
  return whole;
}

void writePhasePicture(Renderer& renderer, const analysis::Curve& chart,
                       const std::vector<PhaseExample>& examples, const std::filesystem::path& file) {
  std::map<std::string, std::string> text = chart.provenance;
  text["Title"] = chart.title;
  text["Description"] = chart.definition;
  text["Software"] = "Sandglass";
  writePng(phasePicture(renderer, chart, examples), file, text);
}

} // namespace sandglass::vis
