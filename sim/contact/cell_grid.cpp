#include "sim/contact/cell_grid.h"

#include "sim/contact/image_codes.h"
#include "sim/contact/size_levels.h"

#include <immintrin.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <utility>

namespace sandglass {

namespace {

constexpr std::int64_t grainsPerPiece = 2048;
/// Rounding must not move a partner out of the cells that are looked through.
constexpr double safety = 1.0 + 1e-9;

struct Numbers {
  alignas(32) std::array<double, 4> at;
  explicit Numbers(__m256d v) { _mm256_store_pd(at.data(), v); }
};

/// The periodic box; without end along other directions.
class Box {
public:
  explicit Box(const Domain& domain) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
      periodic = periodic || domain.periodic[k];
      lower_[k] = domain.periodic[k] ? domain.lower[k] : -infinity;
      upper_[k] = domain.periodic[k] ? domain.upper[k] : infinity;
      extent_[k] = domain.upper[k] - domain.lower[k];
    }
  }
  bool periodic = false;

  bool holds(const Quad& q) const {
    return !((q.x < lower_[0]) | (q.x >= upper_[0]) | (q.y < lower_[1]) | (q.y >= upper_[1]) |
             (q.z < lower_[2]) | (q.z >= upper_[2]));
  }
  /// By how many boxes the grain had left.
  std::array<int, 3> wrap(Quad& q) const {
    std::array<int, 3> boxes{0, 0, 0};
    for (int k = 0; k < 3; ++k) {
      double& x = k == 0 ? q.x : k == 1 ? q.y : q.z;
      while (x >= upper_[k])
        x -= extent_[k], ++boxes[k];
      while (x < lower_[k])
        x += extent_[k], --boxes[k];
      if (x >= upper_[k]) x = lower_[k]; // x + L rounded up to the upper side
    }
    return boxes;
  }

private:
  std::array<double, 3> lower_{}, upper_{}, extent_{};
};

} // namespace

struct CellGrid::Bounds {
  __m256d low = _mm256_set1_pd(1e300), high = _mm256_set1_pd(-1e300); ///< positions, and radii in w
  __m256d slow = low, fast = high;                                    ///< of velocities, and 1/mass in w
  double allowed = 0.0; ///< largest motion, or square of the speed

  void take(const Quad& place, const Quad& motion,
            double allowance) { // numbers that are none are passed over
    const __m256d q = _mm256_load_pd(&place.x), v = _mm256_load_pd(&motion.x);
    low = _mm256_min_pd(q, low);
    high = _mm256_max_pd(q, high);
    slow = _mm256_min_pd(v, slow);
    fast = _mm256_max_pd(v, fast);
    allowed = std::max(allowed, allowance);
  }
  /// The last number where it is the same for all.
  static double same(__m256d least, __m256d greatest) {
    const double a = Numbers(least).at[3], b = Numbers(greatest).at[3];
    return a == b ? a : 0.0;
  }
  void merge(const Bounds& other) {
    low = _mm256_min_pd(low, other.low);
    high = _mm256_max_pd(high, other.high);
    slow = _mm256_min_pd(slow, other.slow);
    fast = _mm256_max_pd(fast, other.fast);
    allowed = std::max(allowed, other.allowed);
  }
};

/// Which cell a position lies in; what lies outside counts to the cells at the border.
struct CellGrid::Map {
  __m256d lower, perWidth;
  __m128i last, stride;
  std::int32_t firstCell;

  explicit Map(const Level& level)
      : lower(_mm256_setr_pd(level.lower[0], level.lower[1], level.lower[2], 0.0)),
        perWidth(_mm256_setr_pd(level.perWidth[0], level.perWidth[1], level.perWidth[2], 0.0)),
        last(_mm_setr_epi32(level.count[0] - 1, level.count[1] - 1, level.count[2] - 1, 0)),
        stride(_mm_setr_epi32(level.count[1] * level.count[2], level.count[2], 1, 0)),
        firstCell(level.firstCell) {}

  std::int32_t cellOf(const Quad& place) const {
    const __m256d scaled = _mm256_mul_pd(_mm256_sub_pd(_mm256_load_pd(&place.x), lower), perWidth);
    const __m128i along =
        _mm_min_epi32(_mm_max_epi32(_mm256_cvttpd_epi32(scaled), _mm_setzero_si128()), last);
    const __m128i terms = _mm_mullo_epi32(along, stride);
    const __m128i halves = _mm_add_epi32(terms, _mm_unpackhi_epi64(terms, terms));
    return firstCell + _mm_cvtsi128_si32(halves) + _mm_extract_epi32(halves, 1);
  }
};

