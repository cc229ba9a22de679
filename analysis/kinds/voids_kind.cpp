// Void sizes, each by its name.

#include "analysis/containing_sizes.h"
#include "analysis/grain_sizes.h"
#include "analysis/histogram.h"
#include "analysis/kinds/kinds.h"
#include "analysis/kinds/knob_specs.h"
#include "analysis/shell_cutoff.h"
#include "analysis/statistics.h"
#include "analysis/void_sizes.h"
#include "sim/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sandglass::analysis {

namespace {

class VoidAnalysis : public Analysis {
public:
  VoidAnalysis(const Parameters& knobs, const AnalysisContext& context) : knobs_(knobs), context_(context) {}

  void add(const Frame& frame) override {
    if (context_.diameter <= 0) context_.diameter = meanDiameter(frame);
    const double d = context_.diameter;
    RegionOptions options = grainRegion(context_, d, knobs_.number("margin"));
    options.clearance = 0;
    const Region region(frame, options);
    regionText_ = region.description();
    const SurfaceDistance distance(frame, d, knobs_.number("largest") * d);
    const auto probes = static_cast<std::size_t>(knobs_.integer("probes"));
    const VoidPoints points =
        voidPoints(distance, region, probes, knobs_.number("wall_distance") * d, context_.seed + frames_);
    equal_ = equal_ && distance.equalGrains();
    ++frames_;
    tried_ += static_cast<double>(points.tried);
    v1_.add(points.distance, points.nearWall, d);

    const bool wantV3 = knobs_.boolean("v3"), wantV2 = knobs_.boolean("v2");
    if (wantV2 || wantV3) {
      const VoronoiCells cells =
          distance.equalGrains() ? cellsForVoids(frame, context_.facts.up, d) : VoronoiCells{};
      const auto found = holes(frame, cells, distance, region, points, d);
      addHoles(found, d);
      if (wantV2) addV2(frame, cells, distance, region, found, points, d);
    }
    if (knobs_.boolean("grid"))
      addGrid(distanceGrid(distance, region, gridSpacing(region, d)), region, distance, d);
  }

  Results results() const override;

private:
  /// Values over d by bulk and wall.
  struct Sizes {
    std::vector<double> bulk, wall;
    void add(const std::vector<double>& values, const std::vector<char>& nearWall, double d) {
      for (std::size_t k = 0; k < values.size(); ++k)
        (nearWall[k] ? wall : bulk).push_back(values[k] / d);
    }
  };

  double gridSpacing(const Region& region, double d) const {
    // Coarser where the grid would have more than twenty million nodes.
    return std::max(knobs_.number("spacing") * d, std::cbrt(region.box().sizes().prod() / 2e7));
  }

  void addHoles(const std::vector<EmptySphere>& found, double d) {
    balls_ = {"largest_voids",
              "largest empty spheres between grains and walls whose centres no larger one contains",
              {}};
    for (const auto& s : found) {
      (s.atWall ? v3_.wall : v3_.bulk).push_back(s.radius / d);
      const bool apart = std::none_of(balls_.balls.begin(), balls_.balls.end(),
                                      [&](const Ball& b) { return (b.centre - s.centre).norm() < b.radius; });
      if (balls_.balls.size() < 100 && apart) balls_.balls.push_back({s.centre, s.radius, s.atWall});
    }
  }

  void addV2(const Frame& frame, const VoronoiCells& cells, const SurfaceDistance& distance,
             const Region& region, const std::vector<EmptySphere>& found, const VoidPoints& points,
             double d) {
    // Not more points than are needed: each asks for a search among millions of spheres.
    VoidPoints some;
    const auto most = static_cast<std::size_t>(knobs_.integer("v2_probes"));
    const std::size_t stride = std::max<std::size_t>(1, points.point.size() / std::max<std::size_t>(1, most));
    for (std::size_t k = 0; k < points.point.size(); k += stride) {
      some.point.push_back(points.point[k]);
      some.distance.push_back(points.distance[k]);
      some.nearWall.push_back(points.nearWall[k]);
    }
    some.distance = climbedSizes(distance, region, some, d);
    const int level = static_cast<int>(knobs_.integer("v2_level"));
    const auto fine = containingSizes(frame, cells, distance, region, found, some, level, d);
    const auto coarse = containingSizes(frame, cells, distance, region, found, some, level / 2, d);
    for (std::size_t k = 0; k < fine.size(); ++k)
      v2Error_.push_back((fine[k] - coarse[k]) / d);
    v2_.add(fine, some.nearWall, d);
  }

