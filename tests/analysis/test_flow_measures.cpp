// Mixing and its floor, displacements, clumps, fabric and force chains on made-up frames.

#include "analysis/force_network.h"
#include "analysis/mixing.h"
#include "analysis/registry.h"
#include "tests/analysis/lattices.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace sandglass;
using namespace sandglass::analysis;
using namespace sandglass::analysis::test;

TEST_CASE("a shuffled mixture has the segregation index of its floor, a separated one is apart", "[flow]") {
  const Frame frame = uniformFrame(4000, Vec3::Constant(10), {false, false, false}, 0.1, {}, 3);
  RandomStream random(9, RandomPurpose::test, 0);
  std::vector<char> shuffled, apart;
  for (const auto& x : frame.position) {
    shuffled.push_back(random.uniform() < 0.3);
    apart.push_back(x.z() < 5);
  }
  const Mixing m = mixing(frame.position, shuffled, 2, 200, 1);
  CHECK(std::abs(m.index - m.floor) < 4 * m.floorDeviation);
  CHECK(m.lacey == Approx(1).margin(0.01));
  // Layers of cells 2 high: the border at 5 runs through the middle of the third. There x_c is x; all other
  // cells are pure: |x_c/x - 1| = 1 for x = 1/2 in 4 of 5 layers, and chance in the fifth.
  const Mixing a = mixing(frame.position, apart, 2.5, 200, 1);
  CHECK(a.index == Approx(1).margin(0.05));
  CHECK(a.lacey == Approx(0).margin(0.01));
  CHECK_THROWS(mixing(frame.position, std::vector<char>(4000, 1), 2, 10, 1));
}

TEST_CASE("random steps diffuse with their known rate, drift and periods taken away", "[flow]") {
  // 2000 grains, 40 steps of variance 0.01 in each direction every 0.5 s, in a periodic box of 3, drifting
  // along x: <r^2> = 3 0.01 per step = 6 D 0.5, D = 0.01.
  RandomStream random(4, RandomPurpose::test, 0);
  Frame frame = uniformFrame(2000, Vec3::Constant(3), {true, true, true}, 0.05, {}, 3);
  std::vector<FramePtr> frames;
  for (int s = 0; s < 40; ++s) {
    frame.time = 0.5 * s;
    frames.push_back(std::make_shared<Frame>(frame));
    for (auto& x : frame.position)
      for (int k = 0; k < 3; ++k) {
        x[k] += 0.1 * random.normal() + (k == 0 ? 0.3 : 0);
        x[k] -= 3 * std::floor(x[k] / 3);
      }
  }
  const AnalysisKind& kind = analysisKind("motion");
  const Results r = analyze(kind, defaultKnobs(kind), {}, frames);
  CHECK(r.curves[0].series[0].y[0] == Approx(0.03).epsilon(0.02));
  CHECK(r.curves[0].numbers.at("diffusion") == Approx(0.01).epsilon(0.1));
}

TEST_CASE("falling grains that step aside have their diffusion length", "[flow]") {
  // 2000 grains, in each of 60 frames half a diameter down and a normal step of variance 0.02 d^2 along x,
  // 0.005 d^2 along y: <s^2> = 2 b h, so b = 0.02 / (2 0.5) = 0.02 d and 0.005 d.
  RandomStream random(11, RandomPurpose::test, 0);
  Frame frame = uniformFrame(2000, Vec3(50, 50, 50), {false, false, false}, 0.5, {}, 3);
  std::vector<FramePtr> frames;
  for (int s = 0; s < 60; ++s) {
    frame.time = s;
    frames.push_back(std::make_shared<Frame>(frame));
    for (auto& x : frame.position)
      x += Vec3(std::sqrt(0.02) * random.normal(), std::sqrt(0.005) * random.normal(), -0.5);
  }
  AnalysisContext context;
  context.facts.up = Vec3::UnitZ();
  context.diameter = 1;
  const AnalysisKind& kind = analysisKind("motion");
  const Results r = analyze(kind, defaultKnobs(kind), context, frames);
  const auto found = std::find_if(r.curves.begin(), r.curves.end(),
                                  [](const Curve& c) { return c.name == "diffusion_length"; });
  REQUIRE(found != r.curves.end());
  std::vector<double> b{found->numbers.at("b_first"), found->numbers.at("b_second")};
  std::sort(b.begin(), b.end());
  // Later variances hold earlier ones: the slope scatters by some 3 % of sqrt(2 / 2000) each, times a few.
  CHECK(b[0] == Approx(0.005).epsilon(0.1));
  CHECK(b[1] == Approx(0.02).epsilon(0.1));
}

