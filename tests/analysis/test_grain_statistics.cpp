// Histograms, contacts, residence times and heaps that are made up, so that the answers are known.

#include "analysis/contact_statistics.h"
#include "analysis/heap_angle.h"
#include "analysis/histogram.h"
#include "analysis/outflow.h"
#include "analysis/residence.h"
#include "analysis/statistics.h"
#include "sim/base/error.h"
#include "sim/base/random.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace sandglass;
using namespace sandglass::analysis;
using Catch::Contains;

TEST_CASE("a histogram is a density over all values", "[grain-statistics]") {
  Histogram histogram(0, 2, 4);
  for (const double v : {0.0, 0.1, 0.6, 1.99, 2.0, -0.1, 7.0, 0.49})
    histogram.add(v);
  const Series s = histogram.density("x");
  CHECK(s.x == std::vector<double>{0.25, 0.75, 1.25, 1.75});
  // Eight values, bins of 0.5: a count is worth 1/4.
  CHECK(s.y == std::vector<double>{0.75, 0.25, 0, 0.25});
  CHECK(s.error[0] == Approx(std::sqrt(3.0) / 4));
}

TEST_CASE("overlaps and forces by kind of contact", "[grain-statistics]") {
  Frame frame;
  frame.position = {Vec3::Zero(), Vec3::UnitX()};
  frame.id = {0, 1};
  frame.scalars[quantity::radius] = {0.5, 0.5};
  const auto contact = [](std::int64_t b, double overlap, double force) {
    FrameContact c;
    c.a = 0;
    c.b = b;
    c.overlap = overlap;
    c.force = Vec3(0, force, 0);
    return c;
  };
  frame.contacts = {contact(1, 0.002, 1), contact(1, 0.02, 3), contact(-1, 0.004, 5), contact(1, -0.1, 9)};
  ContactStatistics statistics({});
  statistics.add(frame);
  const Curve overlaps = statistics.overlaps(), forces = statistics.forces();
  REQUIRE(overlaps.series.size() == 2);
  CHECK(overlaps.numbers.at("grain_contacts") == 2); // a gap is no contact
  CHECK(overlaps.numbers.at("grain_mean") == Approx(0.011));
  CHECK(overlaps.numbers.at("grain_greatest") == Approx(0.02));
  CHECK(overlaps.numbers.at("grain_share_above_0.01") == 0.5);
  CHECK(overlaps.numbers.at("wall_mean") == Approx(0.004));
  CHECK(forces.numbers.at("grain_mean_force") == Approx(2));
  CHECK(forces.numbers.at("wall_mean_force") == Approx(5));
  // 1 N and 3 N over their mean of 2 N: one value each in the bins of 0.5 and 1.5.
  double integral = 0;
  const Series& s = forces.series[0];
  for (std::size_t k = 0; k < s.x.size(); ++k)
    integral += s.y[k] * (s.x[1] - s.x[0]);
  CHECK(integral == Approx(1));
  frame.contacts.clear();
  CHECK_THROWS_WITH(statistics.add(frame), Contains("set contacts = true"));
}

TEST_CASE("residence times leave out the first life where grains come back", "[grain-statistics]") {
  SeriesColumns columns;
  columns["residence_time"].value = {9, 1, 2, 6};
  columns["life"].value = {0, 1, 1, 2};
  const Curve curve = residenceTimes(columns, 10, "discharged.csv");
  CHECK(curve.numbers.at("grains") == 3);
  CHECK(curve.numbers.at("mean") == 3);
  CHECK(curve.numbers.at("median") == 2);
  CHECK(curve.numbers.at("standard_deviation") == Approx(std::sqrt(7.0))); // (4 + 1 + 9) / 2
  columns["life"].value = {0, 0, 0, 0};
  CHECK(residenceTimes(columns, 10, "").numbers.at("grains") == 4);
  CHECK_THROWS_WITH(residenceTimes({}, 10, "d.csv"), Contains("no column 'residence_time'"));
}

