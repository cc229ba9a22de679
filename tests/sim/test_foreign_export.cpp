// LAMMPS dumps and extended XYZ: what is written is read back.

#include "sim/io/foreign_export.h"
#include "tests/sim/temporary_folder.h"

#include <catch2/catch.hpp>

#include <cstring>

using namespace sandglass;
using namespace sandglass::test;

namespace {

class OneFrame final : public FrameSource {
public:
  explicit OneFrame(Frame frame) : frame_(std::make_shared<const Frame>(std::move(frame))) {}
  std::size_t size() const override { return 2; }
  double time(std::size_t) const override { return frame_->time; }
  FramePtr load(std::size_t) const override { return frame_; }
  std::string name() const override { return "one"; }

private:
  FramePtr frame_;
};

/// Spheres and a superellipsoid, numbers with all their digits.
Frame sample() {
  Frame frame;
  frame.time = 0.1 + 0.2;
  frame.step = 12345678901;
  frame.id = {2, 5, 1000000007};
  frame.position = {{1.0 / 3, -2e-5, 0}, {1e-17, 2.0 / 3, 1}, {0.7, 0.8, 0.9}};
  frame.scalars[quantity::radius] = {0.1, 0.2, std::cbrt(0.1 * 0.2 * 0.3)};
  frame.scalars[quantity::species] = {1, 0, 1};
  frame.scalars[quantity::shape] = {-1, -1, 0};
  frame.scalars["heat"] = {1.0 / 7, 2, 3};
  frame.shapes = {{Vec3(0.1, 0.2, 0.3), 1, 1}};
  frame.speciesNames = {"glass", "steel"};
  frame.vectors[quantity::velocity] = {{1, 2, 3}, {4, 5, 1.0 / 3}, {0, 0, 0}};
  frame.vectors[quantity::spin] = {{1, 2, 3}, {4, 5, 6}, {-1, 0, 0}};
  frame.vectors["pull"] = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
  for (int k = 0; k < 3; ++k)
    frame.orientation.emplace_back(Eigen::AngleAxisd(0.3 * k, Vec3(1, 2, 3).normalized()));
  frame.domain.lower = Vec3(-1, -1, -0.1);
  frame.domain.upper = Vec3(1, 1, 2.1);
  frame.domain.periodic = {true, false, false};
  return frame;
}

void requireSame(const Frame& a, const Frame& b) {
  CHECK(a.time == b.time);
  CHECK(a.step == b.step);
  CHECK(a.id == b.id);
  CHECK(a.position == b.position);
  CHECK(a.speciesNames == b.speciesNames);
  CHECK(a.domain.lower == b.domain.lower);
  CHECK((a.domain.upper - b.domain.upper).norm() < 1e-15); // XYZ gives the edges
  CHECK(a.domain.periodic == b.domain.periodic);
  for (const auto& [name, values] : b.scalars) {
    INFO(name);
    for (std::size_t k = 0; k < values.size(); ++k)
      CHECK(a.scalar(name)[k] == Approx(values[k]).epsilon(1e-15));
  }
  CHECK(a.scalars.size() == b.scalars.size());
  CHECK(a.vectors == b.vectors);
  REQUIRE(a.shapes.size() == 1);
  CHECK(a.shapes[0].semiAxes == b.shapes[0].semiAxes);
  REQUIRE(a.orientation.size() == 3);
  for (std::size_t k = 0; k < 3; ++k)
    CHECK(a.orientation[k].angularDistance(b.orientation[k]) < 1e-15);
}

} // namespace

TEST_CASE("A LAMMPS dump that is written is read back", "[io][export]") {
  const TemporaryFolder folder("dump");
  OneFrame source(sample());
  exportLammpsDump(source, 0, 2, folder / "a.dump");
  const auto read = openFrames(folder / "a.dump");
  read->refresh();
  REQUIRE(read->size() == 2);
  requireSame(*read->load(1), sample());
}

TEST_CASE("Extended XYZ that is written is read back", "[io][export]") {
  const TemporaryFolder folder("xyz");
  OneFrame source(sample());
  exportExtendedXyz(source, 0, 2, folder / "a.xyz");
  const auto read = openFrames(folder / "a.xyz");
  read->refresh();
  REQUIRE(read->size() == 2);
  Frame due = sample();
  requireSame(*read->load(0), due);
}