TEST_CASE("the angle of a heap of grains on a slope, about a plane and about an axis", "[flow]") {
  // Level rows below a surface that rises outwards with tan = 0.4: z = 5 + 0.4 |x|, and around an axis.
  AnalysisContext context;
  context.facts.up = Vec3::UnitZ();
  context.facts.outletCentre = Vec3(0, 0, 0);
  context.diameter = 1;
  const AnalysisKind& kind = analysisKind("surface_angle");
  for (const bool round : {false, true}) {
    Frame frame;
    RandomStream random(5, RandomPurpose::test, round);
    for (int i = 0; i < 200000; ++i) {
      const Vec3 x(random.uniform(-25, 25), random.uniform(-25, 25), random.uniform(0, 16));
      if (x.z() > 5 + 0.4 * (round ? x.head<2>().norm() : std::abs(x.x()))) continue;
      frame.id.push_back(i);
      frame.position.push_back(x);
    }
    frame.scalars[quantity::radius] = std::vector<double>(frame.size(), 0.5);
    Parameters knobs = defaultKnobs(kind);
    knobs.set("across", std::string("x"));
    if (round) knobs.set("distance", std::string("axis"));
    const Results r = analyze(kind, knobs, context, {std::make_shared<Frame>(frame)});
    // Each top is that of the bin's outer edge, less the gap of random points: the slope is kept.
    CHECK(r.curves.at(0).numbers.at("angle") == Approx(std::atan(0.4) * 180 / std::numbers::pi).margin(0.5));
  }
}

TEST_CASE("velocities of one direction in each half are correlated near and not far", "[flow]") {
  // All grains of a layer (z < 1.5 or above) share a velocity: C = 1 within a layer.
  Frame frame = crystal(Vec3::Constant(1.1), simpleCubic, {4, 4, 4});
  for (const auto& x : frame.position)
    frame.vectors[quantity::velocity].push_back(x.z() < 2 ? Vec3(1, 0, 0) : Vec3(-1, 0, 0));
  const AnalysisKind& kind = analysisKind("motion");
  Frame later = frame;
  later.time = 1;
  const Results r =
      analyze(kind, defaultKnobs(kind), {}, {std::make_shared<Frame>(frame), std::make_shared<Frame>(later)});
  const Curve* c = nullptr;
  for (const auto& curve : r.curves)
    if (curve.name == "velocity_correlation") c = &curve;
  REQUIRE(c);
  // Nearest neighbours: four of six in the layer itself, one up and one down, one of them of the other half:
  // (4 + 1 - 1) / 6.
  CHECK(c->series[0].x[0] == Approx(1.125));
  CHECK(c->series[0].y[0] == Approx(2.0 / 3).epsilon(1e-12));
}

TEST_CASE("clumps are connected groups", "[flow]") {
  // A chain of four across a periodic border, a pair, and a lone grain.
  Frame frame = frameOf({Vec3(9.5, 5, 5), Vec3(0.5, 5, 5), Vec3(1.5, 5, 5), Vec3(8.5, 5, 5), Vec3(5, 5, 5),
                         Vec3(5, 6, 5), Vec3(5, 5, 9)},
                        Vec3::Constant(10), {true, true, true}, 0.5);
  const AnalysisKind& kind = analysisKind("clumps");
  const Results r = analyze(kind, defaultKnobs(kind), {}, {std::make_shared<Frame>(frame)});
  CHECK(r.grains[1].values == std::vector<double>{4, 4, 4, 4, 2, 2, 1});
  CHECK(r.curves[1].series[0].y[0] == 4);
  CHECK(r.curves[0].series[0].y == std::vector<double>{1.0 / 7, 2.0 / 7, 4.0 / 7});
}

