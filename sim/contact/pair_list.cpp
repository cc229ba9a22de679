#include "sim/contact/pair_list.h"

#include "sim/base/error.h"
#include "sim/contact/contact_block.h"
#include "sim/contact/pair_carry.h"
#include "sim/contact/pair_order.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace sandglass {

namespace {

constexpr std::int64_t grainsPerPiece = 2048;
constexpr std::int64_t groupsPerBlock = 8, mostBlocks = 64; ///< least and most

/// Three small signed counters in one integer that orders like the tuple.
std::int64_t packImage(const std::array<std::int64_t, 3>& n) {
  constexpr std::int64_t bias = 1 << 20, base = 1 << 21;
  return ((n[0] + bias) * base + (n[1] + bias)) * base + (n[2] + bias);
}

std::int64_t padded(std::int64_t n) {
  return (n + PairList::lane - 1) / PairList::lane * PairList::lane;
}

/// Pairs between chunks cost twice: chunks of a cube of grains are five layers thick or more.
std::int64_t chunksOf(std::int64_t grains) {
  constexpr std::int64_t layers = 5, fewest = 4096, most = 16;
  const auto fits = [&](std::int64_t chunks) {
    const std::int64_t edge = layers * chunks;
    return chunks <= most && edge * edge * edge <= grains;
  };
  std::int64_t chunks = 1;
  while (grains >= fewest && fits(2 * chunks))
    chunks *= 2;
  return chunks;
}

} // namespace

PairList::PairList(const Domain& domain, int historySize, int outputStride, bool keepsLive, bool single)
    : domain_(domain), historySize_(historySize), outputStride_(outputStride), keepsLive_(keepsLive),
      single_(single), memory_(1) {
  for (int k = 0; k < 3; ++k)
    periodic_ = periodic_ || domain.periodic[k];
}

void PairList::build(GrainStore& grains, double range, Parallel& parallel,
                     const std::vector<std::uint8_t>& drop, const Allowance& allowance) {
  grid_.sort(grains, domain_, range, parallel, drop, memory_, allowance);
  const auto n = static_cast<std::int64_t>(grid_.order().size());
  makeRoom(columnMemory_, static_cast<std::int64_t>(GrainColumns::numbers(n)));
  columns_ = GrainColumns(n, columnMemory_.data());
  const auto fill = [&](std::int64_t first, std::int64_t last) {
    fillColumns(grains, range, allowance, first, last);
  };
  static_assert(group == GrainStore::run);
  grains.reorder(grid_.order(), parallel, memory_,
                 allowance ? GrainStore::Placed(fill) : GrainStore::Placed());
  if (!allowance) fill(0, n);
  std::swap(static_cast<PairKeys&>(now_), past_);
  now_.grains = n;

  if (periodic_) now_.codes = ImageCodes(domain_, 2.0 * grid_.largestReach());
  cut(now_.grains);
  search(grains, parallel);
  layOut();
  writeRows(grains, parallel);
  carryHistories(parallel);
  const auto outputs = static_cast<std::size_t>((crossing_.end * outputStride_ + 3) / 4);
  if (memory_.size() < outputs) memory_.resize(outputs);
  findCrossings(parallel);
  findRing();
}

/// Columns and `listed` of the grains of a group, or of all.
void PairList::fillColumns(GrainStore& grains, double range, const Allowance& allowance, std::int64_t first,
                           std::int64_t last) {
  double fastest = 0.0;
  for (std::int64_t i = first; allowance && i < last; ++i)
    fastest = std::max(fastest, grains.motion[i].vec().squaredNorm());
  const double allowed = allowance ? allowance(std::sqrt(fastest)) : 0.0;
  for (std::int64_t i = first; i < last; ++i) {
    const Quad q = grains.place[i];
    const double motion = allowance ? allowed : grains.listed[i].w;
    grains.listed[i] = {q.x, q.y, q.z, motion};
    columns_.x[i] = q.x;
    columns_.y[i] = q.y;
    columns_.z[i] = q.z;
    columns_.radius[i] = q.w;
    columns_.reach[i] = q.w + 0.5 * range + motion;
  }
}

