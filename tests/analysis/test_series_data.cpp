#include "analysis/run_facts.h"
#include "analysis/series_data.h"
#include "sim/base/error.h"
#include "tests/analysis/containers.h"

#include <catch2/catch.hpp>

#include <numbers>

using namespace sandglass;
using namespace sandglass::analysis;
using namespace sandglass::analysis::test;

namespace {

/// Frames in memory, one a second.
class Frames : public FrameSource {
public:
  explicit Frames(std::vector<std::size_t> grains, bool masses) {
    for (std::size_t f = 0; f < grains.size(); ++f) {
      auto frame = std::make_shared<Frame>(
          frameOf(std::vector<Vec3>(grains[f], Vec3::Zero()), Vec3::Ones(), {false, false, false}, 0.5));
      frame->time = static_cast<double>(f);
      if (masses) frame->scalars[quantity::mass] = std::vector<double>(grains[f], 2.0);
      frames_.push_back(frame);
    }
  }
  std::size_t size() const override { return frames_.size(); }
  double time(std::size_t index) const override { return frames_[index]->time; }
  FramePtr load(std::size_t index) const override { return frames_[index]; }
  std::string name() const override { return "frames"; }

private:
  std::vector<FramePtr> frames_;
};

} // namespace

TEST_CASE("discharge from frames counts from the fullest one", "[series]") {
  const auto data = dischargeOf(Frames({3, 5, 5, 4, 1}, true));
  CHECK(data.time == std::vector<double>{2, 3, 4}); // the last of the fullest frames
  CHECK(data.mass == std::vector<double>{0, 2, 8});
  const auto spheres = dischargeOf(Frames({5, 4}, false), 3000);
  CHECK(spheres.mass.back() == Approx(3000 * std::numbers::pi / 6));
  CHECK_THROWS_WITH(dischargeOf(Frames({5, 4}, false)), Catch::Contains("no scalar 'mass'"));
}

TEST_CASE("probes of a series become curves", "[series]") {
  const SeriesColumns columns{
      {"out.mass", {{0, 1}, {0, 3}}}, {"e.total", {{0, 1}, {5, 4}}}, {"e.elastic", {{0, 1}, {2, 1}}}};
  CHECK(dischargeOf(columns, "out", "series.csv").mass == std::vector<double>{0, 3});
  CHECK_THROWS_WITH(dischargeOf(columns, "gone", "series.csv"), Catch::Contains("no column 'gone.mass'"));
  const Curve curve = energyCurve(columns, "e", "series.csv");
  REQUIRE(curve.series.size() == 2);
  CHECK(curve.series[0].name == "elastic");
  CHECK(curve.series[1].y == std::vector<double>{5, 4});
  CHECK_THROWS_AS(energyCurve(columns, "out2", "series.csv"), InputError);
}

TEST_CASE("what the sample scenes say to analyses", "[series]") {
  const auto slot = factsOf(readScene(SANDGLASS_SOURCE_DIR "/sample_runs/hopper_glass/scene.toml"));
  REQUIRE(slot.up);
  CHECK(*slot.up == Vec3::UnitY());
  CHECK(slot.gravity == 9.81);
  CHECK(slot.gates == std::vector<std::string>{"gate"});
  CHECK(slot.shape == OutletShape::slot);
  CHECK(slot.outlet == Approx(0.025));
  REQUIRE(slot.slotDepth);
  CHECK(*slot.slotDepth == Approx(0.0056));
  CHECK(slot.grainDensity == 2500);
  const auto cone = factsOf(readScene(SANDGLASS_SOURCE_DIR "/sample_runs/hopper_conical/scene.toml"));
  CHECK(cone.shape == OutletShape::circle);
  CHECK_FALSE(cone.slotDepth);
  const auto pair = factsOf(readScene(SANDGLASS_SOURCE_DIR "/sample_runs/two_grains/scene.toml"));
  CHECK_FALSE(pair.up);
}