void CellGrid::lay(const Domain& domain, const Bounds& bounds) {
  periodic_ = domain.periodic;
  const Numbers low(bounds.low), high(bounds.high);
  std::int64_t cells = 0;
  for (Level& level : levels_) {
    const double cutoff = 2.0 * level.reach * safety;
    double width = cutoff > 0.0 ? cutoff : 1e300;
    for (;;) { // wide empty spaces get larger cells, so memory follows the grains
      double total = 1.0;
      for (int k = 0; k < 3; ++k) {
        if (domain.periodic[k]) {
          const double length = domain.upper[k] - domain.lower[k];
          level.lower[k] = domain.lower[k];
          level.count[k] = static_cast<int>(std::clamp(std::floor(length / width), 1.0, 1e6));
          level.width[k] = length / level.count[k];
        } else {
          level.lower[k] = level.grains > 0 ? low.at[k] : 0.0;
          const double length = level.grains > 0 ? high.at[k] - low.at[k] : 0.0;
          level.count[k] = static_cast<int>(std::clamp(std::floor(length / width) + 1.0, 1.0, 1e6));
          level.width[k] = std::max(width, length / level.count[k]);
        }
        level.perWidth[k] = 1.0 / level.width[k];
        level.look[k] = !domain.periodic[k] && level.count[k] == 1
                            ? 0
                            : static_cast<int>(std::ceil(cutoff / level.width[k]));
        total *= level.count[k];
      }
      if (total <= 4.0 * static_cast<double>(level.grains) + 1000.0) break;
      width *= 1.26;
    }
    level.firstCell = static_cast<std::int32_t>(cells);
    cells += static_cast<std::int64_t>(level.count[0]) * level.count[1] * level.count[2];
  }
  start_.resize(static_cast<std::size_t>(cells) + 1);
}

