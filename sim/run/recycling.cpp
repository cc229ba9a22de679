#include "sim/run/recycling.h"

#include "sim/base/random.h"
#include "sim/grains/fill_region.h"
#include "sim/grains/open_space.h"
#include "sim/run/bytes.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace sandglass {

namespace {

constexpr int triesAtOnce = 10;

/// Level places and heights in a recycling box. "Up" is the axis that gravity follows most.
class Landing {
public:
  Landing(const Scene& scene, const RecycleSpec& spec)
      : scene_(scene), region_(parametersOf(spec), scene.domain) {
    scene.gravity.cwiseAbs().maxCoeff(&up_);
    sign_ = scene.gravity[up_] > 0 ? -1 : 1;
  }

  /// A place for try number `number` of this grain; nothing when there is none in the box.
  std::optional<Vec3> place(const GrainSeed& g, std::int64_t number,
                            const std::vector<GrainSeed>& bed) const {
    constexpr std::uint64_t stride = 0x9E3779B97F4A7C15; // odd, so that each try leads to another stream
    constexpr int idBits = 40;
    RandomStream random(scene_.seed + stride * static_cast<std::uint64_t>(number),
                        RandomPurpose::recyclePlace,
                        static_cast<std::uint64_t>(g.id) ^ (static_cast<std::uint64_t>(g.life) << idBits));
    if (!region_.holds(g.radius)) return std::nullopt;
    Vec3 unit;
    for (int k = 0; k < 3; ++k)
      unit[k] = random.uniform();
    unit[up_] = sign_ > 0 ? 0 : 1;
    Vec3 x = region_.centre(unit, g.radius);
    unit[up_] = 1 - unit[up_];
    const double highest = sign_ * region_.centre(unit, g.radius)[up_];
    const double lift = 1e-6 * g.radius; // so that round-off makes no contact
    std::vector<std::pair<double, double>> blocked;
    for (const GrainSeed& other : bed)
      if (const double half = halfBlocked(x, g.radius, other); half > 0) {
        const double middle = sign_ * other.position[up_];
        blocked.emplace_back(middle - half - lift, middle + half + lift);
      }
    std::sort(blocked.begin(), blocked.end());
    double height = sign_ * x[up_];
    for (const auto& [from, to] : blocked) {
      if (from - height >= 2 * g.radius) break; // a void of the bed is smaller than that
      height = std::max(height, to);
    }
    if (height > highest) return std::nullopt;
    x[up_] = sign_ * height;
    return x;
  }

private:
  static Parameters parametersOf(const RecycleSpec& spec) {
    Parameters p;
    p.set("lower", spec.lower);
    p.set("upper", spec.upper);
    return p;
  }

  /// Over the level place of x: half the range of heights in which a sphere of `radius` overlaps the other,
  /// all images counted; 0 when it never does.
  double halfBlocked(const Vec3& x, double radius, const GrainSeed& other) const {
    const double reach = radius + other.radius;
    const int a = (up_ + 1) % 3, b = (up_ + 2) % 3;
    double nearest = reach * reach;
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j) {
        if ((i != 0 && !scene_.domain.periodic[a]) || (j != 0 && !scene_.domain.periodic[b])) continue;
        const double da = x[a] - other.position[a] + i * (scene_.domain.upper[a] - scene_.domain.lower[a]);
        const double db = x[b] - other.position[b] + j * (scene_.domain.upper[b] - scene_.domain.lower[b]);
        nearest = std::min(nearest, da * da + db * db);
      }
    return std::sqrt(reach * reach - nearest);
  }

  const Scene& scene_;
  FillRegion region_;
  int up_ = 2;
  double sign_ = 1; ///< whether up is the positive direction
};

} // namespace

Recycling::Recycling(const Scene& scene) : scene_(scene), queues_(scene.outlets.size()) {}

void Recycling::left(LeftGrain left) {
  if (!scene_.outlets.at(left.outlet).recycle) return;
  queues_[left.outlet].grains.push_back(std::move(left.grain));
}

std::size_t Recycling::waiting() const {
  std::size_t count = 0;
  for (const auto& queue : queues_)
    count += queue.grains.size();
  return count;
}

std::vector<GrainSeed> Recycling::due(const Solver& solver, const std::string& stage) {
  std::vector<GrainSeed> back;
  if (waiting() == 0) return back;
  const OpenSpace open(scene_, stage);
  std::vector<GrainSeed> bed = solver.present();
  for (std::size_t o = 0; o < queues_.size(); ++o) {
    Queue& queue = queues_[o];
    if (queue.grains.empty()) continue;
    const RecycleSpec& spec = *scene_.outlets[o].recycle;
    const Landing landing(scene_, spec);
    int failures = 0;
    while (!queue.grains.empty() && failures < triesAtOnce) {
      GrainSeed g = queue.grains.front();
      ++g.life;
      const auto found = landing.place(g, queue.tries, bed);
      if (found) g.position = open.wrapped(*found);
      // `bed` has those put back just now, which the solver does not know yet.
      if (!found || !open.admits(g.position, g.radius) || !solver.isFree(g.position, g.radius)) {
        ++queue.tries;
        ++failures;
        continue;
      }
      g.velocity = spec.velocity;
      g.spin = Vec3::Zero();
      bed.push_back(g);
      back.push_back(std::move(g));
      queue.grains.pop_front();
      queue.tries = 0;
    }
  }
  return back;
}

std::vector<std::byte> Recycling::save() const {
  ByteWriter out;
  for (const auto& queue : queues_) {
    out << queue.tries << static_cast<std::uint64_t>(queue.grains.size());
    for (const auto& g : queue.grains)
      out << g.id << g.species << g.radius << g.life << g.quantities; // the rest is set when it comes back
  }
  return out.take();
}

void Recycling::load(const std::vector<std::byte>& bytes) {
  ByteReader in(bytes);
  for (auto& queue : queues_) {
    std::uint64_t count = 0;
    in >> queue.tries >> count;
    queue.grains.clear();
    for (; count > 0; --count) {
      GrainSeed& g = queue.grains.emplace_back();
      in >> g.id >> g.species >> g.radius >> g.life >> g.quantities;
    }
  }
}

} // namespace sandglass
