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
