#include "sim/contact/sector_contacts.h"

#include "sim/contact/sector_search.h"

#include <algorithm>
#include <cmath>
#include <mutex>

namespace sandglass {

void SectorContacts::turnHistory(double* history, int turn) const {
  for (const auto& entry : laws_.entries())
    for (const int at : entry.law->historyVectors()) {
      double* h = history + entry.firstHistory + at;
      const Vec3 v = sector_.turned({h[0], h[1], h[2]}, turn);
      std::copy_n(v.data(), 3, h);
    }
}

void SectorContacts::keep(const GrainStore& grains, std::int32_t a, std::int32_t b, int turn,
                          const double* history) {
  const int size = laws_.historySize();
  if (std::all_of(history, history + size, [](double h) { return h == 0.0; })) return;
  // b's image was turned by `turn` seen from a; both have been turned back since.
  Kept kept{{grains.id[a], grains.id[b], sector_.modulo(turn - turns_[a] + turns_[b])}, {}};
  std::copy_n(history, size, kept.history.begin());
  turnHistory(kept.history.data(), -turns_[a]);
  kept_.push_back(kept);
}

void SectorContacts::turnBack(GrainStore& grains, PairList& list, WallContacts& walls) {
  kept_.clear();
  turns_.assign(grains.size(), 0);
  bool any = false;
  for (std::size_t i = 0; i < grains.size(); ++i) {
    turns_[i] = sector_.numberOf(grains.place[i].vec());
    any = any || turns_[i] != 0;
  }
  const int size = laws_.historySize();
  if (size > 0)
    for (std::size_t k = 0; k < contacts_.size(); ++k)
      keep(grains, contacts_[k].a, contacts_[k].b, contacts_[k].turn, history_.data() + k * size);
  if (any && size > 0)
    for (std::int64_t p = 0; p < list.entries(); ++p) {
      const auto [a, b] = list.pairs()[p];
      if (list.isPadding(p) || (turns_[a] == 0 && turns_[b] == 0)) continue;
      double history[ContactBlock::maxHistory];
      for (int q = 0; q < size; ++q)
        history[q] = list.historyOf(p, q);
      if (turns_[a] == turns_[b])
        turnHistory(history, -turns_[a]);
      else {
        keep(grains, a, b, 0, history);
        std::fill_n(history, size, 0.0);
      }
      for (int q = 0; q < size; ++q)
        list.setHistory(p, q, history[q]);
    }
  if (any) {
    walls.changeHistories([&](std::int32_t grain, double* history) {
      if (turns_[grain] != 0) turnHistory(history, -turns_[grain]);
    });
    const auto turn = [&](Quad& q, std::size_t i) {
      const Vec3 v = sector_.turned(q.vec(), -turns_[i]);
      q = {v.x(), v.y(), v.z(), q.w};
    };
    for (std::size_t i = 0; i < grains.size(); ++i) {
      if (turns_[i] == 0) continue;
      turn(grains.place[i], i);
      turn(grains.motion[i], i);
      if (grains.turning) turn(grains.roll[i], i);
    }
  }
  std::sort(kept_.begin(), kept_.end(), [](const Kept& s, const Kept& t) { return s.key < t.key; });
}

const SectorContacts::Kept* SectorContacts::find(const Key& key) const {
  const auto at = std::lower_bound(kept_.begin(), kept_.end(), key,
                                   [](const Kept& kept, const Key& k) { return kept.key < k; });
  return at == kept_.end() || key < at->key ? nullptr : &*at;
}

void SectorContacts::build(const GrainStore& grains, double range, PairList& list) {
  contacts_ = searchAcross(grains, range, sector_);
  const int size = laws_.historySize();
  history_.assign(contacts_.size() * size, 0.0);
  result_.assign(contacts_.size() * 12, 0.0);
  for (std::size_t k = 0; k < contacts_.size() && !kept_.empty(); ++k) {
    const Contact& c = contacts_[k];
    if (const Kept* kept = find({grains.id[c.a], grains.id[c.b], c.turn}))
      std::copy_n(kept->history.begin(), size, history_.data() + k * size);
  }
  if (std::any_of(kept_.begin(), kept_.end(), [](const Kept& kept) { return kept.key.turn == 0; }))
    for (std::int64_t p = 0; p < list.entries(); ++p) {
      if (list.isPadding(p)) continue;
      const auto [a, b] = list.pairs()[p];
      if (const Kept* kept = find({grains.id[a], grains.id[b], 0}))
        for (int q = 0; q < size; ++q)
          list.setHistory(p, q, kept->history[q]);
    }
  kept_.clear();
  link(grains);
}

void SectorContacts::link(const GrainStore& grains) {
  offsets_.assign(grains.size() + 1, 0);
  for (const Contact& c : contacts_) {
    ++offsets_[c.a + 1];
    ++offsets_[c.b + 1];
  }
  for (std::size_t i = 0; i < grains.size(); ++i)
    offsets_[i + 1] += offsets_[i];
  entries_.resize(2 * contacts_.size());
  std::vector<std::int32_t> next(offsets_.begin(), offsets_.end() - 1);
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    entries_[next[contacts_[k].a]++] = static_cast<std::int32_t>(k << 1);
    entries_[next[contacts_[k].b]++] = static_cast<std::int32_t>(k << 1 | 1);
  }
}

