#include "sim/solvers/dem/particle_loop.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <utility>

namespace sandglass {

namespace {

constexpr int group = PairList::group;
/// So many groups before their turn records are fetched.
constexpr std::int64_t groupsAhead = 2;

/// Blocks are large; one set a thread, kept.
PairForces::Scratch& scratchOfThread() {
  thread_local PairForces::Scratch scratch{};
  scratch.events.clear();
  scratch.deepest = {};
  return scratch;
}

WallContacts::Sweep& wallsOfThread() {
  thread_local WallContacts::Sweep sweep;
  sweep.deepest = {};
  return sweep;
}

} // namespace

void ParticleLoop::bind() {
  pairs_.bind(grains_, list_);
  travel_.begin(grains_);
}

void ParticleLoop::addWalls(std::int64_t g, std::int64_t last, WallContacts::Sweep& atWalls,
                            GroupSums sums) const {
  atWalls_.addTo(sums, grains_, walls_, g * group, last, atWalls);
  across_.addTo(sums, grains_, g * group, last);
}

/// Calls done(group, end of its grains, their sums over all pairs), which leaves zeros in the sums.
template <class Done>
void ParticleLoop::sweep(int chunk, double dt, bool keepHistory, PairForces::Scratch& scratch, Done&& done) {
  const PairList::Range grains = list_.chunkGrains(chunk), pairs = list_.chunkPairs(chunk);
  const int quads = pairs_.view().outputQuads;
  const auto size = static_cast<std::size_t>(list_.sumRows() * 4 * quads);
  if (!std::exchange(scratch.swept, false)) std::fill(scratch.sums.begin(), scratch.sums.end(), 0.0);
  if (scratch.sums.size() < size) scratch.sums.resize(size);
  const SumRing sums{scratch.sums.data(), list_.sumRows() - 1};
  std::int64_t next = pairs.begin;
  for (std::int64_t first = grains.begin; first < grains.end; first += group) {
    const std::int64_t g = first / group, last = (grains.end - 1) / group, begin = next;
    // Rows of this group stand for those that are `groupsAhead`, and reach as evenly from one to the next.
    const std::int64_t from = list_.groupReach(std::min(g + groupsAhead, last));
    const std::int64_t to = list_.groupReach(std::min(g + groupsAhead + 1, last));
    while (next < list_.groupEnd(g)) {
      const std::int64_t end = std::min(next + ContactBlock::capacity, pairs.end);
      pairs_.addBlock({next, end}, dt, keepHistory, scratch, sums,
                      from + (to - from) * (next - begin) / (list_.groupEnd(g) - begin));
      next = end;
    }
    const PairList::Range crossings = list_.groupCrossings(g);
    pairs_.kernel().addSides(pairs_.view(), list_.crossings().data() + crossings.begin,
                             crossings.end - crossings.begin, list_.crossingOutput(), sums);
    done(g, std::min(first + group, grains.end), GroupSums{sums.row(first, quads), 4 * quads});
  }
  scratch.swept = true;
}

void ParticleLoop::crossing(double dt, bool keepHistory) {
  const PairList::Range pairs = list_.crossing();
  constexpr std::int64_t piece = ContactBlock::capacity;
  std::mutex merge;
  parallel_.forRange(
      (pairs.end - pairs.begin + piece - 1) / piece, 4, [&](std::int64_t first, std::int64_t last) {
        PairForces::Scratch& scratch = scratchOfThread();
        const std::int64_t begin = pairs.begin + first * piece;
        pairs_.evaluate({begin, std::min(pairs.begin + last * piece, pairs.end)}, dt, keepHistory, scratch,
                        list_.crossingOutput() + begin * list_.outputStride());
        const std::lock_guard lock(merge);
        events_.insert(events_.end(), scratch.events.begin(), scratch.events.end());
        deepest_.take(scratch.deepest);
      });
}

ParticleLoop::Report ParticleLoop::step(double dt, const Vec3& gravity, double speedLimit,
                                        std::vector<PairEvent>& events, DeepestOverlap& deepest) {
  events_.clear();
  deepest_ = {};
  crossing(dt, false);
  std::mutex merge;
  std::atomic<bool> late{false}, bad{false};
  const Kernel& kernel = pairs_.kernel();
  parallel_.forRange(list_.chunks(), 1, [&](std::int64_t firstChunk, std::int64_t lastChunk) {
    PairForces::Scratch& scratch = scratchOfThread();
    WallContacts::Sweep& atWalls = wallsOfThread();
    bool tired = false, wrong = false;
    for (std::int64_t c = firstChunk; c < lastChunk; ++c) {
      const PairList::Range range = list_.chunkGrains(static_cast<int>(c));
      atWalls_.begin(atWalls, grains_, walls_, range.begin, range.end, dt, false, atWalls_.tallied());
      sweep(static_cast<int>(c), dt, false, scratch, [&](std::int64_t g, std::int64_t last, GroupSums sums) {
        addWalls(g, last, atWalls, sums);
        if (!watched_.empty()) keepWatched(g * group, last, sums);
        if (fields_.any())
          fields_.addTo(sums, grains_, g * group, last, dt, gravity, pairs_.view().outputQuads > 2, true);
        Speeds speeds;
        kernel.move(pairs_.view(), g * group, static_cast<int>(last - g * group), sums, dt, gravity.data(),
                    speedLimit, speeds);
        const double speed = std::sqrt(speeds.x * speeds.x + speeds.y * speeds.y + speeds.z * speeds.z);
        if (travel_.add(g, dt * speed)) tired = true;
        wrong = wrong || speeds.bad;
      });
    }
    if (tired) late = true;
    if (wrong) bad = true;
    const std::lock_guard lock(merge);
    events_.insert(events_.end(), scratch.events.begin(), scratch.events.end());
    deepest_.take(atWalls.deepest);
    deepest_.take(scratch.deepest);
  });
  events.insert(events.end(), events_.begin(), events_.end());
  deepest.take(deepest_);
  return {late, bad};
}

void ParticleLoop::watch(std::vector<std::int32_t> grains) {
  watched_ = std::move(grains);
  watchedSums_.assign(watched_.size(), {});
}

void ParticleLoop::keepWatched(std::int64_t first, std::int64_t last, GroupSums sums) {
  for (auto at = std::lower_bound(watched_.begin(), watched_.end(), first);
       at != watched_.end() && *at < last; ++at)
    std::copy_n(sums.at(*at - first), sums.stride, watchedSums_[at - watched_.begin()].begin());
}

void ParticleLoop::watchedForce(std::size_t k, Vec3& force, Vec3& torque) const {
  const std::array<double, 12>& s = watchedSums_[k];
  force = {s[0], s[1], s[2]};
  torque = Vec3::Zero();
  if (!grains_.turning) return;
  torque = grains_.place[watched_[k]].w * Vec3(s[4], s[5], s[6]);
  if (pairs_.view().outputQuads > 2) torque += Vec3(s[8], s[9], s[10]);
}

void ParticleLoop::forces(double dt, const Vec3& gravity, std::vector<Quad>& force,
                          std::vector<Quad>& torque) {
  force.assign(grains_.size(), {});
  torque.assign(grains_.turning ? grains_.size() : 0, {});
  pairs_.refresh();
  std::vector<std::uint8_t> live;
  if (list_.live()) live = list_.liveArray();
  crossing(dt, true);
  parallel_.forRange(list_.chunks(), 1, [&](std::int64_t firstChunk, std::int64_t lastChunk) {
    PairForces::Scratch& scratch = scratchOfThread();
    WallContacts::Sweep& atWalls = wallsOfThread();
    for (std::int64_t c = firstChunk; c < lastChunk; ++c) {
      const PairList::Range range = list_.chunkGrains(static_cast<int>(c));
      atWalls_.begin(atWalls, grains_, walls_, range.begin, range.end, dt, true, true);
      sweep(static_cast<int>(c), dt, true, scratch, [&](std::int64_t g, std::int64_t last, GroupSums sums) {
        addWalls(g, last, atWalls, sums);
        if (fields_.any())
          fields_.addTo(sums, grains_, g * group, last, dt, gravity, pairs_.view().outputQuads > 2, false);
        for (std::int64_t i = g * group; i < last; ++i) {
          double* const s = sums.at(i - g * group);
          force[i] = {s[0], s[1], s[2], 0.0};
          const double r = grains_.place[i].w;
          if (grains_.turning) torque[i] = {r * s[4], r * s[5], r * s[6], 0.0};
          if (sums.stride > 8) torque[i] = {r * s[4] + s[8], r * s[5] + s[9], r * s[6] + s[10], 0.0};
          std::fill_n(s, sums.stride, 0.0);
        }
      });
    }
  });
  if (list_.live()) list_.liveArray() = live;
}

} // namespace sandglass
