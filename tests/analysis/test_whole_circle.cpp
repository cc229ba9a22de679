// A wedge as the whole circle: images, contacts across the faces, paths, and what analyses see.

#include "analysis/registry.h"
#include "analysis/whole_circle.h"
#include "sim/base/random.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace sandglass;
using namespace sandglass::analysis;

namespace {

constexpr double pi = std::numbers::pi;

Vec3 at(double radius, double degrees, double z) {
  return {radius * std::cos(degrees * pi / 180), radius * std::sin(degrees * pi / 180), z};
}

} // namespace

TEST_CASE("A wedge's grains, vectors and contacts as the whole circle", "[wedge]") {
  Frame frame;
  frame.id = {3, 8};
  // Quarter circle about z. 3 is at 1 degree, 8 at 89: 8 turned back by a quarter lies 2 degrees before 3.
  frame.position = {at(5, 1, 0), at(5, 89, 0)};
  frame.scalars[quantity::radius] = {0.1, 0.1};
  frame.vectors[quantity::velocity] = {Vec3(1, 0, 0), Vec3(0, 2, 0)};
  FrameContact contact;
  contact.a = 3;
  contact.b = 8;
  contact.image = {3, 0, 0}; // three quarters on, as good as one back
  contact.point = at(5, 0, 0);
  contact.force = Vec3(0, 1, 0);
  frame.contacts.push_back(contact);
  WholeCircle circle(Sector(4, 2));
  const Frame whole = circle.add(frame);
  REQUIRE(whole.size() == 8);
  CHECK(whole.id[0] == 3);
  CHECK(whole.id[2] - whole.id[0] == std::int64_t{1} << 40);
  CHECK(whole.position[2].isApprox(at(5, 91, 0)));
  CHECK(whole.vector(quantity::velocity)[2].isApprox(Vec3(0, 1, 0)));
  CHECK(whole.vector(quantity::velocity)[7].isApprox(Vec3(2, 0, 0)));
  REQUIRE(whole.contacts.size() == 4);
  for (const auto& c : whole.contacts) {
    const auto place = [&](std::int64_t id) {
      return whole.position[static_cast<std::size_t>(std::find(whole.id.begin(), whole.id.end(), id) -
                                                     whole.id.begin())];
    };
    // The chord of two degrees.
    CHECK((place(c.a) - place(c.b)).norm() == Approx(2 * 5 * std::sin(pi / 180)));
    CHECK((0.5 * (place(c.a) + place(c.b)).normalized() - 0.5 * c.point.normalized()).norm() < 1e-12);
    CHECK(c.image == std::array<int, 3>{0, 0, 0});
  }
}

TEST_CASE("A grain that goes round the wedge's axis has a path without jumps", "[wedge]") {
  WholeCircle circle(Sector(6, 2));
  for (int k = 0; k < 80; ++k) {
    Frame frame;
    frame.id = {1};
    frame.position = {at(2, std::fmod(10.0 * k, 60.0), 0)}; // ten degrees a frame, kept in the sector
    frame.scalars[quantity::radius] = {0.1};
    const Frame whole = circle.add(frame);
    CHECK(whole.position[0].isApprox(at(2, 10.0 * k, 0), 1e-9));
  }
}

TEST_CASE("Uniform points of a wedge have g = 1 in the circle, their own values stay theirs", "[wedge]") {
  // A quarter of a square of 16 by 16 about the axis, which turns into itself.
  Frame frame;
  RandomStream random(7, RandomPurpose::test, 0);
  constexpr std::size_t grains = 3000;
  for (std::size_t i = 0; i < grains; ++i) {
    frame.id.push_back(static_cast<std::int64_t>(i));
    frame.position.push_back({random.uniform(0, 8), random.uniform(0, 8), random.uniform(0, 16)});
  }
  frame.scalars[quantity::radius] = std::vector<double>(grains, 0.5);
  frame.domain.upper = Vec3(8, 8, 16);
  frame.domain.lower = Vec3(-8, -8, 0);
  AnalysisContext context;
  context.facts.sector = Sector(4, 2);
  const AnalysisKind& kind = analysisKind("gr");
  Parameters knobs = defaultKnobs(kind);
  knobs.set("bins", std::int64_t{20});
  const Results results = analyze(kind, knobs, context, {std::make_shared<Frame>(frame)});
  const Series& g = results.curves.at(0).series.at(0);
  // Counts of the four images are one sample: errors are twice those said, and images of near ones agree.
  for (std::size_t b = 4; b < g.y.size(); ++b)
    CHECK(std::abs(g.y[b] - 1) < 4 * 2 * g.error[b]);
  CHECK(results.curves[0].definition.find("of a wedge") != std::string::npos);

  const AnalysisKind& contacts = analysisKind("coordination");
  const Results own = analyze(contacts, defaultKnobs(contacts), context, {std::make_shared<Frame>(frame)});
  REQUIRE_FALSE(own.grains.empty());
  CHECK(own.grains[0].values.size() == grains);
}
