#include "sim/contact/wall_contacts.h"

#include <algorithm>
#include <cmath>
#include <mutex>

namespace sandglass {

namespace {

/// So few that all threads have pieces, each near the grains that it moves.
constexpr std::int64_t candidatesPerPiece = 64;

/// Rows of what stands in runs of equal ids, found by id: a grain's candidates before it was listed anew.
/// Open addressing, at most half full.
class RowsById {
public:
  explicit RowsById(const std::vector<std::int64_t>& ids) : ids_(ids) {
    std::size_t size = 16;
    while (size < 2 * ids.size())
      size *= 2;
    mask_ = size - 1;
    rows_.assign(size, none);
    for (std::size_t k = 0; k < ids.size(); ++k)
      if (k == 0 || ids[k] != ids[k - 1]) rows_[place(ids[k])] = static_cast<std::int32_t>(k);
  }
  /// First row of this id; as many as there are rows: it has none.
  std::size_t first(std::int64_t id) const {
    const std::int32_t row = rows_[place(id)];
    return row == none ? ids_.size() : static_cast<std::size_t>(row);
  }

private:
  static constexpr std::int32_t none = -1;
  std::size_t place(std::int64_t id) const {
    std::size_t at = (static_cast<std::uint64_t>(id) * 0x9e3779b97f4a7c15u) >> 32 & mask_;
    while (rows_[at] != none && ids_[rows_[at]] != id)
      at = (at + 1) & mask_;
    return at;
  }

