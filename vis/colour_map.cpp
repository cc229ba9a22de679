#include "vis/colour_map.h"

#include "sim/base/error.h"
#include "vis/view.h"

#include <fmt/format.h>
#include <vtkColorTransferFunction.h>
#include <vtkNew.h>

#include <algorithm>
#include <cmath>

namespace sandglass::vis {

namespace {

enum class Between { lab, diverging, steps };

struct Definition {
  const char* name;
  Between between;
  std::vector<std::uint32_t> stops; ///< 0xRRGGBB, evenly spaced
};

const std::vector<Definition>& definitions() {
  static const std::vector<Definition> all{
      {"viridis",
       Between::lab,
       {0x440154, 0x482878, 0x3e4a89, 0x31688e, 0x26828e, 0x1f9e89, 0x35b779, 0x6ece58, 0xb5de2b, 0xfde725}},
      {"cividis",
       Between::lab,
       {0x00204d, 0x00336f, 0x39486b, 0x575c6d, 0x707173, 0x8a8779, 0xa69d75, 0xc4b56c, 0xe4cf5b, 0xffea46}},
      {"inferno",
       Between::lab,
       {0x000004, 0x1b0c42, 0x4b0c6b, 0x781c6d, 0xa52c60, 0xcf4446, 0xed6925, 0xfb9a06, 0xf7d03c, 0xfcffa4}},
      {"magma",
       Between::lab,
       {0x000004, 0x180f3d, 0x440f76, 0x721f81, 0x9e2f7f, 0xcd4071, 0xf1605d, 0xfd9668, 0xfeca8d, 0xfcfdbf}},
      {"plasma",
       Between::lab,
       {0x0d0887, 0x46039f, 0x7201a8, 0x9c179e, 0xbd3786, 0xd8576b, 0xed7953, 0xfb9f3a, 0xfdca26, 0xf0f921}},
      {"dune", Between::lab, {0x17447f, 0x006a94, 0x3a9094, 0x8aaf8a, 0xd8c685, 0xf9e1bb}},
      {"grey", Between::lab, {0x262626, 0xf1f1f1}},
      {"coolwarm", Between::diverging, {0x3b4cc0, 0xb40426}},
      {"discrete",
       Between::steps,
       {0x0072b2, 0xe69f00, 0x009e73, 0xcc79a7, 0x56b4e9, 0xd55e00, 0xf0e442, 0x4d4d4d}},
  };
  return all;
}

constexpr int tableSize = 256;
constexpr int distinct = 8;

Rgb unpack(std::uint32_t c) {
  return {static_cast<std::uint8_t>(c >> 16), static_cast<std::uint8_t>(c >> 8 & 255),
          static_cast<std::uint8_t>(c & 255)};
}

} // namespace

Rgb rgb(const std::array<double, 3>& colour) {
  Rgb result;
  for (int k = 0; k < 3; ++k)
    result[k] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(colour[k], 0.0, 1.0)));
  return result;
}

ColourMap::ColourMap(const std::string& name, bool reversed, int bands) {
  const auto& all = definitions();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Definition& d) { return d.name == name; });
  if (found == all.end())
    throw InputError(
        fmt::format("there is no colour map '{}'; there are: {}", name, fmt::join(colourMaps(), ", ")));
  if (found->between == Between::steps) {
    discrete_ = true;
    for (const auto stop : found->stops)
      table_.push_back(unpack(stop));
    if (reversed) std::reverse(table_.begin(), table_.end());
    return;
  }
  vtkNew<vtkColorTransferFunction> function;
  if (found->between == Between::lab)
    function->SetColorSpaceToLab();
  else
    function->SetColorSpaceToDiverging();
  const double last = static_cast<double>(found->stops.size() - 1);
  for (std::size_t i = 0; i < found->stops.size(); ++i) {
    const Rgb c = unpack(found->stops[i]);
    function->AddRGBPoint(static_cast<double>(i) / last, c[0] / 255.0, c[1] / 255.0, c[2] / 255.0);
  }
  for (int i = 0; i < tableSize; ++i) {
    double rgb[3];
    function->GetColor(i / (tableSize - 1.0), rgb);
    Rgb entry;
    for (int k = 0; k < 3; ++k)
      entry[k] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(rgb[k], 0.0, 1.0)));
    table_.push_back(entry);
  }
  if (reversed) std::reverse(table_.begin(), table_.end());
  if (bands <= 0) return;
  const std::vector<Rgb> smooth = std::move(table_);
  table_.clear();
  for (int k = 0; k < bands; ++k)
    table_.push_back(
        smooth[static_cast<std::size_t>(bands == 1 ? tableSize / 2 : k * (tableSize - 1) / (bands - 1))]);
  banded_ = true;
}

Rgb ColourMap::at(double share) const {
  if (std::isnan(share)) return {150, 150, 150};
  const double n = static_cast<double>(table_.size());
  const double scaled = discrete_ || banded_ ? std::floor(share * n) : std::round(share * (n - 1));
  return table_[static_cast<std::size_t>(std::clamp(scaled, 0.0, n - 1))];
}

Rgb ColourMap::ofIndex(long index) const {
  const long wrapped = ((index % distinct) + distinct) % distinct;
  return discrete_ ? table_[static_cast<std::size_t>(wrapped)]
                   : at(static_cast<double>(wrapped) / (distinct - 1));
}

std::vector<std::string> colourMaps() {
  std::vector<std::string> names;
  for (const auto& d : definitions())
    names.emplace_back(d.name);
  return names;
}

} // namespace sandglass::vis
