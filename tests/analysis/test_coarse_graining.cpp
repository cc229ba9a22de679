// Coarse graining: exact totals, uniform shear, stress of one contact, the image file.

#include "analysis/coarse_graining.h"
#include "analysis/registry.h"
#include "tests/analysis/lattices.h"

#include <catch2/catch.hpp>

#include <numbers>

using namespace sandglass;
using namespace sandglass::analysis;
using namespace sandglass::analysis::test;

namespace {

std::vector<Vec3> nodes(const Vec3& size, int n) {
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k)
        points.push_back(size.cwiseProduct(Vec3(i, j, k)) / n);
  return points;
}

} // namespace

TEST_CASE("mass and momentum on a fine grid are those of the grains", "[fields]") {
  Frame frame = uniformFrame(50, Vec3(4, 5, 6), {true, true, true}, 0.5, {}, 3);
  RandomStream random(1, RandomPurpose::test, 0);
  for (std::size_t i = 0; i < 50; ++i) {
    frame.scalars[quantity::mass].push_back(random.uniform(1, 2));
    frame.vectors[quantity::velocity].push_back(random.direction());
  }
  double mass = 0;
  Vec3 momentum = Vec3::Zero();
  for (std::size_t i = 0; i < 50; ++i) {
    mass += frame.scalars[quantity::mass][i];
    momentum += frame.scalars[quantity::mass][i] * frame.vectors[quantity::velocity][i];
  }
  const CoarseGrainer grainer(frame, 1, 1, 1);
  double sum = 0;
  Vec3 p = Vec3::Zero();
  const auto points = nodes(Vec3(4, 5, 6), 32);
  for (const auto& a : grainer.at(points)) {
    sum += a.mass * 120 / static_cast<double>(points.size());
    p += a.momentum * 120 / static_cast<double>(points.size());
  }
  // The kernel has two continuous derivatives at its end: the trapezoidal sum is good to a part in ten
  // thousand.
  CHECK(sum == Approx(mass).epsilon(1e-4));
  CHECK((p - momentum).norm() < 1e-3);
}

TEST_CASE("a uniform flow gradient is found", "[fields]") {
  // u = (2 z, 0, 0) and a spin about z of 3, on a dense lattice: gradient (0 -3 2; 3 0 0; 0 0 0).
  Eigen::Matrix3d gradient;
  gradient << 0, -3, 2, 3, 0, 0, 0, 0, 0;
  Frame frame = crystal(Vec3::Constant(0.5), simpleCubic, {24, 24, 24}, 0.25);
  frame.domain.periodic = {false, false, false};
  for (const auto& x : frame.position)
    frame.vectors[quantity::velocity].push_back(gradient * x);
  const CoarseGrainer grainer(frame, 1.5, 0.5, 2500);
  const std::vector<Vec3> middle{Vec3(6.1, 5.9, 6.03)};
  const CoarseAverage a = grainer.at(middle)[0];
  CHECK((a.velocityGradient() - gradient).norm() < 0.01);
  CHECK((a.vorticity() - Vec3(0, 2, 6)).norm() < 0.01);
  CHECK(a.shearRate() == Approx(2).epsilon(0.005));
  CHECK((a.velocity() - gradient * middle[0]).norm() < 0.01);
  CHECK(a.volume == Approx(std::numbers::pi / 6).epsilon(0.005));
  CHECK(a.mass == Approx(2500 * std::numbers::pi / 6).epsilon(0.005));
}

TEST_CASE("the stress of one contact integrates to force times branch", "[fields]") {
  Frame frame = frameOf({Vec3(2, 2, 2), Vec3(2, 2, 3)}, Vec3::Constant(5), {true, true, true}, 0.5);
  frame.vectors[quantity::velocity] = {Vec3::Zero(), Vec3::Zero()};
  FrameContact contact;
  contact.a = 1;
  contact.b = 0;
  contact.force = Vec3(0.5, 0, 7); // pushes the upper grain up
  contact.point = Vec3(2, 2, 2.5);
  frame.contacts = {contact};
  const CoarseGrainer grainer(frame, 1, 1, 1);
  Eigen::Matrix3d total = Eigen::Matrix3d::Zero();
  const auto points = nodes(Vec3::Constant(5), 30);
  for (const auto& a : grainer.at(points))
    total += a.contactStress * 125 / static_cast<double>(points.size());
  Eigen::Matrix3d expected = Eigen::Matrix3d::Zero();
  expected(2, 2) = 7;
  expected(0, 2) = expected(2, 0) = 0.25; // the symmetric part
  CHECK((total - expected).norm() < 2e-3);
}

TEST_CASE("the temperature of a gas", "[fields]") {
  // Velocities of unit variance in each direction: T_g is 1, less what a mean over so few grains takes away.
  Frame frame = uniformFrame(20000, Vec3::Constant(20), {true, true, true}, 0.5, {}, 3);
  RandomStream random(5, RandomPurpose::test, 0);
  for (std::size_t i = 0; i < frame.size(); ++i)
    frame.vectors[quantity::velocity].push_back(Vec3(random.normal(), random.normal(), random.normal()));
  const CoarseGrainer grainer(frame, 4, 1, 1);
  double sum = 0;
  const auto points = nodes(Vec3::Constant(20), 5);
  for (const auto& a : grainer.at(points))
    sum += a.temperature() / static_cast<double>(points.size());
  CHECK(sum == Approx(1).epsilon(0.02)); // about 600 grains in each kernel
}