  void addGrid(const DistanceGrid& grid, const Region& region, const SurfaceDistance& distance, double d) {
    // The 2007 source: least of the distance to grains, to the box's planes, and a cap.
    const double cap = 1.4975 * d;
    const auto& box = region.box();
    for (int c = 0; c < grid.count[2]; ++c)
      for (int b = 0; b < grid.count[1]; ++b)
        for (int a = 0; a < grid.count[0]; ++a) {
          const std::size_t node = (static_cast<std::size_t>(c) * grid.count[1] + b) * grid.count[0] + a;
          const double grains = grid.grains[node];
          if (!(grains > 0)) continue;
          const Vec3 x = grid.origin + grid.spacing.cwiseProduct(Vec3(a, b, c));
          double planes = cap;
          for (int k = 0; k < 3; ++k)
            if (!grid.periodic[static_cast<std::size_t>(k)])
              planes = std::min({planes, x[k] - box.min()[k], box.max()[k] - x[k]});
          (planes < grains ? gridded_.wall : gridded_.bulk).push_back(std::min({grains, planes, cap}) / d);
        }
    spacing_ = grid.spacing.maxCoeff();
    const double probe = knobs_.number("probe_radius") * d;
    const Cavities fine = cavities(grid, probe, 1), coarse = cavities(grid, probe, 2);
    for (const double v : fine.volumes)
      cavities_.push_back(v / (d * d * d));
    cavityTotal_ += fine.total / (d * d * d);
    cavityCoarse_ += coarse.total / (d * d * d);
    cavityCount_ += static_cast<double>(fine.volumes.size());
    cavityCoarseCount_ += static_cast<double>(coarse.volumes.size());
    (void)distance;
  }

  Curve curveOf(const std::string& name, const std::string& title, const Sizes& sizes,
                const std::string& definition, double range) const {
    Curve curve;
    curve.name = name;
    curve.title = title;
    curve.definition = definition + "; W: " + regionText_;
    curve.x = {"radius / d", ""};
    curve.y = {"density", ""};
    curve.frames = frames_;
    for (const auto& [label, values] : {std::pair{"bulk", &sizes.bulk}, {"wall", &sizes.wall}}) {
      if (values->empty()) continue;
      Histogram histogram(0, range, static_cast<int>(knobs_.integer("bins")));
      for (const double v : *values)
        histogram.add(v);
      curve.series.push_back(histogram.density(label));
      curve.numbers[fmt::format("{}_mean", label)] = mean(*values);
      curve.numbers[fmt::format("{}_mean_error", label)] =
          std::sqrt(variance(*values) / static_cast<double>(values->size()));
      curve.numbers[fmt::format("{}_largest", label)] = *std::max_element(values->begin(), values->end());
      curve.numbers[fmt::format("{}_count", label)] = static_cast<double>(values->size());
    }
    return curve;
  }