void CellGrid::sort(GrainStore& grains, const Domain& domain, double range, Parallel& parallel,
                    const std::vector<std::uint8_t>& drop, AlignedVector<Quad>& scratch,
                    const Allowance& allowance) {
  const std::int64_t n = static_cast<std::int64_t>(grains.size());
  const auto stays = [&](std::int64_t i) { return drop.empty() || !drop[i]; };

  // Grains that go must not shape the grid: a list built anew from the positions of those that stay is the
  // same.
  const Box box(domain);
  wrapped_.resize(box.periodic ? grains.size() : 0);
  std::mutex guard;
  Bounds bounds;
  std::int64_t staying = 0;
  parallel.forRange(n, grainsPerPiece, [&](std::int64_t first, std::int64_t last) {
    Bounds mine;
    std::int64_t count = 0;
    for (std::int64_t i = first; i < last; ++i) {
      if (box.periodic) {
        wrapped_[i] = 0;
        if (!box.holds(grains.place[i])) {
          const std::array<int, 3> boxes = box.wrap(grains.place[i]);
          for (int k = 0; k < 3; ++k)
            grains.image[i][k] += boxes[k];
          wrapped_[i] = ImageCodes::pack(boxes);
        }
      }
      if (!stays(i)) continue;
      ++count;
      mine.take(grains.place[i], grains.motion[i],
                allowance ? grains.motion[i].vec().squaredNorm() : grains.listed[i].w);
    }
    const std::lock_guard lock(guard);
    bounds.merge(mine);
    staying += count;
  });

  oneRadius_ = Bounds::same(bounds.low, bounds.high);
  oneInverseMass_ = Bounds::same(bounds.slow, bounds.fast);
  if (allowance) bounds.allowed = allowance(std::sqrt(bounds.allowed));
  const double margin = bounds.allowed + 0.5 * range;
  const double most = Numbers(bounds.high).at[3] + margin, least = Numbers(bounds.low).at[3] + margin;
  const auto reachOf = [&](std::int64_t i) { return grains.place[i].w + margin; };
  std::array<int, SizeBins::count> levelOf{};
  if (most <= 1.5 * least || staying == 0) {
    levels_.assign(1, {staying, staying > 0 ? most : 0.0});
  } else {
    SizeBins bins;
    parallel.forRange(n, grainsPerPiece, [&](std::int64_t first, std::int64_t last) {
      SizeBins mine;
      for (std::int64_t i = first; i < last; ++i) {
        if (!stays(i)) continue;
        const double reach = reachOf(i);
        const int bin = SizeBins::of(reach, most);
        ++mine.grains[bin];
        mine.largest[bin] = std::max(mine.largest[bin], reach);
      }
      const std::lock_guard lock(guard);
      bins.merge(mine);
    });
    levelOf = chooseLevels(bins);
    levels_.assign(static_cast<std::size_t>(levelOf[0]) + 1, {});
    for (int k = 0; k < SizeBins::count; ++k) {
      Level& level = levels_[levelOf[k]];
      level.grains += bins.grains[k];
      level.reach = std::max(level.reach, bins.largest[k]);
    }
  }
  lay(domain, bounds);

  // A stable counting sort in two rounds, so that no thread needs counters for all cells: into buckets of
  // neighbouring cells, and within each bucket.
  const std::int64_t cellCount = static_cast<std::int64_t>(start_.size()) - 1;
  int bits = 0;
  while (cellCount >> bits > 512)
    ++bits;
  const std::int64_t buckets = (cellCount >> bits) + 1;
  const std::int64_t pieces =
      std::max<std::int64_t>(1, std::min<std::int64_t>(4 * parallel.threads(), n / grainsPerPiece));
  const bool oneLevel = levels_.size() == 1;
  const std::vector<Map> maps(levels_.begin(), levels_.end());
  struct Keyed {
    std::int32_t cell, grain;
  };
  const std::size_t quads =
      (static_cast<std::size_t>(n) * (sizeof(Keyed) + sizeof(std::int32_t))) / sizeof(Quad) + 1;
  if (scratch.size() < quads) scratch.resize(quads);
  Keyed* const keyed = reinterpret_cast<Keyed*>(scratch.data());
  std::int32_t* const cells = reinterpret_cast<std::int32_t*>(keyed + n);
  std::vector<std::int32_t> cursor(pieces * buckets, 0);
  parallel.forRange(pieces, 1, [&](std::int64_t firstPiece, std::int64_t lastPiece) {
    for (std::int64_t piece = firstPiece; piece < lastPiece; ++piece) {
      std::int32_t* count = cursor.data() + piece * buckets;
      for (std::int64_t i = n * piece / pieces; i < n * (piece + 1) / pieces; ++i) {
        cells[i] = -1;
        if (!stays(i)) continue;
        const Map& map = maps[oneLevel ? 0 : levelOf[SizeBins::of(reachOf(i), most)]];
        cells[i] = map.cellOf(grains.place[i]);
        ++count[cells[i] >> bits];
      }
    }
  });
  std::vector<std::int32_t> bucketStart(buckets + 1, 0);
  std::int32_t sum = 0;
  for (std::int64_t b = 0; b < buckets; ++b) {
    bucketStart[b] = sum;
    for (std::int64_t piece = 0; piece < pieces; ++piece) {
      const std::int32_t count = cursor[piece * buckets + b];
      cursor[piece * buckets + b] = sum;
      sum += count;
    }
  }
  bucketStart[buckets] = sum;
  order_.resize(staying);
  parallel.forRange(pieces, 1, [&](std::int64_t firstPiece, std::int64_t lastPiece) {
    for (std::int64_t piece = firstPiece; piece < lastPiece; ++piece) {
      std::int32_t* next = cursor.data() + piece * buckets;
      for (std::int64_t i = n * piece / pieces; i < n * (piece + 1) / pieces; ++i)
        if (const std::int32_t cell = cells[i]; cell >= 0)
          keyed[next[cell >> bits]++] = {cell, static_cast<std::int32_t>(i)};
    }
  });
  parallel.forRange(buckets, 8, [&](std::int64_t firstBucket, std::int64_t lastBucket) {
    for (std::int64_t b = firstBucket; b < lastBucket; ++b) {
      const std::int64_t first = b << bits, last = std::min(cellCount, (b + 1) << bits);
      const std::int32_t begin = bucketStart[b], end = bucketStart[b + 1];
      // start_ serves as the counters, and as the cursors shifted by one cell.
      std::fill(start_.begin() + first, start_.begin() + last, 0);
      for (std::int32_t k = begin; k < end; ++k)
        ++start_[keyed[k].cell];
      std::int32_t at = begin;
      for (std::int64_t c = first; c < last; ++c)
        at += std::exchange(start_[c], at);
      for (std::int32_t k = begin; k < end; ++k)
        order_[start_[keyed[k].cell]++] = keyed[k].grain;
      for (std::int64_t c = last - 1; c > first; --c)
        start_[c] = start_[c - 1];
      if (first < last) start_[first] = begin;
    }
  });
  start_[cellCount] = static_cast<std::int32_t>(staying);
}

std::size_t CellGrid::bytes() const {
  return (order_.capacity() + start_.capacity() + wrapped_.capacity()) * sizeof(std::int32_t);
}

} // namespace sandglass
