#include "sim/contact/pair_list.h"

#include "sim/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sandglass {

namespace {

/// Three small signed counters in one integer that orders like the tuple.
std::int64_t packImage(const std::array<std::int64_t, 3>& n) {
  constexpr std::int64_t bias = 1 << 20, base = 1 << 21;
  return ((n[0] + bias) * base + (n[1] + bias)) * base + (n[2] + bias);
}

double& component(Quad& q, int axis) {
  return axis == 0 ? q.x : axis == 1 ? q.y : q.z;
}
double component(const Quad& q, int axis) {
  return axis == 0 ? q.x : axis == 1 ? q.y : q.z;
}

} // namespace

/// A grid over the grains: exact periodic fit along periodic directions, the grains' bounds elsewhere.
struct PairList::Cells {
  Vec3 lower, width;
  std::array<int, 3> count{1, 1, 1}, reach{0, 0, 0}; ///< cells along an axis; cells to look beyond one's own
  std::array<bool, 3> periodic{};
  std::vector<std::int32_t> start; ///< first grain of each cell, in storage order

  int along(const Quad& q, int axis) const {
    const int c = static_cast<int>((component(q, axis) - lower[axis]) / width[axis]);
    return std::clamp(c, 0, count[axis] - 1);
  }
  int index(int x, int y, int z) const { return (x * count[1] + y) * count[2] + z; }
  int of(const Quad& q) const { return index(along(q, 0), along(q, 1), along(q, 2)); }
};

PairList::PairList(const Domain& domain, int historySize, int outputSize)
    : domain_(domain), extent_(domain.upper - domain.lower), historySize_(historySize),
      outputSize_(outputSize) {
  for (int k = 0; k < 3; ++k)
    periodic_ = periodic_ || domain.periodic[k];
}

void PairList::wrap(GrainStore& grains) const {
  for (int axis = 0; axis < 3; ++axis) {
    if (!domain_.periodic[axis]) continue;
    for (std::size_t i = 0; i < grains.size(); ++i) {
      double& x = component(grains.place[i], axis);
      while (x >= domain_.upper[axis])
        x -= extent_[axis], ++grains.image[i][axis];
      while (x < domain_.lower[axis])
        x += extent_[axis], --grains.image[i][axis];
      if (x >= domain_.upper[axis]) x = domain_.lower[axis]; // x + L rounded up to the upper side
    }
  }
}

void PairList::build(GrainStore& grains, double range, Parallel& parallel,
                     const std::vector<std::uint8_t>& drop) {
  const std::size_t n = grains.size();
  if (periodic_) wrap(grains);

  // Grains that go must not shape the grid: a list built anew from the positions of those that stay is the
  // same.
  const auto stays = [&](std::size_t i) { return drop.empty() || !drop[i]; };
  std::size_t staying = 0;
  Cells cells;
  double largest = 0.0;
  Vec3 low = Vec3::Constant(1e300), high = Vec3::Constant(-1e300);
  for (std::size_t i = 0; i < n; ++i) {
    if (!stays(i)) continue;
    const Quad& q = grains.place[i];
    ++staying;
    largest = std::max(largest, q.w + grains.listed[i].w);
    low = low.cwiseMin(q.vec());
    high = high.cwiseMax(q.vec());
  }
  const double cutoff = 2.0 * largest + range;
  double cell = cutoff;
  for (int attempt = 0;; ++attempt) { // wide empty spaces get larger cells, so memory follows the grains
    double total = 1.0;
    for (int k = 0; k < 3; ++k) {
      cells.periodic[k] = domain_.periodic[k];
      cells.lower[k] = domain_.periodic[k] ? domain_.lower[k] : (staying ? low[k] : 0.0);
      const double length = domain_.periodic[k] ? extent_[k] : (staying ? high[k] - low[k] : 0.0);
      cells.count[k] = static_cast<int>(std::clamp(std::floor(length / cell), 1.0, 1e6));
      cells.width[k] = std::max(length / cells.count[k], 1e-300);
      cells.reach[k] = !domain_.periodic[k] && cells.count[k] == 1
                           ? 0
                           : static_cast<int>(std::ceil(cutoff / cells.width[k]));
      total *= cells.count[k];
    }
    if (total <= 4.0 * static_cast<double>(staying) + 1000.0 || attempt > 60) break;
    cell *= 1.26;
  }

  // Counting sort by cell; equal cells keep their order.
  const int cellCount = cells.count[0] * cells.count[1] * cells.count[2];
  std::vector<std::int32_t> cellOf(n), cursor(cellCount + 1, 0);
  for (std::size_t i = 0; i < n; ++i)
    if (stays(i)) ++cursor[(cellOf[i] = cells.of(grains.place[i])) + 1];
  for (int c = 0; c < cellCount; ++c)
    cursor[c + 1] += cursor[c];
  cells.start = cursor;
  std::vector<std::int32_t> order(cursor.back());
  for (std::size_t i = 0; i < n; ++i)
    if (stays(i)) order[cursor[cellOf[i]]++] = static_cast<std::int32_t>(i);
  grains.reorder(order);
  for (std::size_t i = 0; i < grains.size(); ++i) {
    const Quad& x = grains.place[i];
    grains.listed[i] = {x.x, x.y, x.z, grains.listed[i].w};
  }

  PairList old(domain_, historySize_, outputSize_);
  std::swap(old.pairs_, pairs_);
  std::swap(old.imageKey_, imageKey_);
  std::swap(old.live_, live_);
  std::swap(old.history_, history_);
  std::swap(old.partnerIds_, partnerIds_);
  std::swap(old.offsets_, offsets_);
  std::swap(old.entries_, entries_);

  search(grains, cells, range, parallel);
  link(grains);
  history_.assign(pairs_.size() * historySize_, 0.0);
  output_.assign(pairs_.size() * outputSize_, 0.0);
  live_.assign(pairs_.size(), 0);
  carry(old, order, grains, parallel);
}

