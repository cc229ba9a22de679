#include "sim/base/random.h"
#include "sim/grains/fill_region.h"
#include "sim/grains/mixture.h"
#include "sim/grains/open_space.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sandglass {

namespace {

/// One rain filling. How many grains are due follows from the time alone; a grain that finds no room is tried
/// again at the next call, at other places.
class RainFill {
public:
  RainFill(const Scene& scene, const FillSpec& fill)
      : scene_(scene), parameters_(fill.how.parameters), mixture_(scene_, fill),
        region_(parameters_, scene_.domain), open_(scene_, fill.stage), sector_(scene_.sector()),
        endless_(!parameters_.has("number")),
        total_(endless_ ? std::numeric_limits<std::int64_t>::max() : parameters_.integer("number")) {
    rate_ = parameters_.has("rate") ? parameters_.number("rate")
                                    : parameters_.number("mass_rate") / mixture_.meanMass();
  }

  void due(double time, std::int64_t& nextId, const std::function<bool(const Vec3&, double)>& isFree,
           std::vector<GrainSeed>& grains) {
    const std::int64_t wanted = wantedAt(time);
    while (placed_ < wanted) {
      GrainSeed g = mixture_.drawOne(scene_.seed, nextId);
      if (!findRoom(g, isFree, grains)) {
        ++failures_;
        return;
      }
      setMotion(g, scene_.seed, parameters_);
      grains.push_back(g);
      ++placed_;
      ++nextId;
      failures_ = 0;
    }
  }

  bool finished() const { return placed_ >= total_; }
  bool endless() const { return endless_; }
  std::string shortfall(double time) const {
    const std::int64_t wanted = wantedAt(time);
    if (placed_ < wanted)
      return fmt::format("rain: only {} of the {} grains due by now found room; make its region larger or "
                         "lower the rate",
                         placed_, wanted);
    if (!endless_ && placed_ < total_)
      return fmt::format("rain: the stage ended when {} of its {} grains had come; raise the rate or let the "
                         "stage last longer",
                         placed_, total_);
    return "";
  }
  double rate() const { return rate_; } ///< [1/s]
  std::int64_t placed_ = 0, failures_ = 0;

private:
  std::int64_t wantedAt(double time) const {
    return static_cast<std::int64_t>(std::min({rate_ * time, static_cast<double>(total_), 9e18}));
  }

  bool findRoom(GrainSeed& g, const std::function<bool(const Vec3&, double)>& isFree,
                const std::vector<GrainSeed>& fresh) const {
    constexpr int tries = 50;
    constexpr std::uint64_t stride = 0x9E3779B97F4A7C15; // odd, so that each failure leads to another stream
    RandomStream random(scene_.seed + stride * static_cast<std::uint64_t>(failures_),
                        RandomPurpose::grainPosition, static_cast<std::uint64_t>(g.id));
    if (!region_.holds(g.radius)) return false;
    for (int i = 0; i < tries; ++i) {
      const double x = random.uniform(), y = random.uniform(), z = random.uniform();
      g.position = open_.wrapped(region_.centre({x, y, z}, g.radius));
      const bool clear =
          std::none_of(fresh.begin(), fresh.end(), [&](const GrainSeed& other) { return touches(g, other); });
      if (clear && open_.admits(g.position, g.radius) && isFree(g.position, g.radius)) return true;
    }
    return false;
  }

  /// Nearest images suffice for spheres: no period is shorter than a diameter.
  bool touches(const GrainSeed& a, const GrainSeed& b) const {
    for (int turn = 1; turn < sector_.count(); ++turn)
      if ((a.position - sector_.turned(b.position, turn)).norm() < a.radius + b.radius) return true;
    Vec3 apart = a.position - b.position;
    for (int k = 0; k < 3; ++k) {
      const double length = scene_.domain.upper[k] - scene_.domain.lower[k];
      if (scene_.domain.periodic[static_cast<std::size_t>(k)])
        apart[k] -= length * std::round(apart[k] / length);
    }
    return apart.norm() < a.radius + b.radius;
  }

  Scene scene_;
  Parameters parameters_;
  Mixture mixture_;
  FillRegion region_;
  OpenSpace open_;
  Sector sector_;
  bool endless_;
  std::int64_t total_;
  double rate_;
};

class StageRain final : public Rain {
public:
  explicit StageRain(std::vector<std::unique_ptr<RainFill>> fills) : fills_(std::move(fills)) {}

  std::vector<GrainSeed> due(double timeInStage, std::int64_t firstId,
                             const std::function<bool(const Vec3&, double)>& isFree) override {
    std::vector<GrainSeed> grains;
    for (auto& fill : fills_)
      fill->due(timeInStage, firstId, isFree, grains);
    return grains;
  }

  bool finished() const override {
    return std::all_of(fills_.begin(), fills_.end(), [](const auto& fill) { return fill->finished(); });
  }

  bool endless() const override {
    return std::any_of(fills_.begin(), fills_.end(), [](const auto& fill) { return fill->endless(); });
  }

  std::vector<std::string> shortfall(double timeInStage) const override {
    std::vector<std::string> all;
    for (const auto& fill : fills_)
      if (auto sentence = fill->shortfall(timeInStage); !sentence.empty()) all.push_back(std::move(sentence));
    return all;
  }

  std::vector<std::int64_t> state() const override {
    std::vector<std::int64_t> all;
    for (const auto& fill : fills_) {
      all.push_back(fill->placed_);
      all.push_back(fill->failures_);
    }
    return all;
  }

  void setState(const std::vector<std::int64_t>& state) override {
    for (std::size_t i = 0; i < fills_.size() && 2 * i + 1 < state.size(); ++i) {
      fills_[i]->placed_ = state[2 * i];
      fills_[i]->failures_ = state[2 * i + 1];
    }
  }

private:
  std::vector<std::unique_ptr<RainFill>> fills_;
};

} // namespace

std::int64_t rainCount(const Scene& scene, const FillSpec& fill) {
  const Parameters& p = fill.how.parameters;
  if (p.has("number")) return p.integer("number");
  for (const auto& stage : scene.stages)
    if (stage.name == fill.stage)
      return static_cast<std::int64_t>(
          std::min(RainFill(scene, fill).rate() * stage.duration.value_or(0), 9e18));
  return 0;
}

std::unique_ptr<Rain> makeRain(const Scene& scene, const std::string& stage) {
  std::vector<std::unique_ptr<RainFill>> fills;
  for (const auto& fill : scene.fills)
    if (fill.stage == stage && fill.how.kind == "rain")
      fills.push_back(std::make_unique<RainFill>(scene, fill));
  if (fills.empty()) return nullptr;
  return std::make_unique<StageRain>(std::move(fills));
}

} // namespace sandglass