/// Chunks and blocks of whole groups.
void PairList::cut(std::int64_t grains) {
  const std::int64_t groups = now_.groups();
  const std::int64_t chunks = chunksOf(grains);
  const auto firstGrain = [&](std::int64_t g) { return std::min(g * group, grains); };
  chunkGrains_.clear();
  std::size_t used = 0;
  for (std::int64_t c = 0; c < chunks; ++c) {
    const std::int64_t begin = groups * c / chunks, end = groups * (c + 1) / chunks;
    chunkGrains_.push_back({firstGrain(begin), firstGrain(end)});
    const std::int64_t count =
        std::clamp<std::int64_t>((end - begin) / groupsPerBlock, 1, mostBlocks / chunks);
    for (std::int64_t b = 0; b < count; ++b) {
      if (used == blocks_.size()) blocks_.emplace_back();
      Block& block = blocks_[used++]; // keeps its memory
      block.firstGrain = firstGrain(begin + (end - begin) * b / count);
      block.lastGrain = firstGrain(begin + (end - begin) * (b + 1) / count);
      block.chunk = c;
    }
  }
  blocks_.resize(used);
}

/// Finds all rows, and where in its block each pair stands.
void PairList::search(const GrainStore& grains, Parallel& parallel) {
  rows_.length.resize(static_cast<std::size_t>(now_.grains));
  rows_.first.resize(rows_.length.size());
  rows_.ofGroup.resize(static_cast<std::size_t>(now_.groups()));
  groupEnd_.resize(static_cast<std::size_t>(now_.groups()));
  groupReach_.resize(groupEnd_.size());
  groupLast_.resize(groupEnd_.size());
  const PairSearch search(grid_, now_.codes, columns_, bestKernelWidth());
  parallel.forRange(static_cast<std::int64_t>(blocks_.size()), 1, [&](std::int64_t first, std::int64_t last) {
    PairOrder order;
    for (std::int64_t b = first; b < last; ++b) {
      Block& block = blocks_[b];
      const std::int64_t chunkEnd = chunkGrains_[block.chunk].end;
      search.rows(block.firstGrain, block.lastGrain, chunkEnd, rows_.length.data() + block.firstGrain,
                  block.rows);
      std::int32_t at = 0;
      for (std::int64_t i = block.firstGrain; i < block.lastGrain; ++i) {
        rows_.first[i] = at;
        at += rows_.length[i];
      }
      std::fill(rows_.ofGroup.begin() + block.firstGrain / group,
                rows_.ofGroup.begin() + (block.lastGrain + group - 1) / group, &block.rows);
      block.rows.place.resize(block.rows.partner.size());
      std::int64_t inside = 0, crossing = 0;
      for (std::int64_t i = block.firstGrain; i < block.lastGrain; i += group) {
        const std::int32_t from = rows_.first[i];
        order.place(
            {i, std::min(i + group, block.lastGrain), rows_.length.data() + i,
             block.rows.partner.data() + from, periodic_ ? block.rows.code.data() + from : nullptr, chunkEnd},
            columns_, grains, now_.codes.shift.data(), inside, crossing, block.rows.place.data() + from);
        groupEnd_[i / group] = inside;
      }
    }
  });
}