void PairList::search(const GrainStore& grains, const Cells& cells, double range, Parallel& parallel) {
  // Image codes: every shift that the stencil can meet.
  codes_.clear();
  shifts_.clear();
  std::array<int, 3> codeReach{0, 0, 0};
  for (int k = 0; k < 3; ++k)
    if (cells.periodic[k]) codeReach[k] = (cells.reach[k] + cells.count[k] - 1) / cells.count[k];
  for (int x = -codeReach[0]; x <= codeReach[0]; ++x)
    for (int y = -codeReach[1]; y <= codeReach[1]; ++y)
      for (int z = -codeReach[2]; z <= codeReach[2]; ++z) {
        codes_.push_back({x, y, z});
        shifts_.emplace_back(x * extent_[0], y * extent_[1], z * extent_[2]);
      }
  if (codes_.size() > 255)
    throw InputError(fmt::format(
        "the periodic box is so thin that a pair has {} images; at most 255 are possible: make the "
        "box wider than half a grain",
        codes_.size()));
  const auto codeOf = [&](int x, int y, int z) {
    return ((x + codeReach[0]) * (2 * codeReach[1] + 1) + y + codeReach[1]) * (2 * codeReach[2] + 1) + z +
           codeReach[2];
  };

  const std::int64_t n = static_cast<std::int64_t>(grains.size());
  struct Found {
    Pair pair;
    std::uint8_t code;
  };
  constexpr std::int64_t chunk = 512;
  std::vector<std::vector<Found>> found(static_cast<std::size_t>((n + chunk - 1) / chunk));
  const Quad *place = grains.place.data(), *listed = grains.listed.data();
  parallel.forRange(static_cast<std::int64_t>(found.size()), 1, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t c = first; c < last; ++c) {
      auto& out = found[c];
      out.reserve(chunk * 6);
      for (std::int64_t i = c * chunk; i < std::min(n, (c + 1) * chunk); ++i) {
        const Quad me = place[i];
        const double mine = me.w + listed[i].w + range;
        const std::array<int, 3> home{cells.along(me, 0), cells.along(me, 1), cells.along(me, 2)};
        const auto visit = [&](std::int32_t begin, std::int32_t end, int code) {
          const Vec3& s = shifts_[code];
          const double px = me.x - s.x(), py = me.y - s.y(), pz = me.z - s.z();
          for (std::int32_t j = begin; j < end; ++j) {
            const double dx = px - place[j].x, dy = py - place[j].y, dz = pz - place[j].z;
            const double reach = mine + place[j].w + listed[j].w;
            if (dx * dx + dy * dy + dz * dz < reach * reach)
              out.push_back({{static_cast<std::int32_t>(i), j}, static_cast<std::uint8_t>(code)});
          }
        };
        const int center = codeOf(0, 0, 0);
        for (int x = home[0] - cells.reach[0]; x <= home[0] + cells.reach[0]; ++x) {
          const int ix =
              cells.periodic[0] ? static_cast<int>(std::floor(static_cast<double>(x) / cells.count[0])) : 0;
          const int wx = x - ix * cells.count[0];
          if (wx < 0 || wx >= cells.count[0]) continue;
          for (int y = home[1] - cells.reach[1]; y <= home[1] + cells.reach[1]; ++y) {
            const int iy =
                cells.periodic[1] ? static_cast<int>(std::floor(static_cast<double>(y) / cells.count[1])) : 0;
            const int wy = y - iy * cells.count[1];
            if (wy < 0 || wy >= cells.count[1]) continue;
            for (int z = home[2] - cells.reach[2]; z <= home[2] + cells.reach[2]; ++z) {
              const int iz = cells.periodic[2]
                                 ? static_cast<int>(std::floor(static_cast<double>(z) / cells.count[2]))
                                 : 0;
              const int wz = z - iz * cells.count[2];
              if (wz < 0 || wz >= cells.count[2]) continue;
              const int cell = cells.index(wx, wy, wz), code = codeOf(ix, iy, iz);
              // Each pair once: partners later in storage; oneself only in "positive" images.
              const std::int32_t begin = std::max(cells.start[cell], static_cast<std::int32_t>(i) + 1);
              visit(begin, std::max(begin, cells.start[cell + 1]), code);
              if (code > center && cells.start[cell] <= i && i < cells.start[cell + 1])
                visit(static_cast<std::int32_t>(i), static_cast<std::int32_t>(i) + 1, code);
            }
          }
        }
      }
    }
  });

  std::size_t total = 0;
  for (const auto& f : found)
    total += f.size();
  pairs_.clear();
  pairs_.reserve(total);
  shiftOf_.clear();
  imageKey_.clear();
  partnerIds_.clear();
  if (periodic_) {
    shiftOf_.reserve(total);
    imageKey_.reserve(total);
  }
  const int lastCode = static_cast<int>(codes_.size()) - 1;
  for (const auto& f : found)
    for (const Found& pair : f) {
      // Orient by id; turning a pair round mirrors its image.
      const bool swap = grains.id[pair.pair.a] > grains.id[pair.pair.b];
      const Pair oriented = swap ? Pair{pair.pair.b, pair.pair.a} : pair.pair;
      const int code = swap ? lastCode - pair.code : pair.code;
      pairs_.push_back(oriented);
      if (!periodic_) continue;
      shiftOf_.push_back(static_cast<std::uint8_t>(code));
      std::array<std::int64_t, 3> key{};
      for (int k = 0; k < 3; ++k)
        key[k] = codes_[code][k] - grains.image[oriented.b][k] + grains.image[oriented.a][k];
      imageKey_.push_back(packImage(key));
    }
}

