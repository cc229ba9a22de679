#include "analysis/local_packing.h"

#include "analysis/free_surface.h"
#include "analysis/histogram.h"
#include "analysis/k_gamma.h"
#include "analysis/statistics.h"
#include "sim/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace sandglass::analysis {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double ball(double r) {
  return 4.0 / 3.0 * std::numbers::pi * r * r * r;
}

template <class Sample> Sample& slot(std::vector<Sample>& samples, std::size_t index) {
  if (samples.size() <= index) samples.resize(index + 1);
  return samples[index];
}

} // namespace

void LocalPacking::add(const Frame& frame, const VoronoiCells& cells, const Region& region) {
  const auto* radii = frame.has(quantity::radius) ? &frame.scalar(quantity::radius) : nullptr;
  const double d = options_.diameter, width = options_.slab * d;
  const UpFrame axes(options_.up);
  const Vec3 middle = options_.axis.value_or(0.5 * (frame.domain.lower + frame.domain.upper));
  if (global_.empty()) {
    definition_ =
        fmt::format("{} cells cut by walls{}; V_grain / V_cell; whole cells of grains in W: {}; d = {:.5g} m",
                    options_.radical ? "radical Voronoi (Laguerre)" : "Voronoi",
                    region.surface() ? " and the free surface" : "", region.description(), d);
    double low = std::numeric_limits<double>::infinity();
    for (int corner = 0; corner < 8; ++corner)
      low = std::min(low,
                     region.box().corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)).dot(axes.up));
    heightFrom_ = low;
  }
  std::vector<double> local(frame.size(), nan), volume(frame.size(), nan), freeVolume(frame.size(), nan),
      faces(frame.size(), nan);
  std::vector<Sample> heights, rings;
  std::vector<char> used(frame.size());
  double grainSum = 0, cellSum = 0;
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const double radius = radii ? (*radii)[i] : 0.5 * d, grain = ball(radius), cell = cells.volume[i];
    if (std::abs(2 * radius - d) > 0.01 * d) equal_ = false;
    if (!std::isfinite(cell) || !(cell > 0)) continue;
    local[i] = grain / cell;
    volume[i] = cell;
    freeVolume[i] = cell - grain;
    faces[i] = static_cast<double>(cells.faces(i).size());
    if (!region.containsGrain(frame.position[i], radius)) continue;
    if (cells.atBound[i] || cells.atSurface[i]) {
      ++leftOut_;
      continue;
    }
    used[i] = 1;
    grainSum += grain;
    cellSum += cell;
    fraction_.push_back(local[i]);
    volume_.push_back(cell / (d * d * d));
    if (!cells.atWall[i]) slot(faces_, cells.faces(i).size()) += 1;
    const double height = frame.position[i].dot(axes.up) - heightFrom_;
    const Vec3 off = frame.position[i] - middle;
    const double ring = (off - off.dot(axes.up) * axes.up).norm();
    for (Sample* s : {&slot(heights, static_cast<std::size_t>(std::max(0.0, height / width))),
                      &slot(rings, static_cast<std::size_t>(ring / width))}) {
      s->grains += grain;
      s->cells += cell;
      ++s->count;
    }
  }
  if (cellSum > 0) global_.push_back(grainSum / cellSum);
  byHeight_.push_back(std::move(heights));
  byRadius_.push_back(std::move(rings));
  if (options_.gridSpacing > 0) addField(frame, used, cells);
  grains_ = {{"local_fraction", "", definition_, std::move(local)},
             {"cell_volume", "m^3", definition_, std::move(volume)},
             {"free_volume", "m^3", "V_cell - V_grain", std::move(freeVolume)},
             {"cell_faces", "", "faces of the Voronoi cell, walls included", std::move(faces)}};
}

