// What grains are coloured by: original places, classes, bands, selections, periodic copies.

#include "sim/base/error.h"
#include "tests/vis/pixels.h"
#include "tests/vis/sample_frames.h"
#include "vis/grain_colours.h"
#include "vis/periodic_images.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numeric>

using namespace sandglass;
using namespace sandglass::test;
using namespace sandglass::vis;

namespace {

/// Three stages of ten grains that rise by one in each frame: fill (2 frames), wait (3), flow (4).
class Lift : public FrameSource {
public:
  std::size_t size() const override { return 9; }
  double time(std::size_t index) const override { return static_cast<double>(index); }
  std::string name() const override { return "lift"; }
  FramePtr load(std::size_t index) const override {
    auto f = std::make_shared<Frame>();
    f->time = time(index);
    f->stage = index < 2 ? "fill" : index < 5 ? "wait" : "flow";
    f->persistentIds = persistent;
    for (int i = 0; i < 10; ++i) {
      f->id.push_back(100 + i);
      f->position.emplace_back(i, 0, 10.0 * i + static_cast<double>(index));
    }
    return f;
  }
  bool persistent = true;
};

View viewOf(const std::string& quantity) {
  View view = bareView();
  view.colouring.quantity = quantity;
  return view;
}

std::vector<Rgb> coloursOf(const Frame& frame, const View& view, const History* history = nullptr,
                           std::optional<Legend>* legend = nullptr) {
  const VisibleGrains grains = visibleGrains(frame, view, history);
  std::vector<std::size_t> all(grains.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  GrainColours colours = grainColours(frame, view, grains, all, history);
  if (legend) *legend = colours.legend;
  return colours.ofGrain;
}

} // namespace

TEST_CASE("original heights are those at the start of the last stage") {
  const Lift source;
  View view = viewOf("original.z");
  view.colouring.bands = 5;
  const History history = historyOf(source, view);
  CHECK(history.originalRange(2) == std::array<double, 2>{5, 95}); // frame 5 is the first of "flow"
  Frame later = *source.load(8);
  std::reverse(later.position.begin(), later.position.end()); // where grains are now does not matter
  later.id.push_back(999);                                    // came in later: no original place
  later.position.emplace_back(0, 0, 0);
  std::optional<Legend> legend;
  const auto colours = coloursOf(later, view, &history, &legend);
  const ColourMap map("dune", false, 5);
  for (int i = 0; i < 10; ++i)
    CHECK(colours[static_cast<std::size_t>(i)] == map.at(i / 9.0));
  CHECK(colours[0] == colours[1]); // a band holds two of the ten layers
  CHECK(colours[1] != colours[2]);
  CHECK(colours[10] == Rgb{150, 150, 150});
  REQUIRE(legend);
  CHECK(legend->low == 5);
  CHECK(legend->high == 95);
  CHECK(legend->unit == "m");
}

TEST_CASE("original places are refused where they cannot be known") {
  Lift source;
  const View view = viewOf("original.z");
  CHECK_THROWS_WITH(coloursOf(*source.load(0), view), Catch::Contains("without the other frames of the run"));
  source.persistent = false;
  CHECK_THROWS_WITH(historyOf(source, view), Catch::Contains("do not mean the same grain"));
}

TEST_CASE("tracks follow the chosen grains through all frames") {
  const Lift source;
  View view = bareView();
  view.tracks.grains = {103, 109, 5};
  const History history = historyOf(source, view);
  REQUIRE(history.tracks().size() == 2);
  const auto& track = history.tracks().at(103);
  REQUIRE(track.position.size() == 9);
  for (int k = 0; k < 9; ++k)
    CHECK(track.position[static_cast<std::size_t>(k)] == Vec3(3, 0, 30 + k));
}

TEST_CASE("whole numbers in the discrete map are classes, the same colour in every frame") {
  Frame frame = cube(2);
  frame.scalars["state"] = {2, 2, 3, 5, 2, 3, 5, std::nan("")};
  View view = viewOf("state");
  view.colouring.map = "discrete";
  std::optional<Legend> legend;
  const auto colours = coloursOf(frame, view, nullptr, &legend);
  REQUIRE(legend);
  CHECK(legend->entries == std::vector<std::string>{"2", "3", "4", "5"});
  CHECK(legend->firstEntry == 2);
  CHECK(colours[0] == ColourMap("discrete").ofIndex(2));
  CHECK(colours[3] == ColourMap("discrete").ofIndex(5));
  CHECK(colours[7] == Rgb{150, 150, 150});
  frame.scalars["state"][0] = 2.5; // no classes any more
  coloursOf(frame, view, nullptr, &legend);
  CHECK(legend->entries.empty());
}

TEST_CASE("bands are equal shares of the map, ends included, and maps can be turned round") {
  const ColourMap smooth("viridis"), banded("viridis", false, 4), turned("viridis", true);
  CHECK(banded.at(0) == smooth.at(0));
  CHECK(banded.at(0.2499) == banded.at(0));
  CHECK(banded.at(0.2501) == smooth.at(1 / 3.0));
  CHECK(banded.at(1) == smooth.at(1));
  CHECK(turned.at(0) == smooth.at(1));
  CHECK(turned.at(0.25) == smooth.at(0.75));
}

TEST_CASE("a selection shows, hides or highlights") {
  Renderer renderer;
  const Frame frame = cube(4);
  View view = viewOf("");
  view.selection.expression = "velocity.x > 1.5 && z < 0.02"; // two of four layers each way: a quarter of 64
  CHECK(visibleGrains(frame, view).size() == 16);
  view.selection.use = Selection::Use::hide;
  CHECK(visibleGrains(frame, view).size() == 48);
  view.selection.use = Selection::Use::highlight;
  const VisibleGrains all = visibleGrains(frame, view);
  REQUIRE(all.size() == 64);
  const auto colours = coloursOf(frame, view);
  int plain = 0;
  for (std::size_t k = 0; k < 64; ++k) {
    plain += colours[k] == Rgb{217, 199, 158}; // 255 times (0.85, 0.78, 0.62)
    CHECK((colours[k] == Rgb{217, 199, 158}) == (all.pale[k] == 0));
  }
  CHECK(plain == 16);
  view.selection = {"velocity.x >", Selection::Use::only, {}};
  CHECK_THROWS_AS(renderer.draw(frame, view), InputError);
}

TEST_CASE("periodic images copy grains along periodic directions alone") {
  Frame frame = cube(2, 1e-2);
  frame.domain.periodic = {true, false, true};
  View view = viewOf("");
  view.periodicImages = {1, 5, 2};
  const auto shifts = imageShifts(frame.domain, view);
  CHECK(shifts.size() == 3 * 5);
  CHECK(shifts.front() == Vec3::Zero());
  const VisibleGrains grains = visibleGrains(frame, view);
  REQUIRE(grains.size() == 8 * 15);
  Vec3 low = Vec3::Constant(1), high = -low;
  for (const Vec3& p : grains.position)
    low = low.cwiseMin(p), high = high.cwiseMax(p);
  CHECK((low - Vec3(-0.015, 0.005, -0.035)).norm() < 1e-12); // one period of 2 cm in x, two in z
  CHECK((high - Vec3(0.035, 0.015, 0.055)).norm() < 1e-12);
  CHECK(grains.id[8] == frame.id[0]); // a copy is the same grain
}
