#include "sim/contact/pair_list.h"

#include "sim/base/error.h"
#include "sim/contact/contact_block.h"
#include "sim/contact/pair_carry.h"
#include "sim/contact/pair_order.h"

#include <fmt/format.h>

#include <algorithm>

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
  now_.groupExtras.assign(1, 0);
}

void PairList::build(GrainStore& grains, double range, Parallel& parallel,
                     const std::vector<std::uint8_t>& drop, const Allow& allow) {
  grid_.sort(grains, domain_, range, parallel, drop, memory_);
  grains.reorder(grid_.order(), parallel, memory_);
  std::swap(now_, past_);
  std::swap(now_.history, past_.history); // stays
  PairCarrier::retire(past_);
  now_.grains = static_cast<std::int64_t>(grains.size());
  lendMemory(parallel);
  fillColumns(grains, range, parallel, allow);

  if (periodic_) now_.codes = ImageCodes(domain_, 2.0 * grid_.largestReach());
  cut(now_.grains);
  search(parallel);
  layOut();
  writeRows(grains, parallel);
  const auto outputs = static_cast<std::size_t>((crossing_.end * outputStride_ + 3) / 4);
  if (memory_.size() < outputs) memory_.resize(outputs);
  link(parallel);
  findPlaces(parallel);
}

/// Room for the columns and for the old histories.
void PairList::lendMemory(Parallel& parallel) {
  const std::size_t columns = GrainColumns::numbers(now_.grains), old = now_.history.size(),
                    zeros = static_cast<std::size_t>(lane * historySize_);
  const std::size_t quads = (columns + old + zeros) / 4 + 1;
  if (memory_.size() < quads) memory_.resize(quads);
  double* const memory = &memory_[0].x;
  columns_ = GrainColumns(now_.grains, memory);
  pastHistory_ = memory + columns;
  parallel.forRange(static_cast<std::int64_t>(old), 16384, [&](std::int64_t first, std::int64_t last) {
    std::copy(now_.history.begin() + first, now_.history.begin() + last, pastHistory_ + first);
  });
  std::fill_n(pastHistory_ + old, zeros, 0.0);
}

