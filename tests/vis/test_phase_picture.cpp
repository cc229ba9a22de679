// Scattered series in charts, and pictures of runs beside them.

#include "tests/vis/pixels.h"
#include "tests/vis/sample_frames.h"
#include "vis/chart_style.h"
#include "vis/phase_picture.h"

#include <catch2/catch.hpp>

using namespace sandglass;
using namespace sandglass::test;

namespace {

analysis::Series scattered(const char* name, std::vector<double> x, std::vector<double> y) {
  analysis::Series series{name, std::move(x), std::move(y), {}};
  series.scatter = true;
  return series;
}

analysis::Curve diagram() {
  analysis::Curve chart;
  chart.title = "States";
  chart.x = {"r", "mm"};
  chart.y = {"omega", "rad/s"};
  chart.series = {{"critical", {1, 2, 3}, {10, 20, 30}, {}},
                  scattered("flat", {1}, {5}), // a single point, of which VTK draws no line
                  scattered("fluid", {}, {}),
                  scattered("pinned", {2, 3}, {35, 38})};
  chart.series.push_back(scattered("seeds disagree", {3}, {38}));
  chart.series.back().ring = true;
  return chart;
}

/// Pixel of the chart at these coordinates.
std::array<int, 3> pixelAt(const vis::Image& image, const vis::ChartPlace& place, double x, double y) {
  const double px = place.left + (x - place.xLow) / (place.xHigh - place.xLow) * (place.right - place.left);
  const double py = place.bottom + (y - place.yLow) / (place.yHigh - place.yLow) * (place.top - place.bottom);
  return at(image, static_cast<int>(px), static_cast<int>(py));
}

} // namespace

TEST_CASE("points of a scattered series are where they belong, in their colour", "[vis]") {
  vis::Renderer renderer;
  const analysis::Curve chart = diagram();
  const vis::Image image = renderer.draw(chart, 900, 600);
  const vis::ChartPlace place = renderer.chartPlace();
  const auto colour = [&](std::size_t series) {
    const vis::Rgb c = vis::styleOf(chart.series[series], series).colour;
    return std::array<int, 3>{c[0], c[1], c[2]};
  };
  CHECK(distance(pixelAt(image, place, 1, 5), colour(1)) < 40);
  CHECK(distance(pixelAt(image, place, 2, 35), colour(3)) < 40);
  CHECK(distance(pixelAt(image, place, 3, 38), colour(3)) < 40);           // the ring lies under its point
  CHECK(distance(pixelAt(image, place, 2.5, 36.5), {255, 255, 255}) < 40); // no line between points
  // No two kinds of points share their symbol and size.
  for (std::size_t a = 1; a <= 7; ++a)
    for (std::size_t b = a + 1; b <= 7; ++b) {
      const auto s = scattered("", {}, {});
      const auto p = vis::styleOf(s, a), q = vis::styleOf(s, b);
      CHECK((p.marker != q.marker || p.size != q.size));
    }
}

TEST_CASE("examples stand beside the diagram in two columns", "[vis]") {
  vis::Renderer renderer;
  std::vector<vis::PhaseExample> examples;
  for (int k = 0; k < 3; ++k) {
    auto frame = std::make_shared<Frame>();
    frame->id = {0};
    frame->position = {Vec3::Zero()};
    frame->scalars[quantity::radius] = {0.1};
    frame->domain.lower = Vec3::Constant(-1);
    frame->domain.upper = Vec3::Constant(1);
    vis::View view = flatView(0.3, 300, 400);
    view.box = false;
    view.colouring.quantity.clear();
    examples.push_back({frame, view});
  }
  const vis::Image image = vis::phasePicture(renderer, diagram(), examples);
  CHECK(image.width == 1200 + 2 * 300);
  CHECK(image.height == 800);
  for (const auto& [x, y] : {std::pair{1350, 200}, {1650, 200}, {1350, 600}})
    CHECK(distance(at(image, x, y), {255, 255, 255}) > 40);   // a grain
  CHECK(distance(at(image, 1650, 600), {255, 255, 255}) < 3); // nothing
}