TEST_CASE("fields as VTK image data", "[fields]") {
  Frame frame = simpleCubicFrame(3);
  frame.vectors[quantity::velocity].assign(frame.size(), Vec3(0, 0, -1));
  const AnalysisKind& kind = analysisKind("fields");
  const Results r = analyze(kind, defaultKnobs(kind), {}, {std::make_shared<Frame>(frame)});
  REQUIRE(r.fields.size() == 1);
  CHECK(r.fields[0].count == std::array<int, 3>{3, 3, 3});
  CHECK(r.fields[0].vectors.at("velocity")[13].z() == Approx(-1));
  const std::string text = toVti(r.fields[0]);
  CHECK_THAT(text, Catch::Contains("WholeExtent=\"0 2 0 2 0 2\"") &&
                       Catch::Contains("Name=\"granular_temperature\"") &&
                       Catch::Contains("header_type=\"UInt64\""));
  // The first double of a small array: 8 bytes of length (8 = one value), then 1.0, in base64.
  Field one;
  one.name = "one";
  one.scalars["a"] = {1.0};
  CHECK_THAT(toVti(one), Catch::Contains("CAAAAAAAAAAAAAAAAADwPw=="));
}

TEST_CASE("profiles of fields at given heights and distances", "[fields]") {
  // A simple cubic lattice of spacing 0.5 that falls with 1 + 2 (x - 6) + 0.25 z: a kernel that is even about
  // its middle finds a linear velocity exactly, up to the lattice's grain. Four frames, faster and slower in
  // turn by a tenth: their mean has the standard error 0.1 sqrt(4 / 3) / sqrt(4) of its value.
  const Frame lattice = crystal(Vec3::Constant(0.5), simpleCubic, {24, 24, 24}, 0.25);
  std::vector<FramePtr> frames;
  for (const double factor : {0.9, 1.1, 0.9, 1.1}) {
    Frame frame = lattice;
    frame.domain.periodic = {false, false, false};
    frame.time = static_cast<double>(frames.size());
    for (const auto& x : frame.position)
      frame.vectors[quantity::velocity].push_back(Vec3(0, 0, -factor * (1 + 2 * (x.x() - 6) + 0.25 * x.z())));
    frames.push_back(std::make_shared<Frame>(std::move(frame)));
  }
  const AnalysisKind& kind = analysisKind("fields");
  Parameters knobs = defaultKnobs(kind);
  setKnob(knobs, kind, "width", "3");
  setKnob(knobs, kind, "heights", "9.3,14"); // diameters of 0.5
  setKnob(knobs, kind, "radii", "-4,0,3");
  setKnob(knobs, kind, "across", "x");
  AnalysisContext context;
  context.facts.outletCentre = Vec3(6, 6, 0);
  const Results r = analyze(kind, knobs, context, frames);
  const auto curveOf = [&](const std::string& name) {
    for (const auto& c : r.curves)
      if (c.name == name) return c;
    FAIL("no curve " << name);
    return Curve{};
  };
  // Away from the lattice's ends, where the kernel is cut.
  const auto inside = [](double x) { return x > 3.1 && x < 8.9; };
  const Curve across = curveOf("velocity_at_heights");
  REQUIRE(across.series.size() == 2);
  CHECK(across.series[0].name == "height 4.65 m");
  CHECK(across.frames == 4);
  int seen = 0;
  for (std::size_t s = 0; s < 2; ++s)
    for (std::size_t k = 0; k < across.series[s].x.size(); ++k) {
      const double x = across.series[s].x[k], z = s == 0 ? 4.65 : 7;
      if (!inside(6 + x)) continue;
      const double expected = 1 + 2 * x + 0.25 * z;
      CHECK(across.series[s].y[k] == Approx(expected).margin(0.01));
      CHECK(across.series[s].error[k] ==
            Approx(0.1 * std::sqrt(4.0 / 3) / 2 * std::abs(across.series[s].y[k])).epsilon(1e-6));
      ++seen;
    }
  CHECK(seen == 2 * 11); // x - 6 = -2.5, -2, ... 2.5
  const Curve up = curveOf("velocity_at_radii");
  REQUIRE(up.series.size() == 3);
  for (std::size_t s = 0; s < 3; ++s)
    for (std::size_t k = 0; k < up.series[s].x.size(); ++k)
      if (inside(up.series[s].x[k]))
        CHECK(up.series[s].y[k] ==
              Approx(1 + 2 * std::array{-2.0, 0.0, 1.5}[s] + 0.25 * up.series[s].x[k]).margin(0.01));
  CHECK(curveOf("shear_rate_at_heights").series[0].y[12] == Approx(std::hypot(2, 0.25)).epsilon(0.01));

  // From an axis: rings; the same flow's mean over a ring is the value at the axis.
  setKnob(knobs, kind, "across", "axis");
  const Results rings = analyze(kind, knobs, context, frames);
  for (const auto& c : rings.curves) {
    if (c.name == "velocity_at_heights")
      for (std::size_t k = 0; k < c.series[0].x.size() && c.series[0].x[k] < 2.9; ++k)
        CHECK(c.series[0].y[k] == Approx(1 + 0.25 * 4.65).margin(0.01));
    if (c.name == "packing_fraction_at_radii") // at the axis alone
      CHECK(c.series[1].y[12] == Approx(std::numbers::pi / 6).epsilon(0.005));
  }
  // A line above all grains is told: the highest lie at 11.5 m, their cells end at 11.75 m.
  setKnob(knobs, kind, "heights", "9.3,40");
  const Results high = analyze(kind, knobs, context, frames);
  CHECK_THAT(high.sentences.back(), Catch::Contains("no grains are there: height 20 m ("));
  setKnob(knobs, kind, "across", "z");
  CHECK_THROWS_WITH(analyze(kind, knobs, context, frames), Catch::Contains("direction of up"));
}