std::array<int, 3> PairList::image(std::size_t p) const {
  return periodic_ ? codes_[shiftOf_[p]] : std::array<int, 3>{0, 0, 0};
}

void PairList::link(const GrainStore& grains) {
  const std::size_t n = grains.size();
  offsets_.assign(n + 1, 0);
  for (const Pair& p : pairs_) {
    ++offsets_[p.a + 1];
    ++offsets_[p.b + 1];
  }
  for (std::size_t i = 0; i < n; ++i)
    offsets_[i + 1] += offsets_[i];
  entries_.resize(2 * pairs_.size());
  std::vector<std::int32_t> cursor(offsets_.begin(), offsets_.end() - 1);
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    entries_[cursor[pairs_[p].a]++] = static_cast<std::int32_t>(p << 1);
    entries_[cursor[pairs_[p].b]++] = static_cast<std::int32_t>(p << 1 | 1);
  }
  const auto partner = [&](std::int32_t entry) {
    return grains.id[entry & 1 ? pairs_[entry >> 1].a : pairs_[entry >> 1].b];
  };
  for (std::size_t i = 0; i < n; ++i)
    std::sort(entries_.begin() + offsets_[i], entries_.begin() + offsets_[i + 1],
              [&](std::int32_t s, std::int32_t t) {
                const std::int64_t ps = partner(s), pt = partner(t);
                if (ps != pt) return ps < pt;
                const std::int64_t ks = imageKey(s >> 1), kt = imageKey(t >> 1);
                return ks != kt ? ks < kt : (s & 1) < (t & 1);
              });
  partnerIds_.resize(2 * pairs_.size());
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    partnerIds_[2 * p] = grains.id[pairs_[p].a];
    partnerIds_[2 * p + 1] = grains.id[pairs_[p].b];
  }
}

void PairList::carry(const PairList& old, const std::vector<std::int32_t>& oldIndex, const GrainStore& grains,
                     Parallel& parallel) {
  if (old.pairs_.empty() || old.offsets_.size() <= 1) return;
  parallel.forRange(static_cast<std::int64_t>(pairs_.size()), 4096,
                    [&](std::int64_t first, std::int64_t last) {
                      for (std::int64_t p = first; p < last; ++p) {
                        const std::size_t a = oldIndex[pairs_[p].a];
                        if (a + 1 >= old.offsets_.size()) continue; // the grain is new
                        const std::int64_t partner = partnerIds_[2 * p + 1];
                        for (std::int32_t k = old.offsets_[a]; k < old.offsets_[a + 1]; ++k) {
                          const std::int32_t entry = old.entries_[k];
                          const std::size_t q = entry >> 1;
                          if ((entry & 1) || !old.live_[q] || old.partnerIds_[2 * q + 1] != partner) continue;
                          if (periodic_ && old.imageKey_[q] != imageKey_[p]) continue;
                          live_[p] = 1;
                          std::copy_n(old.history_.data() + q * historySize_, historySize_,
                                      history_.data() + p * historySize_);
                          break;
                        }
                      }
                    });
}

std::size_t PairList::bytes() const {
  return pairs_.size() *
             (sizeof(Pair) + (periodic_ ? 1 + sizeof(std::int64_t) : 0) + 1 + 2 * sizeof(std::int64_t) +
              2 * sizeof(std::int32_t) + sizeof(double) * (historySize_ + outputSize_)) +
         offsets_.size() * sizeof(std::int32_t);
}

} // namespace sandglass
