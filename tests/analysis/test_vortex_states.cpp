// States of a bed in a vortex on made-up frames: one case for each rule, and what just misses it.

#include "analysis/registry.h"
#include "analysis/vortex/vortex_states.h"
#include "analysis/vortex/vortex_theory.h"
#include "sim/base/error.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <numbers>

using namespace sandglass;
using namespace sandglass::analysis;
using std::numbers::pi;

namespace {

constexpr double r = 0.004, tankRadius = 0.06, g = 9.8, interval = 1e-3;
constexpr int n = 256, bins = 8; // round(0.06 / 0.008)

VortexTank tank() {
  return {.radius = tankRadius, .floor = -0.2, .top = 0.2, .gravity = g};
}

/// Grains on rings in the middle of each radial bin, 32 in each, at a height that depends on bin and grain.
/// `open`: the innermost ring is wider, about a core of 0.117 R.
std::vector<Vec3> rings(const std::function<double(int bin, int grain)>& height, bool open = false) {
  std::vector<Vec3> x;
  for (int i = 0; i < n; ++i) {
    const int bin = i % bins;
    const double rho = open && bin == 0 ? 1.75 * r : (bin + 0.5) * tankRadius / bins,
                 angle = 2 * pi * (i / bins) / 32;
    x.emplace_back(rho * std::cos(angle), rho * std::sin(angle), height(bin, i));
  }
  return x;
}

Frame frameOf(std::vector<Vec3> positions, int k) {
  Frame frame;
  frame.time = k * interval;
  frame.step = k;
  frame.position = std::move(positions);
  for (int i = 0; i < n; ++i)
    frame.id.push_back(i);
  frame.scalars[quantity::radius].assign(n, r);
  frame.vectors[quantity::velocity].assign(n, Vec3::Zero());
  return frame;
}

double flat(int, int) {
  return -0.2 + r;
}
double paraboloid(int bin, int) {
  return -0.2 + r + 0.2 * r * bin * bin;
}

VortexMeasures course(int frames, const std::function<std::vector<Vec3>(int k)>& at) {
  VortexMeasures measures(tank());
  for (int k = 0; k < frames; ++k)
    measures.add(frameOf(at(k), k));
  return measures;
}

VortexState listed(const VortexMeasures& m) {
  return vortexVerdict(m, listedVortexRules()).state;
}
VortexState text(const VortexMeasures& m) {
  return vortexVerdict(m, textVortexRules()).state;
}
VortexState own(const VortexMeasures& m) {
  return vortexVerdict(m, ownVortexRules()).state;
}

void require(const VortexMeasures& m, VortexState state) {
  CHECK(listed(m) == state);
  CHECK(text(m) == state);
  CHECK(own(m) == state);
}

/// A flat bed in which `count` grains of the core rise by 0.05 r in each frame, and as many others fall. Its
/// middle is empty to 0.117 R, or closed.
VortexMeasures spouting(int frames, int count, int pauseAt = -1, bool open = true) {
  std::vector<int> core; // within 3/4 R: bins 0 to 5
  for (int i = 0; i < n; ++i)
    if (i % bins < 6) core.push_back(i);
  std::vector<double> shift(n, 0.0);
  return course(frames, [&, count, pauseAt, open](int k) {
    if (k != pauseAt && k > 0)
      for (int j = 0; j < count; ++j) {
        shift[core[j]] += k % 2 ? 0.05 * r : -0.05 * r;
        shift[core[count + j]] += k % 2 ? -0.05 * r : 0.05 * r;
      }
    return rings([&](int bin, int i) { return flat(bin, i) + shift[i]; }, open);
  });
}

} // namespace

TEST_CASE("a flat bed is flat, a paraboloid fluid, a ring pinned", "[vortex]") {
  const auto disc = course(2600, [](int) { return rings(flat); });
  require(disc, VortexState::flat);
  const VortexVerdict verdict = vortexVerdict(disc, listedVortexRules());
  CHECK(verdict.settled == Approx(interval)); // the first frame that has a difference
  CHECK(verdict.start == Approx(interval));
  CHECK(verdict.confidence == 1);
  require(course(2600, [](int) { return rings(paraboloid); }), VortexState::fluid);
  const auto ring = [](int) {
    std::vector<Vec3> x;
    for (int i = 0; i < n; ++i)
      x.emplace_back((tankRadius - 1.5 * r) * std::cos(0.1 * i), (tankRadius - 1.5 * r) * std::sin(0.1 * i),
                     -0.2 + r + 0.001 * (i / 60));
    return x;
  };
  require(course(2600, ring), VortexState::pinned);
}