void PairList::fillColumns(GrainStore& grains, double range, Parallel& parallel, const Allow& allow) {
  const std::int64_t n = static_cast<std::int64_t>(grains.size());
  parallel.forRange((n + group - 1) / group, grainsPerPiece / group, [&](std::int64_t from, std::int64_t to) {
    for (std::int64_t g = from; g < to; ++g) {
      const std::int64_t first = g * group, last = std::min(n, first + group);
      for (std::int64_t i = first; i < last; ++i) {
        const Quad q = grains.place[i];
        grains.listed[i] = {q.x, q.y, q.z, grains.listed[i].w};
        columns_.x[i] = q.x;
        columns_.y[i] = q.y;
        columns_.z[i] = q.z;
        columns_.reach[i] = q.w + 0.5 * range;
      }
      if (allow) allow(first, last);
      for (std::int64_t i = first; i < last; ++i)
        columns_.reach[i] += grains.listed[i].w;
    }
  });
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

void PairList::search(Parallel& parallel) {
  rowLength_.resize(static_cast<std::size_t>(now_.grains));
  const PairSearch search(grid_, now_.codes, columns_, bestKernelWidth());
  parallel.forRange(static_cast<std::int64_t>(blocks_.size()), 1, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t b = first; b < last; ++b) {
      Block& block = blocks_[b];
      search.rows(block.firstGrain, block.lastGrain, chunkGrains_[block.chunk].end,
                  rowLength_.data() + block.firstGrain, block.rows);
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
  makeRoom(now_.pairs, at, 1);
  if (periodic_) makeRoom(now_.shiftOf, at, 1); // and one more each to retire
  makeRoom(now_.history, at * historySize_ / (single_ ? 2 : 1));
  // Loops look a block ahead.
  quiet_.assign(static_cast<std::size_t>(historySize_ > 0 ? at + ContactBlock::capacity : 0), 0);
  if (keepsLive_) makeRoom(now_.live, at, 1);
  groupEnd_.resize(static_cast<std::size_t>(now_.groups()));
  groupReach_.resize(groupEnd_.size());
  for (const Range& pad : pads)
    fillPadding(pad.begin, pad.end);
}

void PairList::fillPadding(std::int64_t from, std::int64_t to) {
  for (std::int64_t p = from; p < to; ++p) {
    now_.pairs[p] = {static_cast<std::int32_t>(now_.grains), static_cast<std::int32_t>(now_.grains + 1)};
    if (periodic_) now_.shiftOf[p] = static_cast<std::uint8_t>(now_.codes.center());
    if (keepsLive_) now_.live[p] = 0;
    for (int k = 0; k < historySize_; ++k)
      setHistory(p, k, 0.0);
  }
}

void PairList::writeRows(const GrainStore& grains, Parallel& parallel) {
  const bool carries = historySize_ > 0 || keepsLive_;
  const std::int64_t* id = grains.id.data();
  const auto noShift = static_cast<std::uint8_t>(now_.codes.center());
  parallel.forRange(static_cast<std::int64_t>(blocks_.size()), 1, [&](std::int64_t first, std::int64_t last) {
    PairOrder order;
    PairCarrier carrier(past_, pastHistory_, now_, grid_.order(), grid_.wrapped(), historySize_, single_);
    for (std::int64_t b = first; b < last; ++b) {
      const Block& block = blocks_[b];
      const std::int64_t chunkEnd = chunkGrains_[block.chunk].end;
      const std::int32_t* partner = block.rows.partner.data();
      const std::uint8_t* code = periodic_ ? block.rows.code.data() : nullptr;
      std::int64_t inside = block.firstPair, crossing = block.firstCrossing;
      for (std::int64_t first = block.firstGrain; first < block.lastGrain; first += group) {
        const std::int64_t last = std::min(first + group, block.lastGrain);
        const std::int64_t* place =
            order.place({first, last, rowLength_.data() + first, partner, code, chunkEnd}, columns_, grains,
                        now_.codes.shift.data(), inside, crossing);
        std::int64_t reach = last - 1;
        for (std::int64_t i = first; i < last; ++i) {
          const auto me = static_cast<std::int32_t>(i);
          const std::int64_t mine = id[i], length = rowLength_[i];
          for (std::int64_t k = 0; k < length; ++k) {
            const std::int32_t j = partner[k];
            const bool turned = mine > id[j]; // oriented by id
            now_.pairs[place[k]] = {turned ? j : me, turned ? me : j};
            if (!code) continue;
            const int seen = code[k]; // turning a pair round mirrors its image
            now_.shiftOf[place[k]] = static_cast<std::uint8_t>(turned ? now_.codes.mirrored(seen) : seen);
          }
          std::int64_t k = length; // partners ascend
          while (k > 0 && (partner[k - 1] >= chunkEnd || (code && code[k - 1] != noShift)))
            --k;
          if (k > 0) reach = std::max<std::int64_t>(reach, partner[k - 1]);
          if (carries) carrier.carry(i, partner, length, place);
          partner += length;
          place += length;
          if (code) code += length;
        }
        groupEnd_[first / group] = inside;
        groupReach_[first / group] = reach;
      }
    }
  });
}

std::vector<double> PairList::histories() const {
  const auto numbers = [&](const auto* all) {
    return std::vector<double>(all, all + now_.entries * historySize_);
  };
  return single_ ? numbers(reinterpret_cast<const float*>(now_.history.data()))
                 : numbers(now_.history.data());
}

bool PairList::setHistories(const std::vector<double>& all) {
  if (all.size() != static_cast<std::size_t>(now_.entries * historySize_)) return false;
  double* const to = now_.history.data();
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
  std::size_t total = now_.bytes() + past_.bytes() + memory_.capacity() * sizeof(Quad) +
                      (groupEnd_.capacity() + groupReach_.capacity()) * sizeof(std::int64_t) +
                      quiet_.capacity() + grid_.bytes() + rowLength_.capacity() * sizeof(std::int32_t) +
                      filled_.capacity() + places_.capacity() * sizeof(std::int32_t) +
                      lent_.capacity() * sizeof(Extra) + groupLent_.capacity() * sizeof(std::int32_t);
  for (const Block& block : blocks_)
    total += block.rows.bytes();
  return total;
}

} // namespace sandglass