TEST_CASE("clumps below an outlet: joined by bridges, apart from the stream", "[flow]") {
  // The outlet is at z = 6. Three grains hang on the stream, from 6.6 down to 4.2; below, a pair with a
  // liquid bridge across a gap of 0.2, and a pair as near as that without one. (Anand 2009: the largest clump
  // below.)
  Frame frame = frameOf({Vec3(5, 5, 6.6), Vec3(5, 5, 5.4), Vec3(5, 5, 4.2), Vec3(2, 2, 2), Vec3(3.2, 2, 2),
                         Vec3(7, 2, 2), Vec3(8.2, 2, 2)},
                        Vec3::Constant(10), {false, false, false}, 0.5);
  const auto bridge = [](std::int64_t a, std::int64_t b) {
    FrameContact c;
    c.a = a;
    c.b = b;
    c.overlap = -0.2;
    return c;
  };
  frame.contacts = {bridge(0, 1), bridge(1, 2), bridge(3, 4)};
  const AnalysisKind& kind = analysisKind("clumps");
  AnalysisContext context;
  context.limits.upper.z() = 6 - 1; // a diameter below the outlet
  const auto sizes = [&](const char* links, const char* whole) {
    Parameters knobs = defaultKnobs(kind);
    setKnob(knobs, kind, "links", links);
    setKnob(knobs, kind, "whole", whole);
    std::vector<double> values =
        analyze(kind, knobs, context, {std::make_shared<Frame>(frame)}).grains[1].values;
    for (double& v : values)
      if (std::isnan(v)) v = 0;
    return values;
  };
  CHECK(sizes("contacts", "true") == std::vector<double>{0, 0, 0, 2, 2, 1, 1});
  CHECK(sizes("contacts", "false") == std::vector<double>{0, 0, 1, 2, 2, 1, 1});
  CHECK(sizes("gaps", "true") == std::vector<double>{0, 0, 1, 1, 1, 1, 1});
}

TEST_CASE("fabric of known directions", "[flow]") {
  Frame frame = frameOf({Vec3(1, 1, 1), Vec3(1, 1, 2)}, Vec3::Constant(5), {false, false, false}, 0.5);
  const auto contact = [](const Vec3& n, double f) {
    FrameContact c;
    c.a = 0;
    c.b = 1;
    c.normal = n;
    c.force = f * n;
    return c;
  };
  frame.contacts = {contact(Vec3::UnitZ(), 1)};
  CHECK(anisotropy(fabric(frame, false)) == Approx(1));
  frame.contacts = {contact(Vec3::UnitX(), 1), contact(Vec3::UnitY(), 1), contact(Vec3::UnitZ(), 2)};
  CHECK(anisotropy(fabric(frame, false)) == Approx(0).margin(1e-12));
  CHECK(fabric(frame, true)(2, 2) == Approx(0.5));
}

TEST_CASE("a loaded column is one force chain, loose neighbours are none of it", "[flow]") {
  std::vector<Vec3> points;
  for (int k = 0; k < 6; ++k)
    points.push_back(Vec3(2, 2, 0.5 + k));
  points.push_back(Vec3(3, 2, 0.5));
  Frame frame = frameOf(points, Vec3::Constant(8), {false, false, false}, 0.5);
  for (int k = 0; k + 1 < 6; ++k) {
    FrameContact c;
    c.a = k + 1;
    c.b = k;
    c.normal = Vec3::UnitZ();
    c.force = 10 * c.normal;
    frame.contacts.push_back(c);
  }
  FrameContact side;
  side.a = 6;
  side.b = 0;
  side.normal = Vec3::UnitX();
  side.force = 0.1 * side.normal;
  frame.contacts.push_back(side);
  const auto chains = forceChains(frame, std::numbers::pi / 4);
  // The two ends carry half of the others (one contact): 10 against a mean of (2 10 + 4 20 + 0.1) / 7 = 14.3.
  REQUIRE(chains.size() == 1);
  CHECK(chains[0].grains == std::vector<std::size_t>{1, 2, 3, 4});
}
