// Voronoi cells: lattices, boxes filled to rounding, curved walls, random points, radical cells.

#include "analysis/k_gamma.h"
#include "analysis/registry.h"
#include "analysis/statistics.h"
#include "analysis/voronoi.h"
#include "tests/analysis/lattices.h"

#include <catch2/catch.hpp>
#include <tbb/global_control.h>

#include <numbers>
#include <numeric>

using namespace sandglass;
using namespace sandglass::analysis;
using namespace sandglass::analysis::test;

namespace {

double total(const VoronoiCells& cells) {
  return std::accumulate(cells.volume.begin(), cells.volume.end(), 0.0);
}

VoronoiOptions plainCells(int wallRounds = 3) {
  VoronoiOptions options;
  options.radical = false;
  options.wallRounds = wallRounds;
  return options;
}

} // namespace

TEST_CASE("Voronoi cells of lattices", "[voronoi]") {
  // d^3; d^3 / sqrt(2): the Kepler fraction pi / sqrt(18); 4 d^3 / (3 sqrt(3)) with 14 faces.
  const auto [name, frame, volume, faces] = GENERATE(
      table<std::string, Frame, double, int>({{"sc", simpleCubicFrame(), 1.0, 6},
                                              {"fcc", faceCentredFrame(), 1 / std::sqrt(2.0), 12},
                                              {"hcp", hexagonalFrame(), 1 / std::sqrt(2.0), 12},
                                              {"bcc", bodyCentredFrame(), 4 / (3 * std::sqrt(3.0)), 14}}));
  INFO(name);
  const VoronoiCells cells = voronoiCells(frame, {});
  for (std::size_t i = 0; i < frame.size(); ++i) {
    CHECK(cells.volume[i] == Approx(volume).epsilon(1e-10));
    int real = 0; // twelve planes meet in some vertices: faces of no area may be left there
    for (const auto& face : cells.faces(i))
      if (face.area > 1e-9) {
        ++real;
        CHECK(face.other >= 0);
      }
    CHECK(real == faces);
    CHECK(cells.faces(i)[0].vector.norm() == Approx(1).epsilon(1e-10));
  }
}

TEST_CASE("the Kepler fraction comes out of the analysis", "[voronoi]") {
  const AnalysisKind& kind = analysisKind("voronoi");
  const Results r = analyze(kind, defaultKnobs(kind), {}, {std::make_shared<Frame>(faceCentredFrame())});
  CHECK(r.curves[0].numbers.at("global_fraction") == Approx(std::numbers::pi / std::sqrt(18)).epsilon(1e-10));
}

TEST_CASE("cells fill boxes", "[voronoi]") {
  const bool periodic = GENERATE(true, false);
  const bool radical = GENERATE(true, false);
  const Vec3 size(1, 1.3, 0.7);
  Frame frame = uniformFrame(2000, size, {periodic, periodic, periodic}, 0.01, {}, 5);
  if (radical)
    for (std::size_t i = 0; i < frame.size(); ++i)
      frame.scalars[quantity::radius][i] = 0.005 + 0.03 * static_cast<double>(i % 7) / 7;
  VoronoiOptions options;
  options.radical = radical;
  VoronoiCells cells = voronoiCells(frame, options);
  for (double& v : cells.volume)
    if (std::isnan(v)) v = 0; // empty radical cells of points inside larger spheres
  INFO("periodic " << periodic << ", radical " << radical);
  CHECK(total(cells) == Approx(size.prod()).epsilon(1e-10));
}

TEST_CASE("a thin periodic slab is filled by cells that see several images", "[voronoi]") {
  const Vec3 size(4, 4, 1.3);
  const Frame frame = uniformFrame(12, size, {true, true, true}, 0.5, {}, 5);
  CHECK(total(voronoiCells(frame, {})) == Approx(size.prod()).epsilon(1e-10));
}

TEST_CASE("random points have 15.535 faces a cell", "[voronoi]") {
  // 48 pi^2 / 35 + 2 (Meijering 1953). The standard deviation of one cell's number is 3.3.
  const Frame frame = uniformFrame(20000, Vec3::Ones(), {true, true, true}, 0.01, {}, 9);
  const VoronoiCells cells = voronoiCells(frame, plainCells());
  CHECK(static_cast<double>(cells.face.size()) / 20000 == Approx(15.535).margin(4 * 3.3 / std::sqrt(20000)));
}