/// At each node: total grain volume over total cell volume of the grains within reach.
void LocalPacking::addField(const Frame& frame, const std::vector<char>& used, const VoronoiCells& cells) {
  const double d = options_.diameter, reach = options_.gridReach * d;
  if (!field_) {
    Vec3 lower = Vec3::Constant(std::numeric_limits<double>::infinity()), upper = -lower;
    for (std::size_t i = 0; i < frame.size(); ++i)
      if (used[i]) lower = lower.cwiseMin(frame.position[i]), upper = upper.cwiseMax(frame.position[i]);
    if (!(upper.array() >= lower.array()).all()) return;
    Field field;
    field.name = "packing_field";
    field.title = "Packing fraction";
    field.definition =
        fmt::format("total grain volume over total cell volume of grains within {:.3g} d of the node; {}",
                    options_.gridReach, definition_);
    field.origin = lower;
    for (int k = 0; k < 3; ++k) {
      field.count[static_cast<std::size_t>(k)] =
          1 + std::clamp(static_cast<int>(std::lround((upper[k] - lower[k]) / (options_.gridSpacing * d))), 0,
                         255);
      const int spaces = std::max(1, field.count[static_cast<std::size_t>(k)] - 1);
      field.spacing[k] = upper[k] > lower[k] ? (upper[k] - lower[k]) / spaces : d;
    }
    fieldGrains_.assign(field.size(), 0);
    fieldCells_.assign(field.size(), 0);
    field_ = std::move(field);
  }
  ++field_->frames;
  const Field& f = *field_;
  for (std::size_t i = 0; i < frame.size(); ++i) {
    if (!used[i]) continue;
    const double radius = frame.has(quantity::radius) ? frame.scalar(quantity::radius)[i] : 0.5 * d;
    std::array<int, 3> low, high;
    for (int k = 0; k < 3; ++k) {
      const double s = (frame.position[i][k] - f.origin[k]) / f.spacing[k], r = reach / f.spacing[k];
      low[static_cast<std::size_t>(k)] = std::max(0, static_cast<int>(std::ceil(s - r)));
      high[static_cast<std::size_t>(k)] =
          std::min(f.count[static_cast<std::size_t>(k)] - 1, static_cast<int>(std::floor(s + r)));
    }
    for (int c = low[2]; c <= high[2]; ++c)
      for (int b = low[1]; b <= high[1]; ++b)
        for (int a = low[0]; a <= high[0]; ++a) {
          if ((f.node(a, b, c) - frame.position[i]).squaredNorm() > reach * reach) continue;
          fieldGrains_[f.at(a, b, c)] += ball(radius);
          fieldCells_[f.at(a, b, c)] += cells.volume[i];
        }
  }
}

Curve LocalPacking::profile(const std::string& name, const std::string& title, const std::string& axis,
                            const std::vector<std::vector<Sample>>& samples, double from) const {
  Curve curve;
  curve.name = name;
  curve.title = title;
  curve.definition = "total grain volume over total cell volume in the slab; " + definition_;
  curve.x = {axis, "m"};
  curve.y = {"packing fraction", ""};
  curve.frames = samples.size();
  std::size_t slabs = 0;
  for (const auto& frame : samples)
    slabs = std::max(slabs, frame.size());
  const double width = options_.slab * options_.diameter;
  Series series{"fraction", {}, {}, {}};
  for (std::size_t s = 0; s < slabs; ++s) {
    double grains = 0, cells = 0;
    std::vector<double> each;
    for (const auto& frame : samples) {
      if (s >= frame.size() || frame[s].count == 0) continue;
      grains += frame[s].grains;
      cells += frame[s].cells;
      each.push_back(frame[s].grains / frame[s].cells);
    }
    if (each.empty()) continue;
    series.x.push_back(from + (static_cast<double>(s) + 0.5) * width);
    series.y.push_back(grains / cells);
    series.error.push_back(each.size() >= 4 ? blockedStandardError(each) : nan);
  }
  if (samples.size() < 4) series.error.clear();
  curve.series.push_back(std::move(series));
  return curve;
}