/// Where the rows of each block go.
void PairList::layOut() {
  const std::size_t chunks = chunkGrains_.size();
  chunkPairs_.assign(chunks, {});
  chunkCrossing_.assign(chunks, {});
  std::int64_t at = 0;
  size_ = 0;
  for (Block& block : blocks_) {
    block.firstCrossing = at;
    if (block.firstGrain == chunkGrains_[block.chunk].begin) chunkCrossing_[block.chunk].begin = at;
    at += block.rows.crossing;
    size_ += block.rows.size;
    chunkCrossing_[block.chunk].end = at;
  }
  const std::int64_t crossings = at;
  crossing_ = {0, at = padded(at)};
  std::int64_t chunk = -1;
  std::vector<Range> pads{{crossings, at}};
  const auto close = [&] {
    if (chunk < 0) return;
    pads.push_back({at, padded(at)});
    chunkPairs_[chunk].end = at = padded(at);
  };
  for (Block& block : blocks_) {
    if (block.chunk != chunk) {
      close();
      chunk = block.chunk;
      chunkPairs_[chunk].begin = at;
    }
    block.firstPair = at;
    at += block.rows.size - block.rows.crossing;
  }
  close();
  if (at >= std::int64_t{1} << 30)
    throw RunError(fmt::format(
        "the list of pairs has {} entries; at most 2^30 are possible: use fewer grains or a smaller skin",
        at));

  now_.entries = at;
  makeRoom(now_.pairs, at);
  if (periodic_) makeRoom(now_.shiftOf, at);
  // Loops look a block ahead.
  quiet_.assign(static_cast<std::size_t>(historySize_ > 0 ? at + ContactBlock::capacity : 0), 0);
  if (keepsLive_) now_.live.assign(static_cast<std::size_t>(at), 0);
  for (const Range& pad : pads)
    fillPadding(pad.begin, pad.end);
}

void PairList::fillPadding(std::int64_t from, std::int64_t to) {
  for (std::int64_t p = from; p < to; ++p) {
    now_.pairs[p] = {static_cast<std::int32_t>(now_.grains), static_cast<std::int32_t>(now_.grains + 1)};
    if (periodic_) now_.shiftOf[p] = static_cast<std::uint8_t>(now_.codes.center());
  }
}

void PairList::writeRows(const GrainStore& grains, Parallel& parallel) {
  parallel.forRange(static_cast<std::int64_t>(blocks_.size()), 1, [&](std::int64_t from, std::int64_t to) {
    std::vector<std::int32_t> owner;
    for (std::int64_t b = from; b < to; ++b)
      for (std::int64_t first = blocks_[b].firstGrain; first < blocks_[b].lastGrain; first += group)
        writeGroup(grains, blocks_[b], first, owner);
  });
}

/// The rows of a group. There is no branch on the order of ids, which cannot be foreseen.
void PairList::writeGroup(const GrainStore& grains, Block& block, std::int64_t first,
                          std::vector<std::int32_t>& owners) {
  const std::int64_t g = first / group, last = std::min(first + group, block.lastGrain);
  const std::int64_t count = spreadRows(rows_.length.data() + first, first, last - first, owners);
  const auto chunkEnd = static_cast<std::int32_t>(chunkGrains_[block.chunk].end);
  const auto firstPair = static_cast<std::int32_t>(block.firstPair),
             firstCrossing = static_cast<std::int32_t>(block.firstCrossing);
  const std::int64_t* const id = grains.id.data();
  const std::int32_t *const owner = owners.data(), *const partner =
                                                       block.rows.partner.data() + rows_.first[first];
  std::int32_t* const place = block.rows.place.data() + rows_.first[first];
  auto* const pairs = reinterpret_cast<char*>(now_.pairs.data());
  const std::uint8_t* const code = periodic_ ? block.rows.code.data() + rows_.first[first] : nullptr;
  std::uint8_t* const shiftOf = now_.shiftOf.data();
  const int mirror = now_.codes.mirrored(0), center = now_.codes.center();
  auto furthest = static_cast<std::int32_t>(last - 1), reach = furthest;
  for (std::int64_t k = 0; k < count; ++k) {
    const std::int32_t i = owner[k], j = partner[k], ifInside = -static_cast<std::int32_t>(j < chunkEnd);
    const std::int32_t p = place[k] + ((firstPair & ifInside) | (firstCrossing & ~ifInside));
    place[k] = p;
    furthest = std::max(furthest, j & ifInside);
    const int ifTurned = -static_cast<int>(id[i] > id[j]); // pairs are oriented by id
    const std::uint64_t pair = static_cast<std::uint32_t>(i) | static_cast<std::uint64_t>(j) << 32;
    const std::uint64_t oriented = std::rotl(pair, ifTurned & 32);
    std::memcpy(pairs + sizeof oriented * static_cast<std::size_t>(p), &oriented, sizeof oriented);
    if (!code) continue;
    const int seen = code[k]; // turning a pair round mirrors its image
    shiftOf[p] = static_cast<std::uint8_t>(seen + ((mirror - 2 * seen) & ifTurned));
    reach = std::max(reach, j & ifInside & -static_cast<std::int32_t>(seen == center));
  }
  groupEnd_[g] += firstPair;
  groupReach_[g] = code ? reach : furthest;
  groupLast_[g] = furthest / static_cast<std::int32_t>(group);
}