TEST_CASE("walls cut cells: planes exactly, curves with the square of the grain size", "[voronoi]") {
  SECTION("a box of walls in a larger domain") {
    Frame frame = uniformFrame(1000, Vec3(1, 1, 1.2), {false, false, false}, 0.02,
                               {sceneWall("box", {{"lower", Vec3(0, 0, 0)}, {"upper", Vec3(1, 1, 1.2)}})}, 3);
    frame.domain.lower = Vec3::Constant(-1);
    frame.domain.upper = Vec3::Constant(2);
    const VoronoiCells cells = voronoiCells(frame, {});
    CHECK(total(cells) == Approx(1.2).epsilon(1e-10));
    for (const auto& face : cells.face)
      CHECK(face.other != beyond::bound);
  }
  SECTION("a frustum") {
    // Base 1, top 0.5, height 1: pi / 3 (1 + 0.5 + 0.25) = 1.8326 (voro++'s own example).
    const double exact = std::numbers::pi / 3 * 1.75;
    const FrameWall wall = sceneWall("frustum", {{"base", Vec3(1, 1, 0)},
                                                 {"lower_radius", 1.0},
                                                 {"upper_radius", 0.5},
                                                 {"height", 1.0},
                                                 {"ends", std::string("both")}});
    double before = 0;
    for (const int n : {250, 2000, 16000}) {
      const Frame frame =
          uniformFrame(static_cast<std::size_t>(n), Vec3(2, 2, 1), {false, false, false}, 0.0, {wall}, 7);
      const double plain = total(voronoiCells(frame, plainCells(0))) / exact - 1;
      const double recut = total(voronoiCells(frame, plainCells())) / exact - 1;
      INFO(n << " points: tangent planes alone " << plain << ", recut " << recut);
      CHECK(plain > 0); // tangents lie outside
      CHECK(recut > 0);
      CHECK(recut < 0.1 * plain);
      // Eight times the points: half the distance, a quarter of the excess.
      if (before > 0) CHECK(before / plain == Approx(4).epsilon(0.35));
      before = plain;
    }
    CHECK(before < 0.003);
  }
}

TEST_CASE("the free surface ends cells", "[voronoi]") {
  // Simple cubic layers in an open box: the top cells are as high as the others, since the surface lies a
  // radius above the highest centres.
  Frame frame = simpleCubicFrame(5);
  frame.domain.periodic = {true, true, false};
  for (auto& x : frame.position)
    x.z() += 0.49;
  frame.domain.upper.z() = 20;
  frame.walls = {sceneWall("plane", {{"point", Vec3(0, 0, 0)}, {"normal", Vec3(0, 0, 1)}})};
  VoronoiOptions options;
  options.up = Vec3::UnitZ();
  options.diameter = 1;
  const VoronoiCells cells = voronoiCells(frame, options);
  for (std::size_t i = 0; i < frame.size(); ++i)
    CHECK(cells.volume[i] == Approx(1).epsilon(1e-10));
  CHECK(std::count(cells.atSurface.begin(), cells.atSurface.end(), 1) == 25);
  CHECK(std::count(cells.atWall.begin(), cells.atWall.end(), 1) == 25);
}

TEST_CASE("cells have the same bits for any number of threads", "[voronoi]") {
  const Frame frame = uniformFrame(3000, Vec3::Ones(), {true, false, true}, 0.01, {}, 5);
  VoronoiCells reference;
  for (const std::size_t threads : {1, 2, 3}) {
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const VoronoiCells cells = voronoiCells(frame, {});
    if (threads == 1) reference = cells;
    CHECK(cells.volume == reference.volume);
    CHECK(cells.start == reference.start);
  }
}

TEST_CASE("the k-gamma law is found again from its own numbers", "[voronoi]") {
  // Sums of 12 exponentials, scaled: k = 12 about the least volume 0.7 with the mean 0.8.
  RandomStream random(3, RandomPurpose::test, 4);
  std::vector<double> volumes;
  for (int n = 0; n < 20000; ++n) {
    double sum = 0;
    for (int e = 0; e < 12; ++e)
      sum -= std::log(random.uniform());
    volumes.push_back(0.7 + 0.1 * sum / 12);
  }
  const KGamma fit = fitKGamma(volumes, 0.7);
  CHECK(fit.kError < 0.2);
  CHECK(std::abs(fit.k - 12) < 4 * fit.kError);
  double integral = 0;
  for (int s = 0; s < 4000; ++s)
    integral += fit.density(0.7 + (s + 0.5) * 1e-4) * 1e-4;
  CHECK(integral == Approx(1).epsilon(1e-6));
}
