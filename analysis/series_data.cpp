#include "analysis/series_data.h"

#include "sim/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

namespace sandglass::analysis {

namespace {

std::string known(const SeriesColumns& columns) {
  std::string list;
  for (const auto& [name, column] : columns)
    list += (list.empty() ? "" : ", ") + name;
  return list.empty() ? "no columns" : list;
}

} // namespace

const std::vector<double>& recordedColumn(const SeriesColumns& columns, const std::string& name,
                                          const std::string& source) {
  const auto it = columns.find(name);
  if (it == columns.end())
    throw InputError(fmt::format("{}: there is no column '{}'; give the outlet record = true", source, name));
  return it->second.value;
}

DischargeData dischargeOf(const SeriesColumns& columns, const std::string& probe, const std::string& source) {
  const auto it = columns.find(probe + ".mass");
  if (it == columns.end())
    throw InputError(fmt::format("{}: there is no column '{}.mass' of a flow_rate probe; there are: {}",
                                 source, probe, known(columns)));
  return {it->second.time, it->second.value};
}

DischargeData dischargeOf(const FrameSource& frames, double density) {
  DischargeData data;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const FramePtr frame = frames.load(f);
    double mass = 0;
    if (density > 0 && !frame->scalars.contains(quantity::mass)) {
      for (const double r : frame->scalar(quantity::radius))
        mass += density * 4.0 / 3.0 * std::numbers::pi * r * r * r;
    } else {
      for (const double m : frame->scalar(quantity::mass))
        mass += m;
    }
    data.time.push_back(frame->time);
    data.mass.push_back(mass);
  }
  const auto fullest = std::max_element(data.mass.rbegin(), data.mass.rend());
  if (fullest == data.mass.rend()) return data;
  const double most = *fullest;
  const auto first = data.mass.rend() - fullest - 1;
  data.time.erase(data.time.begin(), data.time.begin() + first);
  data.mass.erase(data.mass.begin(), data.mass.begin() + first);
  for (double& m : data.mass)
    m = most - m;
  return data;
}

Curve energyCurve(const SeriesColumns& columns, const std::string& probe, const std::string& source) {
  Curve curve;
  curve.name = "energies";
  curve.title = "Energies";
  curve.definition = fmt::format("probe '{}'", probe);
  curve.x = {"time", "s"};
  curve.y = {"energy", "J"};
  for (const auto& [name, column] : columns)
    if (name.starts_with(probe + "."))
      curve.series.push_back({name.substr(probe.size() + 1), column.time, column.value, {}});
  if (curve.series.empty())
    throw InputError(fmt::format("{}: there are no columns of an energies probe '{}'; there are: {}", source,
                                 probe, known(columns)));
  return curve;
}

} // namespace sandglass::analysis