Results LocalPacking::results() const {
  if (fraction_.empty())
    throw InputError(
        fmt::format("no grain in the region has a whole Voronoi cell ({} end at the free surface or at "
                    "a bound of the domain): choose other frames or wider limits",
                    leftOut_));
  Results results;
  const auto n = static_cast<double>(fraction_.size());
  const double global = mean(global_);
  const double globalError = global_.size() >= 4 ? blockedStandardError(global_) : nan;

  const auto [least, most] = std::minmax_element(fraction_.begin(), fraction_.end());
  Curve local;
  local.name = "local_fraction";
  local.title = "Local packing fraction";
  local.definition = definition_;
  local.x = {"V_grain / V_cell", ""};
  local.y = {"density", ""};
  local.frames = byHeight_.size();
  const double pad = 1e-3 + 0.01 * (*most - *least);
  Histogram histogram(*least - pad, *most + pad, options_.bins);
  for (const double f : fraction_)
    histogram.add(f);
  local.series.push_back(histogram.density("local fraction"));
  local.numbers = {{"global_fraction", global},
                   {"mean_local_fraction", mean(fraction_)},
                   {"standard_deviation", std::sqrt(variance(fraction_))},
                   {"cells", n},
                   {"cells_left_out", static_cast<double>(leftOut_)}};
  if (std::isfinite(globalError)) local.numbers["global_fraction_error"] = globalError;
  local.marks.push_back({"global", global, true});
  results.curves.push_back(std::move(local));

  Curve volumes;
  volumes.name = "cell_volumes";
  volumes.title = "Volumes of Voronoi cells";
  volumes.x = {"V_cell / d^3", ""};
  volumes.y = {"density", ""};
  volumes.frames = byHeight_.size();
  const auto [smallest, largest] = std::minmax_element(volume_.begin(), volume_.end());
  const double margin = 1e-3 + 0.01 * (*largest - *smallest);
  Histogram byVolume(*smallest - margin, *largest + margin, options_.bins);
  for (const double v : volume_)
    byVolume.add(v);
  volumes.series.push_back(byVolume.density("cells"));
  volumes.numbers = {{"mean", mean(volume_)}, {"cells", n}};
  volumes.definition = definition_;
  std::string kGamma;
  const KGamma fit = fitKGamma(volume_, dodecahedronVolume);
  if (equal_ && std::isfinite(fit.k) && *smallest >= 0.95 * dodecahedronVolume) {
    volumes.definition += fmt::format("; k-gamma law by moments, V_min = {} d^3", dodecahedronVolume);
    volumes.numbers["k"] = fit.k;
    volumes.numbers["k_error"] = fit.kError;
    Series law{"k-gamma", volumes.series[0].x, {}, {}};
    for (const double x : law.x)
      law.y.push_back(fit.density(x));
    volumes.series.push_back(std::move(law));
    kGamma = fmt::format(", k-gamma k = {:.3g} +- {:.2g}", fit.k, fit.kError);
  }
  results.curves.push_back(std::move(volumes));

  Curve faces;
  faces.name = "cell_faces";
  faces.title = "Faces of Voronoi cells";
  faces.definition = "cells away from walls; " + definition_;
  faces.x = {"faces", ""};
  faces.y = {"share", ""};
  faces.frames = byHeight_.size();
  double total = 0, sum = 0;
  for (std::size_t f = 0; f < faces_.size(); ++f)
    total += faces_[f], sum += static_cast<double>(f) * faces_[f];
  Series share{"share", {}, {}, {}};
  for (std::size_t f = 0; f < faces_.size(); ++f)
    if (faces_[f] > 0) {
      share.x.push_back(static_cast<double>(f));
      share.y.push_back(faces_[f] / total);
      share.error.push_back(std::sqrt(faces_[f]) / total);
    }
  if (total > 0) {
    faces.numbers["mean"] = sum / total;
    faces.series.push_back(std::move(share));
    results.curves.push_back(std::move(faces));
  }

  results.curves.push_back(
      profile("fraction_by_height", "Packing fraction by height", "height", byHeight_, heightFrom_));
  results.curves.push_back(
      profile("fraction_by_radius", "Packing fraction by distance from the axis", "distance", byRadius_, 0));
  if (field_) {
    Field field = *field_;
    auto& values = field.scalars["packing_fraction"];
    for (std::size_t k = 0; k < fieldCells_.size(); ++k)
      values.push_back(fieldCells_[k] > 0 ? fieldGrains_[k] / fieldCells_[k] : nan);
    results.fields.push_back(std::move(field));
  }
  results.grains = grains_;
  results.sentences.push_back(fmt::format(
      "Voronoi packing: global fraction {:.4f}{}, mean local fraction {:.4f}, {:.0f} cells{}", global,
      std::isfinite(globalError) ? fmt::format(" +- {:.1g}", globalError) : "", mean(fraction_), n, kGamma));
  return results;
}

} // namespace sandglass::analysis
