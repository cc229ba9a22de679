// A contact law in thirty lines, to show what the interface carries: a bridge of constant force that is born
// at touch, lives across a gap up to its rupture distance, and draws liquid from both grains while it lives.

#include "tests/sim/physics/bench_scenes.h"

#include <catch2/catch.hpp>

using namespace sandglass;
using namespace sandglass::testing;

namespace {

class ConstantBridge final : public Law {
public:
  static constexpr double force = 1e-4, rupture = 0.2e-3, draw = 1e-12; // N, m, m^3 from each grain
  int historySize() const override { return 1; }                        // liquid in the bridge; 0: none
  double range() const override { return rupture; }
  std::vector<std::string> grainQuantities() const override { return {"liquid"}; }
  void apply(ContactBlock& b, int first, KernelWidth) const override {
    double* liquid = b.history[first];
    for (int i = 0; i < b.size; ++i) {
      if (liquid[i] == 0.0 && b.overlap[i] > 0.0) b.event[i] = birthEvent;
      if (liquid[i] > 0.0 && b.overlap[i] < -rupture) b.event[i] = deathEvent;
      if (liquid[i] > 0.0 && b.event[i] != deathEvent) b.normalForce[i] -= force;
    }
  }
  void onEvent(ContactEvent event, double* liquid, const EventGrains& grains) const override {
    if (event == birthEvent && *grains.a[0] >= draw && *grains.b[0] >= draw) {
      *grains.a[0] -= draw;
      *grains.b[0] -= draw;
      *liquid = 2 * draw;
    } else if (event == deathEvent) {
      *grains.a[0] += 0.5 * *liquid;
      *grains.b[0] += 0.5 * *liquid;
      *liquid = 0.0;
    }
  }
};

} // namespace

TEST_CASE("a gap law keeps its history from birth to death and conserves what it moves") {
  SceneText t;
  t.normal = R"({ law = "linear", stiffness = "1000 N/m", restitution = 1.0 })";
  t.stepsPerContact = 200;
  DemSolver solver(t.scene(), {1}, {std::make_shared<ConstantBridge>()});
  const double v = 0.1, gap = 0.05e-3;
  solver.add({grain(0, {1e-3 + gap, 0, 0}, {-v, 0, 0}), grain(1, {-1e-3 - gap, 0, 0}, {v, 0, 0})});
  solver.setQuantity("liquid", {5e-12, 3e-12});

  const auto separation = [&] {
    return solver.present()[0].position.x() - solver.present()[1].position.x() - 2e-3;
  };
  // On the way in there is a gap within range and no bridge: no force.
  solver.advance(1);
  CHECK(solver.present()[0].velocity.x() == -v);
  while (separation() > 0)
    solver.advance(1);
  solver.advance(5);
  CHECK(solver.quantity("liquid")[0] == Approx(4e-12));
  CHECK(solver.quantity("liquid")[1] == Approx(2e-12));
  while (separation() < 0)
    solver.advance(1);
  while (separation() < 0.5 * ConstantBridge::rupture)
    solver.advance(1);
  CHECK(solver.quantity("liquid")[0] == Approx(4e-12)); // the bridge spans the gap
  while (separation() < 1.5 * ConstantBridge::rupture)
    solver.advance(1);
  CHECK(solver.quantity("liquid")[0] == Approx(5e-12)); // it broke and gave back
  CHECK(solver.quantity("liquid")[1] == Approx(3e-12));
  // Work to pull it apart: force times rupture distance, taken from the kinetic energy of both.
  const double mass = 4.0 / 3.0 * M_PI * 1e-9 * 2500.0, out = solver.present()[0].velocity.x();
  CHECK(mass * (v * v - out * out) == Approx(ConstantBridge::force * ConstantBridge::rupture).epsilon(0.02));
}

TEST_CASE("a scene without such a law keeps no history, no spin and no torque") {
  SceneText smooth;
  SceneText rough = smooth;
  rough.tangential = R"({ law = "spring", friction = 0.5 })";
  const LawStack a(smooth.scene()), b(rough.scene());
  CHECK(a.historySize() == 0);
  CHECK_FALSE(a.turning());
  CHECK(a.outputQuads() == 1);
  CHECK(b.historySize() == 3);
  CHECK(b.outputQuads() == 2);
  CHECK_FALSE(b.readsSpin());
  DemSolver lean(smooth.scene()), full(rough.scene());
  CHECK(lean.bytesPerGrain() < full.bytesPerGrain());
}