namespace {

/// Grains of diameter 2 mm, one each millimetre, piled up to two lines at these angles beside a slot of 20
/// mm.
Frame heap(double leftDegrees, double rightDegrees, double width) {
  Frame frame;
  for (const int side : {-1, 1}) {
    const double slope = std::tan((side < 0 ? leftDegrees : rightDegrees) * std::numbers::pi / 180);
    for (double s = 0.0105; s < width / 2; s += 1e-3)
      for (double h = 0.001 + slope * (s - 0.01); h > 0; h -= 2e-3)
        frame.position.push_back(Vec3(0.3 + side * s, 0.2 + h, 0));
  }
  frame.id.resize(frame.position.size());
  frame.scalars[quantity::radius].assign(frame.position.size(), 1e-3);
  return frame;
}

Slot slotOf(double width) {
  return {Vec3(0.3, 0.2, 0), Vec3::UnitX(), Vec3::UnitY(), 0.02, width};
}

} // namespace

TEST_CASE("a heap's angle is found per side and averaged", "[grain-statistics]") {
  // Both grains of a bin lie on the line and the outer one is the higher: the tops are the line, moved.
  for (const double angle : {5.0, 20.0, 40.0}) {
    const Curve curve = heapAngle(heap(angle, angle + 10, 0.08), {slotOf(0.08)});
    CHECK(curve.numbers.at("angle_left") == Approx(angle).epsilon(1e-6));
    CHECK(curve.numbers.at("angle_right") == Approx(angle + 10).epsilon(1e-6));
    CHECK(curve.numbers.at("angle") == Approx(angle + 5).epsilon(1e-6));
    CHECK(curve.numbers.at("angle_error") == Approx(0).margin(1e-6));
    // 15 bins on each ledge of 30 mm, without the first and the last.
    CHECK(curve.series.back().x.size() == 13);
  }
  CHECK_NOTHROW(heapAngle(heap(30, 30, 0.052), {slotOf(0.052)})); // eight diameters
  CHECK_THROWS_WITH(heapAngle(heap(30, 30, 0.05), {slotOf(0.05)}),
                    Contains("7.5 grain diameters, but a heap angle needs 8"));
  Frame bare = heap(30, 30, 0.08);
  bare.position.assign(bare.position.size(), Vec3(0.3, 0.2, 0)); // all in the outlet
  CHECK_THROWS_WITH(heapAngle(bare, {slotOf(0.08)}), Contains("only 0 of the bins left of the outlet"));
}

namespace {

/// Rows of discharged.csv: fines of 1 mm (a tenth of the mass) among grains of 2 mm, in this order of kinds.
SeriesColumns mixedRows(const std::vector<int>& fine) {
  SeriesColumns rows;
  for (const int f : fine) {
    rows["diameter"].value.push_back(f ? 1e-3 : 2e-3);
    rows["species"].value.push_back(f);
  }
  return rows;
}

} // namespace

TEST_CASE("the segregation index of a shuffled discharge is its floor", "[grain-statistics]") {
  // 8000 fines and 9000 large grains: x_f = 8000 / (8000 + 72000) = 0.1, 400 fines a sample.
  std::vector<int> kinds(17000, 0);
  std::fill_n(kinds.begin(), 8000, 1);
  std::vector<double> indices;
  double floor = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    RandomStream random(seed, RandomPurpose::test, 0);
    for (std::size_t i = kinds.size() - 1; i > 0; --i)
      std::swap(kinds[i], kinds[static_cast<std::size_t>(random.uniform() * static_cast<double>(i + 1))]);
    const Curve curve = dischargeSegregation(mixedRows(kinds), {}, "");
    indices.push_back(curve.numbers.at("SI"));
    floor = curve.numbers.at("floor");
    CHECK(curve.numbers.at("fines") == Approx(0.1));
    CHECK(curve.numbers.at("fines_per_sample") == 400);
  }
  // The mean over 40 seeds of 20 samples has a standard error of 0.603/0.798/sqrt(800) = 2.7 % (half-normal
  // deviations); samples add up to the whole, which takes another 1/40 off.
  CHECK(mean(indices) == Approx(floor).epsilon(0.09));
}

