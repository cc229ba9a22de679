#pragma once
// A solver small enough to see through: grains fall freely and bounce off z = 0 without loss until the wall
// "floor" is removed; those below every outlet are gone. No contacts between grains.

#include "sim/base/error.h"
#include "sim/run/bytes.h"
#include "sim/run/probe.h"
#include "sim/solvers/solver.h"
#include "sim/walls/wall_registry.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sandglass::test {

struct FakeFaults {
  std::int64_t failAt = -1;   ///< step at which advance() throws
  std::int64_t heatFrom = -1; ///< step from which each step multiplies velocities by `heat`
  double heat = 1.01;
};

class FakeSolver final : public Solver {
public:
  FakeSolver(const Scene& scene, double stepSize, FakeFaults faults = {})
      : scene_(scene), dt_(stepSize), faults_(faults), gravity_(scene.gravity) {
    for (const auto& kind : wallKinds())
      if (kind.name == scene.walls.front().shape.kind)
        shape_ = kind.make(scene.walls.front().shape.parameters);
  }

  void add(const std::vector<GrainSeed>& grains) override {
    for (const auto& grain : grains) {
      grains_.push_back(grain);
      nextId_ = std::max(nextId_, grain.id + 1);
      ++(grain.life > 0 ? flow_.grainsRecycled : flow_.grainsEntered);
      (grain.life > 0 ? flow_.massRecycled : flow_.massEntered) += grainMass(scene_, grain);
    }
  }
  void removeWall(const std::string&) override { floor_ = false; }
  void setWallPace(const std::string&, double) override {}
  void setDrag(double rate) override { drag_ = rate; }
  void setGravity(const Vec3& gravity) override { gravity_ = gravity; }

  void advance(std::int64_t steps) override {
    for (; steps > 0; --steps) {
      if (step_ + 1 == faults_.failAt) throw RunError("at 0.5 s the position of grain 3 is not a number");
      ++step_;
      for (auto& grain : grains_) {
        grain.velocity += 0.5 * dt_ * gravity_;
        grain.position += dt_ * grain.velocity;
        grain.velocity += 0.5 * dt_ * gravity_;
        if (floor_ && grain.position.z() < grain.radius && grain.velocity.z() < 0) grain.velocity.z() *= -1;
        grain.velocity *= std::exp(-drag_ * dt_);
        if (faults_.heatFrom >= 0 && step_ >= faults_.heatFrom) grain.velocity *= faults_.heat;
      }
      std::erase_if(grains_, [&](const GrainSeed& grain) {
        for (std::size_t o = 0; o < scene_.outlets.size(); ++o) {
          const auto& outlet = scene_.outlets[o];
          if ((grain.position - outlet.point).dot(outlet.normal) <= 0) continue;
          if (outlet.recycle || outlet.record) left_.push_back({grain, static_cast<int>(o), time(), 0});
          ++flow_.grainsDischarged;
          flow_.massDischarged += grainMass(scene_, grain);
          flow_.lastDischarge = time();
          return true;
        }
        return false;
      });
    }
  }

  double time() const override { return static_cast<double>(step_) * dt_; }
  std::int64_t step() const override { return step_; }
  double stepSize() const override { return dt_; }
  std::size_t grains() const override { return grains_.size(); }
  std::int64_t nextId() const override { return nextId_; }
  bool isFree(const Vec3& x, double radius) const override {
    return std::none_of(grains_.begin(), grains_.end(), [&](const GrainSeed& grain) {
      return (grain.position - x).norm() < grain.radius + radius;
    });
  }

  double greatestSpeed() const override {
    double greatest = 0;
    for (const auto& grain : grains_)
      greatest = std::max(greatest, grain.velocity.norm());
    return greatest;
  }
  std::vector<LeftGrain> takeLeft() override { return std::exchange(left_, {}); }

  FramePtr frame() const override {
    auto frame = std::make_shared<Frame>();
    frame->time = time();
    frame->step = step_;
    auto& radius = frame->scalars[quantity::radius];
    auto& velocity = frame->vectors[quantity::velocity];
    for (const auto& grain : grains_) {
      frame->id.push_back(grain.id);
      frame->position.push_back(grain.position);
      radius.push_back(grain.radius);
      velocity.push_back(grain.velocity);
    }
    for (const auto& species : scene_.species)
      frame->speciesNames.push_back(species.name);
    frame->domain = scene_.domain;
    frame->walls = walls();
    return frame;
  }
  Energies energies() const override {
    Energies e;
    for (const auto& grain : grains_) {
      e.translational += 0.5 * grainMass(scene_, grain) * grain.velocity.squaredNorm();
      e.gravitational -= grainMass(scene_, grain) * gravity_.dot(grain.position);
    }
    return e;
  }
  const Flow& flow() const override { return flow_; }
  std::vector<GrainSeed> present() const override { return grains_; }
  std::vector<FrameWall> walls() const override {
    const Vec3 force(0, 0, -static_cast<double>(step_)); // any number that can be foretold
    return {{"floor", shape_, floor_, Vec3::Zero(), force, Vec3::Zero()}};
  }

  State save() override {
    ByteWriter out;
    out << gravity_.x() << gravity_.y() << gravity_.z();
    out << step_ << nextId_ << floor_ << flow_ << static_cast<std::uint64_t>(grains_.size());
    for (const auto& g : grains_) {
      out << g.id << g.species << g.radius << g.life;
      for (const auto* v : {&g.position, &g.velocity, &g.spin})
        for (int k = 0; k < 3; ++k)
          out << (*v)[k];
    }
    return {{"fake", out.take()}};
  }
  void load(const State& state) override {
    ByteReader in(state.at("fake"));
    std::uint64_t count = 0;
    in >> gravity_.x() >> gravity_.y() >> gravity_.z() >> step_ >> nextId_ >> floor_ >> flow_ >> count;
    grains_.assign(count, {});
    for (auto& g : grains_) {
      in >> g.id >> g.species >> g.radius >> g.life;
      for (auto* v : {&g.position, &g.velocity, &g.spin})
        for (int k = 0; k < 3; ++k)
          in >> (*v)[k];
    }
  }

private:
  const Scene& scene_;
  double dt_, drag_ = 0;
  std::vector<LeftGrain> left_;
  FakeFaults faults_;
  Vec3 gravity_;
  std::shared_ptr<const WallShape> shape_;
  std::int64_t step_ = 0, nextId_ = 0;
  bool floor_ = true;
  Flow flow_;
  std::vector<GrainSeed> grains_;
};

} // namespace sandglass::test
