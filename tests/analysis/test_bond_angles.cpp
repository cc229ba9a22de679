// Angles of lattices, exactly; random directions, statistically.

#include "analysis/registry.h"
#include "analysis/statistics.h"
#include "tests/analysis/lattices.h"

#include <catch2/catch.hpp>

using namespace sandglass;
using namespace sandglass::analysis;
using namespace sandglass::analysis::test;

namespace {

/// Angles per grain near `degrees`, from the density.
double anglesPerGrain(const Curve& c, std::size_t grains, double degrees) {
  double share = 0;
  const double width = c.series[0].x[1] - c.series[0].x[0];
  for (std::size_t b = 0; b < c.series[0].x.size(); ++b)
    if (std::abs(c.series[0].x[b] - degrees) < 1) share += c.series[0].y[b] * width;
  return share * c.numbers.at("angles") / static_cast<double>(grains);
}

Curve angles(const Frame& frame, const std::string& cutoff) {
  const AnalysisKind& kind = analysisKind("bond_angles");
  Parameters knobs = defaultKnobs(kind);
  setKnob(knobs, kind, "cutoff", cutoff);
  setKnob(knobs, kind, "bins", "360");
  return analyze(kind, knobs, {}, {std::make_shared<Frame>(frame)}).curves.front();
}

} // namespace

TEST_CASE("bond angles of lattices", "[angles]") {
  struct Case {
    const char* name;
    Frame frame;
    const char* cutoff;
    std::vector<std::pair<double, double>> lines; ///< degrees, pairs per grain: elementary geometry
  };
  const auto test =
      GENERATE(values<Case>({{"sc", simpleCubicFrame(), "1.2", {{90, 12}, {180, 3}}},
                             {"fcc", faceCentredFrame(), "1.2", {{60, 24}, {90, 12}, {120, 24}, {180, 6}}},
                             // First shell of eight.
                             {"bcc", bodyCentredFrame(), "1.1", {{70.5288, 12}, {109.4712, 12}, {180, 4}}},
                             {"hcp",
                              hexagonalFrame(),
                              "1.2",
                              {{60, 24}, {90, 12}, {109.4712, 3}, {120, 18}, {146.4427, 6}, {180, 3}}}}));
  const Curve c = angles(test.frame, test.cutoff);
  double sum = 0;
  for (const auto& [degrees, pairs] : test.lines) {
    INFO(test.name << " at " << degrees);
    CHECK(anglesPerGrain(c, test.frame.size(), degrees) == Approx(pairs).epsilon(1e-12));
    sum += pairs;
  }
  CHECK(c.numbers.at("angles") == sum * static_cast<double>(test.frame.size())); // and no others
}

TEST_CASE("the first minimum is the default cut-off, and is stated", "[angles]") {
  // Between the shells at 1 and sqrt(2) g is 0: the middle of that gap.
  const Frame frame = faceCentredFrame(5);
  const Curve c = angles(frame, "0");
  CHECK(c.numbers.at("neighbours") == 12);
  CHECK_THAT(c.definition, Catch::Contains("the first minimum of g(r)"));
}

TEST_CASE("angles by species add up", "[angles]") {
  // Sodium chloride: a simple cubic lattice whose neighbours are all of the other kind.
  Frame frame = simpleCubicFrame();
  std::vector<double> species;
  for (const auto& x : frame.position)
    species.push_back(static_cast<int>(std::floor(x.x()) + std::floor(x.y()) + std::floor(x.z())) % 2);
  frame.scalars[quantity::species] = species;
  frame.speciesNames = {"a", "b"};
  const Curve c = angles(frame, "1.2");
  REQUIRE(c.series.size() == 3);
  CHECK(c.series[1].name == "a-(b)-a");
  CHECK(c.series[2].name == "b-(a)-b");
  CHECK(c.series[1].y == c.series[0].y);
}

TEST_CASE("random points have random angles", "[angles]") {
  // P over sin / 2 is 1. The three angles of a triangle depend on each other, so the error comes from the
  // scatter of 15 frames: each bin is a Student variable of 14 degrees of freedom; the limit has one chance
  // in 10^5.
  std::vector<FramePtr> frames;
  for (std::uint64_t seed = 0; seed < 15; ++seed)
    frames.push_back(
        std::make_shared<Frame>(uniformFrame(1000, Vec3::Ones(), {true, true, true}, 0.01, {}, 11 + seed)));
  const AnalysisKind& kind = analysisKind("bond_angles");
  Parameters knobs = defaultKnobs(kind);
  knobs.set("cutoff", 7.0);
  knobs.set("bins", std::int64_t{18});
  const Results results = analyze(kind, knobs, {}, frames);
  for (const std::size_t which : {1, 2}) {
    const Series& s = results.curves[which].series[0];
    for (std::size_t b = 0; b < 18; ++b) {
      INFO(results.curves[which].name << " bin " << b << ": " << s.y[b] << " +- " << s.error[b]);
      CHECK(std::abs(s.y[b] - (which == 1 ? 1 : 0.5)) < studentFactor(1 - 1e-5, 14) * s.error[b]);
      CHECK(s.error[b] < 0.05);
    }
  }
}