bool SectorContacts::fillOne(const GrainStore& grains, std::size_t contact, ContactBlock& b, int c) const {
  const auto [i, j, turn] = contacts_[contact];
  const Quad &x = grains.place[i], &y = grains.place[j], &v = grains.motion[i], &w = grains.motion[j];
  const Vec3 apart = x.vec() - sector_.turned(y.vec(), turn);
  const double d = apart.norm(), sum = x.w + y.w;
  if (sum - d <= -laws_.range()) return false;
  const Vec3 n = apart / d;
  b.type[c] = laws_.typeOf(grains.material[i], grains.material[j]);
  b.nx[c] = n.x();
  b.ny[c] = n.y();
  b.nz[c] = n.z();
  b.overlap[c] = sum - d;
  b.radiusA[c] = x.w;
  b.radiusB[c] = y.w;
  b.effectiveRadius[c] = x.w * y.w / sum;
  b.inverseMassA[c] = v.w;
  b.inverseMassB[c] = w.w;
  b.effectiveMass[c] = 1.0 / (v.w + w.w);
  const Vec3 velocity = v.vec() - sector_.turned(w.vec(), turn);
  const double vn = velocity.dot(n);
  Vec3 slip = velocity - vn * n;
  if (laws_.turning()) {
    const Vec3 other = sector_.turned(grains.roll[j].vec(), turn);
    const double arm = laws_.fullRadiusArm() ? 1.0 : d / sum;
    slip -= arm * (grains.roll[i].vec() + other).cross(n);
    const Vec3 spin = grains.roll[i].w * grains.roll[i].vec() - grains.roll[j].w * other;
    b.wx[c] = spin.x();
    b.wy[c] = spin.y();
    b.wz[c] = spin.z();
  }
  b.vn[c] = vn;
  b.vtx[c] = slip.x();
  b.vty[c] = slip.y();
  b.vtz[c] = slip.z();
  for (int k = 0; k < laws_.historySize(); ++k)
    b.history[k][c] = history_[contact * laws_.historySize() + k];
  return true;
}

void SectorContacts::takeResult(const GrainStore& grains, std::size_t contact, const ContactBlock& b, int c) {
  const auto [i, j, turn] = contacts_[contact];
  for (int k = 0; k < laws_.historySize(); ++k)
    history_[contact * laws_.historySize() + k] = b.history[k][c];
  const Vec3 n(b.nx[c], b.ny[c], b.nz[c]), ft(b.ftx[c], b.fty[c], b.ftz[c]),
      couple(b.mx[c], b.my[c], b.mz[c]);
  const double sum = grains.place[i].w + grains.place[j].w;
  const double arm = laws_.fullRadiusArm() ? 1.0 : (sum - b.overlap[c]) / sum;
  const Vec3 force = b.normalForce[c] * n + ft;
  const Vec3 turning = -arm * n.cross(ft); // over radius; the same for both
  const auto put = [&](int side, const Vec3& f, const Vec3& t) {
    std::copy_n(f.data(), 3, result_.data() + contact * 12 + 6 * side);
    std::copy_n(t.data(), 3, result_.data() + contact * 12 + 6 * side + 3);
  };
  put(0, force, grains.place[i].w * turning + couple);
  if (share(contacts_[contact]) < 1.0)
    put(1, Vec3::Zero(), Vec3::Zero());
  else
    put(1, sector_.turned(-force, -turn), sector_.turned(grains.place[j].w * turning - couple, -turn));
}

void SectorContacts::step(const GrainStore& grains, double dt, Parallel& parallel, DeepestOverlap& deepest) {
  std::mutex merge;
  const int size = laws_.historySize();
  parallel.forRange(static_cast<std::int64_t>(contacts_.size()), 256,
                    [&](std::int64_t first, std::int64_t last) {
                      ContactBlock block;
                      block.dt = dt;
                      block.oneType = false;
                      block.size = 0;
                      std::size_t owner[ContactBlock::capacity];
                      DeepestOverlap worst;
                      const auto flush = [&] {
                        laws_.apply(block, true);
                        for (int c = 0; c < block.size; ++c) {
                          takeResult(grains, owner[c], block, c);
                          const Contact& contact = contacts_[owner[c]];
                          worst.take(block.overlap[c] / std::min(block.radiusA[c], block.radiusB[c]),
                                     grains.id[contact.a], grains.id[contact.b], -1);
                        }
                        block.size = 0;
                      };
                      for (std::int64_t k = first; k < last; ++k) {
                        if (!fillOne(grains, k, block, block.size)) {
                          std::fill_n(result_.data() + k * 12, 12, 0.0);
                          std::fill_n(history_.data() + k * size, size, 0.0);
                          continue;
                        }
                        owner[block.size++] = static_cast<std::size_t>(k);
                        if (block.size == ContactBlock::capacity) flush();
                      }
                      if (block.size > 0) flush();
                      const std::lock_guard lock(merge);
                      deepest.take(worst);
                    });
}

void SectorContacts::addTo(GroupSums sums, const GrainStore& grains, std::int64_t first,
                           std::int64_t last) const {
  if (contacts_.empty() || offsets_[first] == offsets_[last]) return;
  for (std::int64_t i = first; i < last; ++i)
    for (std::int32_t k = offsets_[i]; k < offsets_[i + 1]; ++k) {
      const double* out = result_.data() + (entries_[k] >> 1) * std::int64_t{12} + (entries_[k] & 1) * 6;
      double* to = sums.at(i - first);
      for (int q = 0; q < 3; ++q)
        to[q] += out[q];
      if (!grains.turning) continue;
      for (int q = 0; q < 3; ++q)
        to[4 + q] += grains.roll[i].w * out[3 + q];
    }
}

double SectorContacts::storedEnergy(const GrainStore& grains, double dt) const {
  double sum = 0.0;
  visitContacts(grains, dt, [&](const Contact& contact, const ContactBlock& block, int c) {
    for (const auto& entry : laws_.entries())
      sum += share(contact) * entry.law->storedEnergy(block, c, entry.firstHistory);
  });
  return sum;
}

} // namespace sandglass