  const std::vector<std::int64_t>& ids_;
  std::size_t mask_ = 0;
  std::vector<std::int32_t> rows_;
};

} // namespace

void WallContacts::build(const GrainStore& grains, const std::vector<SolverWall>& walls, double range,
                         Parallel& parallel) {
  const auto n = static_cast<std::int64_t>(grains.size());
  const std::vector<Candidate> oldCandidates = std::move(candidates_);
  const std::vector<std::int64_t> oldIds = std::move(ids_);
  const std::vector<std::int32_t> oldFeature = std::move(feature_);
  const std::vector<double> oldHistory = std::move(history_);
  candidates_.clear();
  slack_.clear();
  ids_.clear();
  offsets_.assign(static_cast<std::size_t>(n) + 1, 0);
  for (const auto& found : findNear(grains, walls, range, parallel))
    for (const auto& [candidate, slack] : found) {
      candidates_.push_back(candidate);
      slack_.push_back(slack);
      ids_.push_back(grains.id[candidate.grain]);
      ++offsets_[candidate.grain + 1];
    }
  for (std::int64_t i = 0; i < n; ++i)
    offsets_[i + 1] += offsets_[i];

  const std::size_t row = static_cast<std::size_t>(slots) * laws_.historySize();
  feature_.assign(candidates_.size() * slots, -1);
  history_.assign(candidates_.size() * row, 0.0);
  result_.assign(candidates_.size() * 6, 0.0);
  counting_ = std::any_of(walls.begin(), walls.end(), [](const SolverWall& w) { return w.counted; });
  slipWork_.assign(counting_ ? candidates_.size() : 0, 0.0);
  begun_.assign(slipWork_.size(), 0);
  // Contacts that there are go on with their histories.
  const RowsById rows(oldIds);
  for (std::size_t k = 0; k < candidates_.size(); ++k)
    for (std::size_t at = rows.first(ids_[k]); at < oldIds.size() && oldIds[at] == ids_[k]; ++at) {
      if (oldCandidates[at].wall != candidates_[k].wall || oldFeature[at * slots] < 0) continue;
      std::copy_n(oldFeature.data() + at * slots, slots, feature_.data() + k * slots);
      std::copy_n(oldHistory.data() + at * row, row, history_.data() + k * row);
    }
}

std::vector<std::vector<WallContacts::Found>> WallContacts::findNear(const GrainStore& grains,
                                                                     const std::vector<SolverWall>& walls,
                                                                     double range, Parallel& parallel) const {
  const auto n = static_cast<std::int64_t>(grains.size());
  constexpr std::int64_t chunk = 1024;
  std::vector<Eigen::AlignedBox3d> bounds; // of walls at rest: most grains are far from a small wall
  for (const SolverWall& wall : walls)
    bounds.push_back(wall.shape->bounds());
  std::vector<std::vector<Found>> found(static_cast<std::size_t>((n + chunk - 1) / chunk));
  parallel.forRange(static_cast<std::int64_t>(found.size()), 1, [&](std::int64_t first, std::int64_t last) {
    WallShape::Touches touches;
    for (std::int64_t c = first; c < last; ++c)
      for (std::int64_t i = c * chunk; i < std::min(n, (c + 1) * chunk); ++i)
        for (std::size_t w = 0; w < walls.size(); ++w) {
          if (!walls[w].active) continue;
          const Vec3 x = grains.place[i].vec();
          const double touching = grains.place[i].w + range,
                       reach = touching + grains.listed[i].w + walls[w].allowance;
          if (!walls[w].motion && bounds[w].squaredExteriorDistance(x) >= reach * reach) continue;
          touches.count = 0;
          walls[w].touches(x, reach, touches);
          if (touches.count == 0) continue;
          // The distance to a wall changes by no more than the way gone.
          double slack = walls[w].motion || touches.count == slots ? 0.0 : touches.at[0].distance - touching;
          for (int t = 1; t < touches.count; ++t)
            slack = std::min(slack, touches.at[t].distance - touching);
          // A little less than that, for round-off.
          slack = std::max(0.0, slack - 1e-9 * touching);
          found[c].push_back({{static_cast<std::int32_t>(i), static_cast<std::int32_t>(w)},
                              {x.x(), x.y(), x.z(), slack * slack}});
        }
  });
  return found;
}

int WallContacts::touches(const GrainStore& grains, const std::vector<SolverWall>& walls,
                          std::size_t candidate, double reach, WallShape::Touches& out) const {
  const Candidate& c = candidates_[candidate];
  if (!walls[c.wall].active || parted(grains, candidate)) return 0;
  const Quad& place = grains.place[c.grain];
  walls[c.wall].touches(place.vec(), place.w + reach, out);
  return out.count;
}

int WallContacts::matchHistories(std::size_t candidate, const WallShape::Touches& now,
                                 double* histories) const {
  const int size = laws_.historySize();
  const std::int32_t* before = feature_.data() + candidate * slots;
  const double* kept = history_.data() + candidate * slots * size;
  if (now.count == 1 && before[0] == now.at[0].feature) { // nearly always
    std::copy_n(kept, size, histories);
    return 0;
  }
  bool taken[slots] = {};
  int source[slots];
  for (int c = 0; c < now.count; ++c) {
    source[c] = -1;
    for (int s = 0; s < slots; ++s)
      if (before[s] == now.at[c].feature) {
        source[c] = s;
        taken[s] = true;
      }
  }
  for (int c = 0; c < now.count; ++c) // sliding from a face on to its edge: the contact goes on
    for (int s = 0; s < slots && source[c] < 0; ++s)
      if (before[s] >= 0 && !taken[s]) {
        source[c] = s;
        taken[s] = true;
      }
  for (int c = 0; c < now.count; ++c)
    for (int k = 0; k < size; ++k)
      histories[c * size + k] = source[c] < 0 ? 0.0 : kept[source[c] * size + k];
  return static_cast<int>(std::count(source, source + now.count, -1));
}

void WallContacts::fillOne(const GrainStore& grains, const SolverWall& wall, std::int32_t i,
                           const WallTouch& touch, const double* history, ContactBlock& b, int c) const {
  const Quad &x = grains.place[i], &v = grains.motion[i];
  const Vec3& n = touch.normal;
  b.type[c] = laws_.typeOf(grains.material[i], wall.material);
  b.nx[c] = n.x();
  b.ny[c] = n.y();
  b.nz[c] = n.z();
  b.overlap[c] = x.w - touch.distance;
  b.radiusA[c] = b.effectiveRadius[c] = x.w;
  b.radiusB[c] = 1.0;
  b.inverseMassA[c] = v.w;
  b.inverseMassB[c] = 0.0;
  b.effectiveMass[c] = 1.0 / v.w;
  Vec3 velocity = v.vec();
  if (wall.motion) velocity -= wall.contactVelocity.at(x.vec() - touch.distance * n);
  const double vn = velocity.dot(n);
  Vec3 slip = velocity - vn * n;
  if (laws_.turning()) {
    Vec3 spin = grains.spin(i);
    slip -= (laws_.fullRadiusArm() ? x.w : touch.distance) * spin.cross(n);
    if (wall.motion) spin -= wall.contactVelocity.spin;
    b.wx[c] = spin.x();
    b.wy[c] = spin.y();
    b.wz[c] = spin.z();
  }
  b.vn[c] = vn;
  b.vtx[c] = slip.x();
  b.vty[c] = slip.y();
  b.vtz[c] = slip.z();
  for (int k = 0; k < laws_.historySize(); ++k)
    b.history[k][c] = history[k];
}

void WallContacts::step(const GrainStore& grains, const std::vector<SolverWall>& walls, double dt,
                        Parallel& parallel, DeepestOverlap& deepest) {
  std::mutex merge;
  const int size = laws_.historySize();
  parallel.forRange(
      static_cast<std::int64_t>(candidates_.size()), candidatesPerPiece, [&](std::int64_t first, std::int64_t last) {
        ContactBlock block;
        block.dt = dt;
        block.oneType = false;
        std::vector<double> histories(static_cast<std::size_t>(ContactBlock::capacity) * std::max(1, size));
        std::int32_t owner[ContactBlock::capacity]; // candidate of each contact in the block
        double distance[ContactBlock::capacity];
        DeepestOverlap worst;
        WallShape::Touches now;
        block.size = 0;
        const auto flush = [&] {
          laws_.apply(block, true);
          int slot = 0;
          for (int c = 0; c < block.size; ++c) {
            const std::size_t k = owner[c];
            slot = c > 0 && owner[c - 1] == owner[c] ? slot + 1 : 0;
            double* h = history_.data() + (k * slots + slot) * size;
            for (int q = 0; q < size; ++q)
              h[q] = block.history[q][c];
            const Vec3 n(block.nx[c], block.ny[c], block.nz[c]), ft(block.ftx[c], block.fty[c], block.ftz[c]);
            const Vec3 f = block.normalForce[c] * n + ft;
            Vec3 t(block.mx[c], block.my[c], block.mz[c]);
            if (!laws_.ownTorque()) t -= distance[c] * n.cross(ft);
            double* out = result_.data() + k * 6;
            for (int q = 0; q < 3; ++q) {
              out[q] += f[q];
              out[3 + q] += t[q];
            }
            if (counted(k, walls))
              slipWork_[k] -= dt * (block.ftx[c] * block.vtx[c] + block.fty[c] * block.vty[c] +
                                    block.ftz[c] * block.vtz[c]);
            worst.take(block.overlap[c] / block.radiusA[c], grains.id[candidates_[k].grain], -1,
                       candidates_[k].wall);
          }
          block.size = 0;
        };
        for (std::int64_t k = first; k < last; ++k) {
          if (feature_[k * slots] < 0 && parted(grains, k)) continue; // nothing then, nothing now
          now.count = 0;
          const int count = touches(grains, walls, k, laws_.range(), now);
          std::fill_n(result_.data() + k * 6, 6, 0.0);
          std::int32_t* feature = feature_.data() + k * slots;
          if (counting_) {
            slipWork_[k] = 0.0;
            begun_[k] = 0;
          }
          if (count > 0) {
            if (block.size + count > ContactBlock::capacity) flush();
            const int begun = matchHistories(k, now, histories.data());
            if (counted(k, walls)) begun_[k] = begun;
            for (int c = 0; c < count; ++c) {
              owner[block.size] = static_cast<std::int32_t>(k);
              distance[block.size] =
                  laws_.fullRadiusArm() ? grains.place[candidates_[k].grain].w : now.at[c].distance;
              fillOne(grains, walls[candidates_[k].wall], candidates_[k].grain, now.at[c],
                      histories.data() + c * size, block, block.size);
              ++block.size;
            }
          }
          for (int s = 0; s < slots; ++s)
            feature[s] = s < count ? now.at[s].feature : -1;
        }
        if (block.size) flush();
        const std::lock_guard lock(merge);
        deepest.take(worst.share, worst.idA, worst.idB, worst.wall);
      });
}

void WallContacts::addTo(GroupSums& sums, const GrainStore& grains, std::int64_t first,
                         std::int64_t last) const {
  if (candidates_.empty()) return;
  for (std::int32_t k = offsets_[first]; k < offsets_[last]; ++k) {
    if (feature_[k * slots] < 0) continue; // it does not touch
    const std::int32_t i = candidates_[k].grain;
    const double* out = result_.data() + static_cast<std::size_t>(k) * 6;
    double* to = sums.at[i - first];
    for (int q = 0; q < 3; ++q)
      to[q] += out[q];
    if (!grains.turning) continue;
    for (int q = 0; q < 3; ++q)
      to[4 + q] += grains.roll[i].w * out[3 + q];
  }
}

void WallContacts::total(const GrainStore& grains, int wall, Vec3& force, Vec3& torque) const {
  force = torque = Vec3::Zero();
  for (std::size_t k = 0; k < candidates_.size(); ++k) {
    if (candidates_[k].wall != wall) continue;
    const double* out = result_.data() + k * 6;
    const Vec3 f(out[0], out[1], out[2]), t(out[3], out[4], out[5]);
    force -= f;
    torque -= grains.place[candidates_[k].grain].vec().cross(f) +
              t; // moment about the origin, carried over to the contact
  }
}

void WallContacts::tally(const GrainStore& grains, std::vector<SolverWall>& walls, double dt) const {
  for (std::size_t w = 0; w < walls.size(); ++w) {
    SolverWall& wall = walls[w];
    if (wall.motion) {
      Vec3 force, torque;
      total(grains, static_cast<int>(w), force, torque);
      const WallVelocity& v = wall.velocity;
      const double power = -(force.dot(v.linear) + (torque - v.reference.cross(force)).dot(v.spin));
      wall.tally.work += 0.5 * dt * (wall.tally.power + power);
      wall.tally.power = power;
    }
    if (!wall.counted) continue;
    for (std::size_t k = 0; k < candidates_.size(); ++k)
      if (candidates_[k].wall == static_cast<std::int32_t>(w)) {
        wall.tally.wearWork += slipWork_[k];
        wall.tally.collisions += begun_[k];
      }
  }
}

double WallContacts::storedEnergy(const GrainStore& grains, const std::vector<SolverWall>& walls) const {
  double sum = 0.0;
  visitContacts(grains, walls,
                [&](std::int32_t, std::int32_t, const ContactBlock& block, int c, const WallTouch&) {
                  for (const auto& entry : laws_.entries())
                    sum += entry.law->storedEnergy(block, c, entry.firstHistory);
                });
  return sum;
}

} // namespace sandglass
