#include "sim/contact/wall_contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sandglass {

namespace {

constexpr std::int32_t ahead = 12; ///< candidates whose grains are asked for from memory
constexpr std::int64_t nobody = std::numeric_limits<std::int64_t>::max();

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

/// A table of entries of `size` numbers each, rows for columns.
template <class T>
std::vector<T> transposed(const std::vector<T>& all, std::size_t rows, std::size_t columns,
                          std::size_t size) {
  std::vector<T> out(all.size());
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t c = 0; c < columns; ++c)
      std::copy_n(all.data() + (r * columns + c) * size, size, out.data() + (c * rows + r) * size);
  return out;
}

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

  const std::size_t size = laws_.historySize();
  for (const SolverWall& wall : walls)
    slots_ = std::max(slots_, wall.shape->mostTouches());
  feature_.assign(candidates_.size() * slots_, -1);
  history_.assign(candidates_.size() * slots_ * size, 0.0);
  load_.assign(candidates_.size() * 6, 0.0);
  moving_ = std::any_of(walls.begin(), walls.end(), [](const SolverWall& w) { return w.motion != nullptr; });
  counting_ = std::any_of(walls.begin(), walls.end(), [](const SolverWall& w) { return w.counted; });
  slipWork_.assign(counting_ ? candidates_.size() : 0, 0.0);
  begun_.assign(slipWork_.size(), 0);
  // Contacts that there are go on with their histories.
  const RowsById rows(oldIds);
  for (std::size_t k = 0; k < candidates_.size(); ++k)
    for (std::size_t at = rows.first(ids_[k]); at < oldIds.size() && oldIds[at] == ids_[k]; ++at) {
      if (oldCandidates[at].wall != candidates_[k].wall || oldFeature[at] < 0) continue;
      for (int slot = 0; slot < slots_; ++slot) {
        const std::size_t from = slot * oldCandidates.size() + at, to = slot * candidates_.size() + k;
        feature_[to] = oldFeature[from];
        std::copy_n(oldHistory.data() + from * size, size, history_.data() + to * size);
      }
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
          double slack = walls[w].motion || touches.count >= slots_ ? 0.0 : touches.at[0].distance - touching;
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

int WallContacts::matchHistories(std::int32_t candidate, const WallShape::Touches& now, int* source) const {
  std::int32_t before[mostSlots];
  for (int s = 0; s < slots_; ++s)
    before[s] = feature_[row(candidate, s)];
  bool taken[mostSlots] = {};
  for (int c = 0; c < now.count; ++c) {
    source[c] = -1;
    for (int s = 0; s < slots_; ++s)
      if (before[s] == now.at[c].feature) {
        source[c] = s;
        taken[s] = true;
      }
  }
  for (int c = 0; c < now.count; ++c) // sliding from a face on to its edge: the contact goes on
    for (int s = 0; s < slots_ && source[c] < 0; ++s)
      if (before[s] >= 0 && !taken[s]) {
        source[c] = s;
        taken[s] = true;
      }
  return static_cast<int>(std::count(source, source + now.count, -1));
}

std::int32_t WallContacts::gather(const GrainStore& grains, const std::vector<SolverWall>& walls,
                                  std::int32_t k, std::int32_t end, WallBlock& block) const {
  const std::size_t size = laws_.historySize();
  ContactBlock& b = block.contact;
  b.size = 0;
  b.oneType = true;
  block.changes.clear();
  block.crowded = -1;
  WallShape::Touches now;
  for (; k < end; ++k) {
    // Those near a wall are few and far between in memory.
    const Quad* soon = &grains.place[candidates_[std::min(k + ahead, end - 1)].grain];
    __builtin_prefetch(soon);
    __builtin_prefetch(soon + grains.quadsPerRecord() - 1);
    const std::int32_t before = feature_[k];
    if (before < 0 && parted(grains, k)) continue; // nothing then, nothing now
    const Candidate& at = candidates_[k];
    const SolverWall& wall = walls[at.wall];
    now.count = now.lost = 0;
    if (wall.active) {
      const Quad& place = grains.place[at.grain];
      wall.touches(place.vec(), place.w + laws_.range(), now);
    }
    if (now.lost > 0 || now.count > slots_) {
      block.crowded = k;
      now.count = std::min(now.count, slots_);
    }
    if (b.size + now.count > WallBlock::capacity) break;
    int source[mostSlots] = {};
    const bool same =
        now.count == 1 && before == now.at[0].feature && feature_[row(k, 1)] < 0; // nearly always
    if (!same && (now.count > 0 || before >= 0))
      block.changes.push_back({k, b.size, now.count, matchHistories(k, now, source)});
    for (int t = 0; t < now.count; ++t) {
      const double* kept = history_.data() + row(k, std::max(source[t], 0)) * size;
      for (std::size_t q = 0; q < size; ++q)
        b.history[q][b.size] = source[t] < 0 ? 0.0 : kept[q];
      gatherOne(grains, wall, k, now.at[t], t, block);
    }
  }
  return k;
}

void WallContacts::gatherOne(const GrainStore& grains, const SolverWall& wall, std::int32_t candidate,
                             const WallTouch& touch, int slot, WallBlock& block) const {
  ContactBlock& b = block.contact;
  const int c = b.size++;
  const std::int32_t i = candidates_[candidate].grain;
  const Quad &x = grains.place[i], &v = grains.motion[i];
  block.owner[c] = candidate;
  block.feature[c] = touch.feature;
  block.slot[c] = static_cast<std::int8_t>(slot);
  block.distance[c] = touch.distance;
  b.type[c] = laws_.typeOf(grains.material[i], wall.material);
  b.oneType = b.oneType && b.type[c] == b.type[0];
  b.nx[c] = touch.normal.x();
  b.ny[c] = touch.normal.y();
  b.nz[c] = touch.normal.z();
  b.overlap[c] = x.w - touch.distance;
  b.radiusA[c] = x.w;
  b.inverseMassA[c] = v.w;
  Vec3 velocity = v.vec();
  if (wall.motion) velocity -= wall.contactVelocity.at(x.vec() - touch.distance * touch.normal);
  b.vtx[c] = velocity.x();
  b.vty[c] = velocity.y();
  b.vtz[c] = velocity.z();
  if (!laws_.turning()) return;
  const Vec3 spin = grains.spin(i);
  b.wx[c] = spin.x();
  b.wy[c] = spin.y();
  b.wz[c] = spin.z();
}

void WallContacts::finish(const std::vector<SolverWall>& walls, double dt, WallBlock& block) const {
  ContactBlock& b = block.contact;
  b.dt = dt;
  block.finishMotion(laws_.turning(), laws_.fullRadiusArm());
  for (int c = 0; moving_ && laws_.turning() && c < b.size; ++c) {
    const SolverWall& wall = walls[candidates_[block.owner[c]].wall];
    if (!wall.motion) continue;
    b.wx[c] -= wall.contactVelocity.spin.x();
    b.wy[c] -= wall.contactVelocity.spin.y();
    b.wz[c] -= wall.contactVelocity.spin.z();
  }
  laws_.apply(b, true);
  block.finishForces(laws_.ownTorque(), laws_.fullRadiusArm());
}

void WallContacts::remember(const WallBlock& block) {
  const std::size_t size = laws_.historySize();
  for (int c = 0; c < block.contact.size; ++c) {
    double* h = history_.data() + row(block.owner[c], block.slot[c]) * size;
    for (std::size_t q = 0; q < size; ++q)
      h[q] = block.contact.history[q][c];
  }
  for (const WallBlock::Change& change : block.changes) {
    for (int s = 0; s < slots_; ++s)
      feature_[row(change.owner, s)] = s < change.count ? block.feature[change.first + s] : -1;
  }
}

void WallContacts::begin(Sweep& s, const GrainStore& grains, const std::vector<SolverWall>& walls,
                         std::int64_t first, std::int64_t last, double dt, bool keepHistory, bool loads) {
  s.dt = dt;
  s.keepHistory = keepHistory;
  s.loads = loads;
  s.upcoming = nobody;
  if (candidates_.empty() || offsets_[first] == offsets_[last]) return;
  s.next = offsets_[first];
  s.end = offsets_[last];
  if (loads) std::fill(load_.begin() + s.next * 6, load_.begin() + s.end * 6, 0.0);
  if (counting_) {
    std::fill(slipWork_.begin() + s.next, slipWork_.begin() + s.end, 0.0);
    std::fill(begun_.begin() + s.next, begun_.begin() + s.end, 0);
  }
  next(grains, walls, s);
}

void WallContacts::next(const GrainStore& grains, const std::vector<SolverWall>& walls, Sweep& s) {
  s.row = s.block.rows = 0;
  while (s.block.rows == 0 && s.next < s.end)
    evaluate(grains, walls, s);
  s.upcoming = s.block.rows > 0 ? candidates_[s.block.ownerOfRow[0]].grain : nobody;
}

void WallContacts::evaluate(const GrainStore& grains, const std::vector<SolverWall>& walls, Sweep& s) {
  const ContactBlock& b = s.block.contact;
  s.next = gather(grains, walls, s.next, s.end, s.block);
  finish(walls, s.dt, s.block);
  if (counting_) {
    for (int c = 0; c < b.size; ++c)
      if (counted(s.block.owner[c], walls))
        slipWork_[s.block.owner[c]] -=
            s.dt * (b.ftx[c] * b.vtx[c] + b.fty[c] * b.vty[c] + b.ftz[c] * b.vtz[c]);
    for (const WallBlock::Change& change : s.block.changes)
      if (counted(change.owner, walls)) begun_[change.owner] = change.begun;
  }
  if (!s.keepHistory) remember(s.block);
  if (s.block.crowded >= 0) {
    const Candidate& at = candidates_[s.block.crowded];
    s.deepest.take(DeepestOverlap::crowded, grains.id[at.grain], -1, at.wall);
  }
  const double greatest = s.block.greatestShare();
  if (greatest < std::min(s.deepest.share, DeepestOverlap::aboutToPass)) return;
  for (int c = 0; c < b.size; ++c) {
    const Candidate& at = candidates_[s.block.owner[c]];
    const double share = s.block.share[c];
    const bool passing = share > DeepestOverlap::aboutToPass && !walls[at.wall].shape->pushesBack();
    s.deepest.take(passing ? DeepestOverlap::passing : share, grains.id[at.grain], -1, at.wall);
  }
}

void WallContacts::addTo(GroupSums sums, const GrainStore& grains, const std::vector<SolverWall>& walls,
                         std::int64_t first, std::int64_t last, Sweep& s) {
  using Row = Eigen::Map<const Eigen::Array4d, Eigen::Aligned32>;
  using Sum = Eigen::Map<Eigen::Array4d, Eigen::Aligned32>;
  while (s.upcoming < last) {
    double* to = sums.at(s.upcoming - first);
    const double* row = s.block.row[s.row];
    Sum(to) += Row(row);
    if (grains.turning) Sum(to + 4) += grains.roll[s.upcoming].w * Row(row + 4);
    if (s.loads) keepLoad(grains, s);
    if (++s.row < s.block.rows)
      s.upcoming = candidates_[s.block.ownerOfRow[s.row]].grain;
    else
      next(grains, walls, s);
  }
}

void WallContacts::keepLoad(const GrainStore& grains, const Sweep& s) {
  const double* row = s.block.row[s.row];
  const Vec3 force(row[0], row[1], row[2]), torque(row[4], row[5], row[6]);
  // Moment about the origin, carried over to the contact.
  const Vec3 moment = grains.place[s.upcoming].vec().cross(force) + torque;
  double* load = load_.data() + static_cast<std::size_t>(s.block.ownerOfRow[s.row]) * 6;
  std::copy_n(force.data(), 3, load);
  std::copy_n(moment.data(), 3, load + 3);
}

void WallContacts::total(int wall, Vec3& force, Vec3& torque) const {
  force = torque = Vec3::Zero();
  for (std::size_t k = 0; k < candidates_.size(); ++k) {
    if (candidates_[k].wall != wall) continue;
    const double* load = load_.data() + k * 6;
    force -= Vec3(load[0], load[1], load[2]);
    torque -= Vec3(load[3], load[4], load[5]);
  }
}

void WallContacts::tally(std::vector<SolverWall>& walls, double dt) const {
  for (std::size_t w = 0; w < walls.size(); ++w) {
    SolverWall& wall = walls[w];
    if (wall.motion) {
      Vec3 force, torque;
      total(static_cast<int>(w), force, torque);
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

std::vector<double> WallContacts::histories() const {
  return transposed(history_, slots_, candidates_.size(), laws_.historySize());
}

std::vector<std::int32_t> WallContacts::features() const {
  return transposed(feature_, slots_, candidates_.size(), 1);
}

bool WallContacts::setHistories(const std::vector<double>& all) {
  if (all.size() != history_.size()) return false;
  history_ = transposed(all, candidates_.size(), slots_, laws_.historySize());
  return true;
}

bool WallContacts::setFeatures(const std::vector<std::int32_t>& all) {
  if (all.size() != feature_.size()) return false;
  feature_ = transposed(all, candidates_.size(), slots_, 1);
  return true;
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