TEST_CASE("the surface may fail to rise in one bin, and in a tenth of the frames", "[vortex]") {
  const auto broken = [](int count) {
    return course(2600, [count](int) {
      return rings([count](int bin, int i) {
        const bool low = bin == 3 || (count > 1 && bin == 6);
        return low ? paraboloid(bin - 1, i) - 0.01 * r : paraboloid(bin, i);
      });
    });
  };
  require(broken(1), VortexState::fluid);
  require(broken(2), VortexState::flat);
  // Of the last 1500 frames 150 (or 165: 89 %) are flat.
  const auto share = [](int flats) {
    return course(
        2600, [flats](int k) { return rings(k >= 1200 && (k - 1200) % 1400 < flats ? flat : paraboloid); });
  };
  CHECK(listed(share(150)) == VortexState::fluid);
  CHECK(listed(share(165)) == VortexState::flat);
  CHECK(own(share(150)) == VortexState::fluid);
  CHECK(own(share(165)) == VortexState::flat);
  // A rise of less than 0.1 r is none.
  require(course(2600, [](int) { return rings([](int bin, int) { return -0.2 + r + 0.09 * r * bin; }); }),
          VortexState::flat);
}

TEST_CASE("rising grains in the core make a spout", "[vortex]") {
  // As listed a large spout begins with five grains too, and goes first.
  const auto small = spouting(2600, 5), most = spouting(2600, 31), large = spouting(2600, 32),
             largest = spouting(2600, 63), chaos = spouting(2600, 64), few = spouting(2600, 4);
  for (const auto* m : {&small, &most}) {
    CHECK(text(*m) == VortexState::smallSpout);
    CHECK(listed(*m) == VortexState::largeSpout);
    const auto verdict = vortexVerdict(*m, listedVortexRules());
    CHECK(verdict.evidence[3].rule == "small spout");
    CHECK(verdict.evidence[3].holds);
  }
  CHECK(own(most) == VortexState::smallSpout); // ours begins at n / 50, which is 5.12
  CHECK(own(spouting(2600, 6)) == VortexState::smallSpout);
  for (const auto* m : {&large, &largest})
    require(*m, VortexState::largeSpout);
  require(chaos, VortexState::flat);
  require(few, VortexState::flat);
  // A closed bed that hovers: its grains rise and fall as in a spout, but about no open core, and ours wants
  // one.
  const auto hovering = spouting(2600, 40, -1, false);
  CHECK(listed(hovering) == VortexState::largeSpout);
  CHECK(own(hovering) == VortexState::flat);
  CHECK(own(spouting(2600, 20, -1, false)) == VortexState::flat);
  VortexRules anyCore = ownVortexRules();
  anyCore.spoutCore = 0;
  CHECK(vortexVerdict(hovering, anyCore).state == VortexState::largeSpout);
  const auto core = vortexVerdict(hovering, ownVortexRules()).evidence.back();
  CHECK(core.rule == "open core");
  CHECK_FALSE(core.holds);
  CHECK(core.found == Approx(0.5 / bins)); // the innermost ring
  // 2000 frames running: one frame without ends the run of frames. Ours asks for nine in ten.
  const auto paused = spouting(3600, 20, 2000);
  CHECK(text(paused) == VortexState::flat);
  CHECK(listed(paused) == VortexState::flat);
  CHECK(own(paused) == VortexState::smallSpout);
  // Grains that rise near the wall are no spout.
  std::vector<double> shift(n, 0.0);
  require(course(2600,
                 [&](int k) {
                   for (int i = 0; i < n && k > 0; ++i)
                     if (i % bins >= 6) shift[i] += (k + i / bins) % 2 ? 0.05 * r : -0.05 * r;
                   return rings([&](int bin, int i) { return flat(bin, i) + shift[i]; });
                 }),
          VortexState::flat);
}

TEST_CASE("the listing counts pinned frames over the whole run, the others in a window", "[vortex]") {
  const auto ring = [](double rho) {
    std::vector<Vec3> x;
    for (int i = 0; i < n; ++i)
      x.emplace_back(rho * std::cos(0.1 * i), rho * std::sin(0.1 * i), -0.2 + r);
    return x;
  };
  // Every third frame has an empty core: 1450 in all, never half of a window.
  const auto flicker = course(4600, [&](int k) { return k % 3 ? rings(flat) : ring(tankRadius - 1.2 * r); });
  CHECK(listed(flicker) == VortexState::pinned);
  CHECK(text(flicker) == VortexState::flat);
  CHECK(own(flicker) == VortexState::flat);
  // A core of 2.5 r: empty enough for the listing; not for ours, which asks for R / 4; not at the wall.
  const auto hole = course(2600, [&](int) { return ring(2.5 * r); });
  CHECK(listed(hole) == VortexState::pinned);
  CHECK(text(hole) == VortexState::flat);
  CHECK(own(hole) == VortexState::flat);
  const auto wide = course(2600, [&](int) { return ring(0.3 * tankRadius); });
  CHECK(own(wide) == VortexState::pinned);
  CHECK(text(wide) == VortexState::flat);
}