  Parameters knobs_;
  AnalysisContext context_;
  Sizes v1_, v2_, v3_, gridded_;
  std::vector<double> v2Error_, cavities_;
  double tried_ = 0, spacing_ = 0, cavityTotal_ = 0, cavityCoarse_ = 0, cavityCount_ = 0,
         cavityCoarseCount_ = 0;
  bool equal_ = true;
  std::size_t frames_ = 0;
  BallSet balls_;
  std::string regionText_;
};

Results VoidAnalysis::results() const {
  if (v1_.bulk.empty() && v1_.wall.empty())
    throw InputError(
        "void sizes found no point outside grains in the region: choose other frames or wider limits");
  Results results;
  const auto largest = [](const Sizes& s) {
    double most = 1e-9;
    for (const auto* v : {&s.bulk, &s.wall})
      if (!v->empty()) most = std::max(most, *std::max_element(v->begin(), v->end()));
    return 1.02 * most;
  };
  const std::string wall =
      fmt::format("wall: points nearer than {:.3g} d to a wall", knobs_.number("wall_distance"));
  Curve v1 = curveOf("voids_v1", "V1 void sizes (Torquato)", v1_,
                     "V1: distance from random points of the voids to the nearest solid surface; " + wall,
                     largest(v1_));
  const double porosity = static_cast<double>(v1_.bulk.size() + v1_.wall.size()) / tried_;
  v1.numbers["porosity"] = porosity;
  v1.numbers["porosity_error"] = std::sqrt(porosity * (1 - porosity) / tried_);
  const auto bulkOr = [](const Curve& c, const char* what) {
    const auto it = c.numbers.find(std::string("bulk_") + what);
    return it == c.numbers.end() ? std::numeric_limits<double>::quiet_NaN() : it->second;
  };
  std::string sentence =
      fmt::format("voids: porosity {:.4f}, V1 mean {:.4g} d", porosity, bulkOr(v1, "mean"));
  results.curves.push_back(std::move(v1));
  if (!v2Error_.empty()) {
    Curve v2 = curveOf(
        "voids_v2", "V2 void sizes (Gelb & Gubbins)", v2_,
        fmt::format("V2: largest empty sphere that contains a random point of the voids; spheres {}; {}",
                    equal_ ? "centred on Voronoi vertices, edges and faces, and climbed to from the points"
                           : "sampled, and climbed to maximal ones",
                    wall),
        largest(v2_));
    v2.numbers["sampling_error"] = mean(v2Error_);
    sentence +=
        fmt::format(", V2 mean {:.4g} d (too small by about {:.1g} d)", bulkOr(v2, "mean"), mean(v2Error_));
    results.curves.push_back(std::move(v2));
  }
  if (!v3_.bulk.empty() || !v3_.wall.empty()) {
    Curve v3 = curveOf(
        "voids_v3", "V3 hole radii", v3_,
        equal_ ? std::string("V3: Voronoi vertices, distance to the centres less the radius, each vertex "
                             "once; wall: largest spheres that touch a wall")
               : std::string("V3 for unequal grains: maximal empty spheres climbed to from 5000 random "
                             "points, each once; small ones may be missed; wall: touching one"),
        largest(v3_));
    sentence += fmt::format(", V3 largest {:.4g} d", bulkOr(v3, "largest"));
    results.curves.push_back(std::move(v3));
  }
  if (spacing_ > 0) {
    results.curves.push_back(curveOf(
        "voids_gridded", "Gridded hole sizes", gridded_,
        fmt::format(
            "grid of {:.4g} m: least of the distance to the nearest grain surface, to the planes of the "
            "region's box, and 1.4975 d; wall: limited by a plane (Rycroft 2007)",
            spacing_),
        largest(gridded_)));
    Table table;
    table.name = "voids_v5";
    table.title = "V5 cavities";
    table.definition = fmt::format("V5: parts of the space left to the centre of a probe of radius {:.3g} d, "
                                   "connected on a grid of {:.4g} m; the "
                                   "same with twice the spacing beside; W: {}",
                                   knobs_.number("probe_radius"), spacing_, regionText_);
    table.rowTitle = "grid";
    table.columns = {{"cavities", ""}, {"total volume", "d^3"}, {"largest", "d^3"}};
    const auto f = static_cast<double>(frames_);
    const double most = cavities_.empty() ? 0 : *std::max_element(cavities_.begin(), cavities_.end());
    table.rowNames = {"fine", "coarse"};
    table.rows = {{cavityCount_ / f, cavityTotal_ / f, most},
                  {cavityCoarseCount_ / f, cavityCoarse_ / f, std::numeric_limits<double>::quiet_NaN()}};
    results.tables.push_back(std::move(table));
    sentence += fmt::format(", V5 {:.0f} cavities of {:.3g} d^3 in all", cavityCount_ / f, cavityTotal_ / f);
  }
  results.balls.push_back(balls_);
  results.sentences.push_back(sentence);
  return results;
}

} // namespace

AnalysisKind voidsKind() {
  return {
      .name = "voids",
      .title = "Void sizes",
      .description =
          "void sizes by V1 (Torquato), V2 (Gelb & Gubbins), V3 (Voronoi vertices), V5 (cavities), and on a "
          "grid; bulk and wall apart",
      .source = "Torquato 2002; Gelb & Gubbins 1999; Rycroft 2007; Sastry et al. 1997",
      .needs = {.quantities = {quantity::radius}, .grains = 1},
      .knobs = {integerKnob("probes", 200000, 100, 1e9, "random points, solid and void"),
                integerKnob("v2_probes", 20000, 100, 1e9, "at most so many void points for V2"),
                integerKnob("v2_level", 3, 0, 20, "points on each Voronoi edge for V2"),
                integerKnob("bins", 100, 1, 100000, "bins of the distributions"),
                numberKnob("wall_distance", 1.5, 0, 1000,
                           "points nearer to a wall, in diameters, count apart"),
                numberKnob("margin", 1, 0, 1000, "distance from the free surface, in diameters"),
                numberKnob("largest", 3, 0.1, 1000, "no void is told apart beyond this radius, in diameters"),
                numberKnob("spacing", 0.1, 0.001, 10, "of the grid, in diameters; coarser beyond 2e7 nodes"),
                numberKnob("probe_radius", 0.15, 0, 10, "of the probe of V5, in diameters"),
                switchKnob("v2", true, "whether V2 is wanted"),
                switchKnob("v3", true, "whether V3 is wanted"),
                switchKnob("grid", true, "whether the grid (V5, gridded sizes) is wanted")},
      .make = [](const Parameters& knobs, const AnalysisContext& context) -> std::unique_ptr<Analysis> {
        return std::make_unique<VoidAnalysis>(knobs, context);
      }};
}

} // namespace sandglass::analysis
