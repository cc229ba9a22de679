#include "sim/run/flow_rate_probe.h"

#include "sim/run/bytes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sandglass {

FlowRateProbe::FlowRateProbe(const Parameters& parameters, const Scene& scene)
    : scene_(scene), point_(parameters.vector("point")), normal_(parameters.vector("normal").normalized()),
      halfPeriod_(std::numeric_limits<double>::infinity()), outletBeyond_(false) {
  for (int k = 0; k < 3; ++k) {
    const double period = (scene.domain.upper[k] - scene.domain.lower[k]) * std::abs(normal_[k]);
    if (scene.domain.periodic[k] && period > 0) halfPeriod_ = std::min(halfPeriod_, period / 2);
  }
  const double size = (scene.domain.upper - scene.domain.lower).norm();
  for (const auto& outlet : scene.outlets) {
    outletBeyond_ = outletBeyond_ || (outlet.point - point_).dot(normal_) >= -1e-9 * size;
    if (!outlet.recycle) continue;
    const Vec3 middle = 0.5 * (outlet.recycle->lower + outlet.recycle->upper);
    entersBefore_ = entersBefore_ || (middle - point_).dot(normal_) < 0;
  }
}

std::vector<double> FlowRateProbe::sample(const Solver& solver) {
  std::vector<Seen> now;
  for (const auto& grain : solver.present())
    now.push_back({grain.id, (grain.position - point_).dot(normal_), grainMass(scene_, grain), grain.life});
  std::sort(now.begin(), now.end(), [](const Seen& a, const Seen& b) { return a.id < b.id; });

  const auto leaves = [&](double distance) { return distance < 0 && outletBeyond_ ? 1 : 0; };
  const auto entersAndCrosses = [&](const Seen& s) { return entersBefore_ && s.distance >= 0 ? 1 : 0; };
  double crossed = 0;
  auto next = now.begin();
  for (const auto& before : last_) {
    for (; next != now.end() && next->id < before.id; ++next)
      if (next->life > 0) crossed += next->mass * entersAndCrosses(*next); // had waited to be put back
    if (next != now.end() && next->id == before.id && next->life > before.life) {
      const auto whole = static_cast<double>(next->life - before.life - 1); // lives in between
      crossed += before.mass * (leaves(before.distance) + whole * (entersBefore_ && outletBeyond_ ? 1 : 0) +
                                entersAndCrosses(*next));
      ++next;
    } else if (next != now.end() && next->id == before.id) {
      const Seen& after = *next++;
      if ((before.distance < 0) == (after.distance < 0)) continue;
      if (std::abs(after.distance - before.distance) > halfPeriod_) continue;
      crossed += before.distance < 0 ? before.mass : -before.mass;
    } else {
      crossed += before.mass * leaves(before.distance);
    }
  }
  for (; next != now.end(); ++next)
    if (next->life > 0) crossed += next->mass * entersAndCrosses(*next);
  const double time = solver.time();
  const double rate = lastTime_ >= 0 && time > lastTime_ ? crossed / (time - lastTime_) : 0;
  total_ += crossed;
  last_ = std::move(now);
  lastTime_ = time;
  return {rate, total_};
}

std::vector<std::byte> FlowRateProbe::save() const {
  ByteWriter out;
  out << lastTime_ << total_ << last_;
  return out.take();
}

void FlowRateProbe::load(const std::vector<std::byte>& bytes) {
  ByteReader(bytes) >> lastTime_ >> total_ >> last_;
}

} // namespace sandglass