TEST_CASE("a bed that has not settled, or has exploded, is unresolved", "[vortex]") {
  // Falling: energy goes on changing by more than a twentieth in each quarter of a second.
  const auto sinking = course(2600, [](int k) {
    return rings([k](int b, int i) { return flat(b, i) + 0.1 * std::exp(-1e-3 * k); });
  });
  CHECK(own(sinking) == VortexState::unresolved);
  // One grain stays above the tank until 0.7 s.
  const auto high = course(2600, [](int k) {
    auto x = rings(flat);
    if (k < 700) x[17].z() = 0.21;
    return x;
  });
  const auto verdict = vortexVerdict(high, listedVortexRules());
  CHECK(verdict.state == VortexState::flat);
  CHECK(verdict.settled == Approx(0.7));
  require(course(2600,
                 [](int) {
                   auto x = rings(flat);
                   x[0].z() = 0.21;
                   return x;
                 }),
          VortexState::unresolved);
  // What the source leaves in its files after a run has failed.
  require(course(2600, [](int k) { return k < 2000 ? rings(flat) : std::vector<Vec3>(n, Vec3::Ones()); }),
          VortexState::unresolved);
  require(course(400, [](int) { return rings(flat); }), VortexState::unresolved); // too short
  CHECK(listed(course(501, [](int) { return rings(flat); })) == VortexState::flat);
  CHECK(listed(course(500, [](int) { return rings(flat); })) == VortexState::unresolved);
}

TEST_CASE("settling as we see it does not depend on units", "[vortex]") {
  // The same course with grains a million times as heavy: the source's (1 + E) makes another of it.
  const auto at = [](int k) {
    return rings([k](int b, int i) { return flat(b, i) + 0.02 * std::exp(-k / 300.0); });
  };
  VortexMeasures light(tank(), {}, 1), heavy(tank(), {}, 1e6);
  for (int k = 0; k < 3000; ++k) {
    light.add(frameOf(at(k), k));
    heavy.add(frameOf(at(k), k));
  }
  const double ours = vortexVerdict(light, ownVortexRules()).settled;
  CHECK(ours > 0.5);
  CHECK(vortexVerdict(heavy, ownVortexRules()).settled == ours);
  CHECK(vortexVerdict(light, listedVortexRules()).settled < 0.01);
  CHECK(vortexVerdict(heavy, listedVortexRules()).settled > 0.5);
}

TEST_CASE("state, start and history follow a bed that changes", "[vortex]") {
  const auto m = course(6000, [](int k) { return rings(k < 3000 ? flat : paraboloid); });
  const auto verdict = vortexVerdict(m, ownVortexRules());
  CHECK(verdict.state == VortexState::fluid);
  // Nine tenths of 1.5 s are fluid at 4.35 s; the window began at 2.85 s.
  CHECK(verdict.start == Approx(2.85).margin(2 * interval));
  const auto history = vortexHistory(m, ownVortexRules());
  REQUIRE(history.size() == 6000);
  CHECK(history[100] == VortexState::unresolved);
  CHECK(history[2999] == VortexState::flat);
  CHECK(history[4340] == VortexState::flat);
  CHECK(history[4360] == VortexState::fluid);
  CHECK(history.back() == VortexState::fluid);
}

TEST_CASE("confidence falls where a state hangs on a threshold", "[vortex]") {
  const auto verdict = vortexVerdict(spouting(2600, 31), textVortexRules());
  CHECK(verdict.state == VortexState::smallSpout);
  CHECK(verdict.confidence < 1);
  CHECK(verdict.confidence > 0.5);
  CHECK(vortexVerdict(spouting(2600, 16), textVortexRules()).confidence == 1);
}