TEST_CASE("a discharge whose fines run dry has the index and slope that follow", "[grain-statistics]") {
  // In the first half fines and large grains in turns, then large ones alone: x_i/x_f is 1/share of the first
  // samples, 0 in the last. Masses 1 and 8: first part 9 n, then 8 m with 8 m = 9 n, both half of the mass.
  std::vector<int> kinds;
  for (int k = 0; k < 8000; ++k)
    kinds.insert(kinds.end(), {1, 0});
  kinds.insert(kinds.end(), 9000, 0);
  const Curve curve = dischargeSegregation(mixedRows(kinds), {}, "");
  CHECK(curve.numbers.at("fines") == Approx(8000.0 / 144000.0));
  for (std::size_t k = 0; k < 20; ++k)
    CHECK(curve.series[0].y[k] == Approx(k < 10 ? 2.0 : 0.0).margin(2e-3));
  CHECK(curve.numbers.at("SI") == Approx(1).margin(2e-3));
  CHECK(curve.numbers.at("slope") < -2); // from 2 to 0 in a step at the middle
  const auto refused = [](const SeriesColumns& rows, const char* why) {
    CHECK_THROWS_WITH(dischargeSegregation(rows, {}, "d.csv"), Contains(why));
  };
  refused(mixedRows(std::vector<int>(200, 1)), "of about one size");
  refused(mixedRows(std::vector<int>(99, 1)), "needs 100 or more");
  refused({}, "no column 'diameter'");
}

TEST_CASE("places and speeds in an outlet: uniform across a slot, uniform over a disc",
          "[grain-statistics]") {
  SeriesColumns slot, disc;
  for (int k = 0; k < 30000; ++k) {
    RandomStream random(7, RandomPurpose::test, static_cast<std::uint64_t>(k));
    const double x = 0.02 * random.uniform() - 0.01;
    const Vec3 place(0.5 + x, 0.1, 0.3 * random.uniform());
    for (auto* rows : {&slot, &disc}) {
      (*rows)["diameter"].value.push_back(1e-3);
      (*rows)["vx"].value.push_back(0.1);
      (*rows)["vz"].value.push_back(0);
    }
    slot["x"].value.push_back(place.x());
    slot["y"].value.push_back(place.y());
    slot["z"].value.push_back(place.z());
    slot["vy"].value.push_back(-1 + 100 * std::abs(x)); // fastest in the middle
    const double r = 0.01 * std::sqrt(random.uniform()), angle = 2 * std::numbers::pi * random.uniform();
    disc["x"].value.push_back(r * std::cos(angle));
    disc["y"].value.push_back(-0.3);
    disc["z"].value.push_back(r * std::sin(angle));
    disc["vy"].value.push_back(-0.7);
  }
  OutletFrame outlet;
  outlet.centre = {0.5, 0, 0};
  outlet.down = {0, -1, 0};
  outlet.across = {1, 0, 0};
  const Curve places = outletPositions(slot, outlet, ""), speeds = outletVelocities(slot, outlet, "");
  REQUIRE(places.series.size() == 1); // one size: no classes
  REQUIRE(places.series[0].y.size() == 15);
  // Uniform: 1/0.02 per metre; 2000 grains a bin, so five standard errors are 11 %.
  for (std::size_t k = 0; k < 15; ++k) {
    CHECK(std::abs(places.series[0].y[k] - 50) < 5 * places.series[0].error[k]);
    CHECK(speeds.series[0].y[k] == Approx(1 - 100 * std::abs(speeds.series[0].x[k])).margin(0.04));
  }
  outlet.centre = Vec3::Zero();
  outlet.across = Vec3::Zero();
  const Curve area = outletPositions(disc, outlet, "");
  const double uniform = 1 / (std::numbers::pi * 1e-4);
  for (std::size_t k = 0; k < 15; ++k)
    CHECK(std::abs(area.series[0].y[k] - uniform) < 5 * area.series[0].error[k]);
  CHECK(outletVelocities(disc, outlet, "").numbers.at("mean_speed") == Approx(0.7));
  CHECK_THROWS_WITH(outletPositions({}, outlet, "d.csv"), Contains("no column 'x'"));
}