/// New histories, where columns and records were, and the old ones to memory.
void PairList::carryHistories(Parallel& parallel) {
  if (historySize_ == 0 && !keepsLive_) return;
  constexpr std::int64_t pairsPerPiece = 8192, quad = 4;
  const std::int64_t numbers = now_.entries * historySize_ / (single_ ? 2 : 1);
  if (memory_.size() < static_cast<std::size_t>(numbers / quad)) makeRoom(memory_, numbers / quad);
  std::swap(memory_, now_.history);
  parallel.forRange(numbers / quad, pairsPerPiece, [&](std::int64_t first, std::int64_t last) {
    std::fill(now_.history.begin() + first, now_.history.begin() + last, Quad{});
  });
  const std::vector<std::int32_t>& order = grid_.order();
  newOf_.assign(static_cast<std::size_t>(past_.grains), -1);
  for (std::size_t k = 0; k < order.size(); ++k)
    if (order[k] < past_.grains) newOf_[order[k]] = static_cast<std::int32_t>(k);
  const PairCarrier carrier(past_, now_, rows_, newOf_, grid_.wrapped());
  parallel.forRange(past_.entries / lane, pairsPerPiece / lane, [&](std::int64_t first, std::int64_t last) {
    carrier.carry(first * lane, last * lane, memory_.data(), now_.history.data(), historySize_, single_);
  });
}

std::vector<double> PairList::histories() const {
  const auto numbers = [&](const auto* all) {
    return std::vector<double>(all, all + now_.entries * historySize_);
  };
  return single_ ? numbers(reinterpret_cast<const float*>(now_.history.data()))
                 : numbers(reinterpret_cast<const double*>(now_.history.data()));
}

bool PairList::setHistories(const std::vector<double>& all) {
  if (all.size() != static_cast<std::size_t>(now_.entries * historySize_)) return false;
  double* const to = history();
  if (single_)
    std::transform(all.begin(), all.end(), reinterpret_cast<float*>(to),
                   [](double value) { return static_cast<float>(value); });
  else
    std::copy(all.begin(), all.end(), to);
  std::fill(quiet_.begin(), quiet_.end(), std::uint8_t{0});
  return true;
}

std::array<int, 3> PairList::image(std::int64_t p) const {
  return periodic_ ? now_.codes.image[now_.shiftOf[p]] : std::array<int, 3>{0, 0, 0};
}

std::int64_t PairList::imageKey(std::int64_t p, const GrainStore& grains) const {
  if (!periodic_) return 0;
  const auto [a, b] = now_.pairs[p];
  const std::array<int, 3> seen = image(p);
  std::array<std::int64_t, 3> key{};
  for (int k = 0; k < 3; ++k)
    key[k] = std::int64_t{seen[k]} - grains.image[b][k] + grains.image[a][k];
  return packImage(key);
}

std::size_t PairList::bytes() const {
  std::size_t total =
      now_.bytes() + past_.bytes() + memory_.capacity() * sizeof(Quad) +
      columnMemory_.capacity() * sizeof(double) +
      (groupEnd_.capacity() + groupReach_.capacity()) * sizeof(std::int64_t) + quiet_.capacity() +
      grid_.bytes() +
      (rows_.first.capacity() + rows_.length.capacity() + newOf_.capacity()) * sizeof(std::int32_t) +
      crossings_.capacity() * sizeof(PairSide) + groupCrossings_.capacity() * sizeof(std::int32_t);
  for (const Block& block : blocks_)
    total += block.rows.bytes();
  return total;
}

} // namespace sandglass