TEST_CASE("rotation, core, surface and bounce of a bed", "[vortex]") {
  constexpr double omega = 7.5, curvature = 3.0, period = 0.4026;
  VortexMeasures m(tank());
  for (int k = 0; k < 2000; ++k) {
    const double lift = 0.001 * std::sin(2 * pi * k * interval / period);
    Frame frame = frameOf(rings([&](int bin, int) {
                            const double rho = (bin + 0.5) * tankRadius / bins;
                            return -0.15 + curvature * rho * rho + lift;
                          }),
                          k);
    for (int i = 0; i < n; ++i)
      frame.vectors[quantity::velocity][i] = omega * Vec3::UnitZ().cross(frame.position[i]);
    m.add(frame);
  }
  CHECK(bedRotation(m) == Approx(omega).epsilon(1e-6)); // kept in single precision
  CHECK(coreRadius(m) == Approx(0.5 * tankRadius / bins));
  REQUIRE(bouncePeriod(m));
  CHECK(*bouncePeriod(m) == Approx(period).epsilon(0.01));
  const SurfaceProfile p = m.profile();
  CHECK(p.curvature == Approx(curvature).epsilon(1e-4));
  CHECK(p.rotation == Approx(std::sqrt(2 * g * curvature)).epsilon(1e-4));
  CHECK(p.rms < 1e-7);
  CHECK_FALSE(bouncePeriod(course(2000, [](int) { return rings(flat); })));
}

TEST_CASE("rotating-fluid theory", "[vortex]") {
  // Omega_c of 256 grains in a tank of 60 mm (Rice 2012, with g = 9.8 m/s^2), close-packed and at 0.60.
  const double radii[] = {2e-3, 3e-3, 4e-3, 5e-3, 6e-3}, dense[] = {3.340, 6.136, 9.446, 13.20, 17.35},
               loose[] = {3.710, 6.816, 10.49, 14.67, 19.28};
  for (int k = 0; k < 5; ++k) {
    CHECK(criticalRotation(256, radii[k], tankRadius, g) == Approx(dense[k]).epsilon(1e-3));
    CHECK(criticalRotation(256, radii[k], tankRadius, g, 0.6) == Approx(loose[k]).epsilon(1e-3));
    CHECK(criticalRotation(256, radii[k], tankRadius, g) * std::sqrt(tankRadius / g) ==
          Approx(4 * std::sqrt(std::sqrt(2.0) * 256 / pi) * std::pow(radii[k] / tankRadius, 1.5)));
  }
  // Volume under the paraboloid by midpoints, at the rotation where it is that of the bed.
  const double omega = criticalRotation(256, 4e-3, tankRadius, g);
  double volume = 0;
  constexpr int steps = 20000;
  for (int k = 0; k < steps; ++k) {
    const double x = (k + 0.5) * tankRadius / steps;
    volume += 2 * pi * x * omega * omega * x * x / (2 * g) * tankRadius / steps;
  }
  CHECK(paraboloidVolume(omega, tankRadius, g) == Approx(volume).epsilon(1e-6));
  CHECK(paraboloidVolume(omega, tankRadius, g) == Approx(bedVolume(256, 4e-3)).epsilon(1e-12));
  CHECK(grainsForVolume(bedVolume(256, 4e-3), 4e-3) == Approx(256));
  // The lift is zero at its radius and greatest at two thirds of it.
  const double zero = liftRadius(20, 25, 0.01, 7500, g);
  CHECK(netLift(zero, 20, 25, 0.01, 7500, g) == Approx(0).margin(1e-12));
  const double best = zero * 2 / 3, top = netLift(best, 20, 25, 0.01, 7500, g);
  CHECK(top > netLift(0.99 * best, 20, 25, 0.01, 7500, g));
  CHECK(top > netLift(1.01 * best, 20, 25, 0.01, 7500, g));
}

TEST_CASE("the registry's entry gives curves, evidence and thresholds", "[vortex]") {
  const AnalysisKind& kind = analysisKind("vortex_states");
  AnalysisContext context;
  context.facts.up = Vec3::UnitZ();
  context.facts.gravity = g;
  std::vector<FramePtr> frames;
  for (int k = 0; k < 2600; ++k)
    frames.push_back(std::make_shared<Frame>(frameOf(rings(paraboloid), k)));
  Parameters knobs = defaultKnobs(kind);
  CHECK_THROWS_AS(analyze(kind, knobs, context, frames), InputError); // no tank
  setKnob(knobs, kind, "tank_radius", "0.06");
  setKnob(knobs, kind, "floor", "-0.2");
  setKnob(knobs, kind, "top", "0.2");
  const Results results = analyze(kind, knobs, context, frames);
  CHECK_THAT(results.sentences.at(0), Catch::StartsWith("vortex: fluid since"));
  CHECK(results.curves.at(0).numbers.at("state") == 2);
  REQUIRE(results.tables.size() == 2);
  CHECK(results.tables[0].rowNames == std::vector<std::string>{"own", "text", "listed"});
  const auto& names = results.tables[1].rowNames;
  CHECK(std::count(names.begin(), names.end(), "threshold fluid_share") == 1);
  // Fewer knobs, another state: three in ten frames are asked for and none of the bins may fail.
  setKnob(knobs, kind, "rise", "3");
  CHECK(analyze(kind, knobs, context, frames).curves[0].numbers.at("state") == 1);
}
