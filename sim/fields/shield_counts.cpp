#include "sim/fields/shield_counts.h"

#include <immintrin.h>

#include <algorithm>
#include <cmath>

namespace sandglass {

namespace {

/// Movement bounds are sums of rounded numbers: a little more than they say.
constexpr double roundOff = 1e-9;

int clampedCell(double v, double origin, double perCell, int cells) {
  return static_cast<int>(std::clamp((v - origin) * perCell, 0.0, cells - 1.0));
}

} // namespace

int ShieldCounts::Columns::cellX(double v) const {
  return clampedCell(v, x0, perCell, nx);
}

int ShieldCounts::Columns::cellY(double v) const {
  return clampedCell(v, y0, perCell, ny);
}

void ShieldCounts::sortIntoColumns(const GrainStore& grains) {
  const std::size_t n = grains.size();
  Columns& c = columns_;
  double x1 = -1e300, y1 = -1e300, reach = 0.0;
  c.x0 = c.y0 = 1e300;
  for (std::size_t i = 0; i < n; ++i) {
    const Quad& p = grains.place[i];
    c.x0 = std::min(c.x0, p.x);
    c.y0 = std::min(c.y0, p.y);
    x1 = std::max(x1, p.x);
    y1 = std::max(y1, p.y);
    reach = std::max(reach, (p.w + grains.listed[i].w) * (1.0 + roundOff));
  }
  // Cells as wide as the furthest lateral reach of a pair, or wider where the grains are spread thin.
  const double area = std::max(x1 - c.x0, 1e-300) * std::max(y1 - c.y0, 1e-300);
  const double cell = std::max(2.0 * reach, std::sqrt(area / (4.0 * static_cast<double>(n) + 16.0)));
  c.perCell = 1.0 / cell;
  c.nx = static_cast<int>((x1 - c.x0) * c.perCell) + 1;
  c.ny = static_cast<int>((y1 - c.y0) * c.perCell) + 1;
  if (static_cast<double>(c.nx) * c.ny > 8.0 * static_cast<double>(n) + 64.0) { // a long thin row of grains
    c.perCell = 8.0 / std::max({x1 - c.x0, y1 - c.y0, 8.0 * cell});
    c.nx = static_cast<int>((x1 - c.x0) * c.perCell) + 1;
    c.ny = static_cast<int>((y1 - c.y0) * c.perCell) + 1;
  }
  c.first.assign(static_cast<std::size_t>(c.nx) * c.ny + 1, 0);
  const auto cellOf = [&](const Quad& p) { return c.cellX(p.x) * c.ny + c.cellY(p.y); };
  for (std::size_t i = 0; i < n; ++i)
    ++c.first[cellOf(grains.place[i]) + 1];
  for (std::size_t k = 1; k < c.first.size(); ++k)
    c.first[k] += c.first[k - 1];
  for (auto* column : {&c.x, &c.y, &c.z, &c.radius, &c.allowed})
    column->resize(n);
  c.grain.resize(n);
  for (std::size_t i = n; i-- > 0;) { // backwards, so that a cell's grains stand in storage order
    const Quad& p = grains.place[i];
    const std::int32_t at = --c.first[cellOf(p) + 1];
    c.grain[at] = static_cast<std::int32_t>(i);
    c.x[at] = p.x;
    c.y[at] = p.y;
    c.z[at] = p.z;
    c.radius[at] = p.w;
    c.allowed[at] = grains.listed[i].w * (1.0 + roundOff) + roundOff * p.w;
  }
  // first[k + 1] now is where cell k begins.
  c.first.erase(c.first.begin());
  c.first.push_back(static_cast<std::int32_t>(n));
}

void ShieldCounts::list(const GrainStore& grains, Parallel& parallel) {
  const auto n = static_cast<std::int64_t>(grains.size());
  certain_.assign(n, 0);
  counts_.resize(n);
  pieces_.resize((n + pieceSize - 1) / pieceSize);
  if (n == 0) return;
  sortIntoColumns(grains);
  parallel.forRange(static_cast<std::int64_t>(pieces_.size()), 4, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t piece = first; piece < last; ++piece)
      listPiece(grains, piece);
  });
}

void ShieldCounts::listPiece(const GrainStore& grains, std::int64_t index) {
  Piece& piece = pieces_[index];
  const Columns& c = columns_;
  const auto n = static_cast<std::int64_t>(grains.size());
  piece.firstDoubt.assign(1, 0);
  std::size_t found = 0;
  for (std::int64_t i = index * pieceSize; i < std::min(n, (index + 1) * pieceSize); ++i) {
    const Quad& p = grains.place[i];
    const double mine = grains.listed[i].w * (1.0 + roundOff) + roundOff * p.w;
    const int x = c.cellX(p.x), y = c.cellY(p.y);
    const int y0 = std::max(0, y - 1), y1 = std::min(c.ny - 1, y + 1);
    std::int32_t sure = 0;
    for (int cx = std::max(0, x - 1); cx <= std::min(c.nx - 1, x + 1); ++cx) {
      const std::int32_t end = c.first[cx * c.ny + y1 + 1];
      for (std::int32_t from = c.first[cx * c.ny + y0]; from < end; from += batch) {
        const int count = std::min(batch, end - from);
        std::int64_t answer[batch];
        judge(p, mine, from, count, answer);
        if (piece.doubts.size() < found + batch) piece.doubts.resize(2 * found + batch);
        // Without a branch: what comes next cannot be foretold.
        for (int k = 0; k < count; ++k) {
          const std::int32_t j = c.grain[from + k];
          piece.doubts[found] = j;
          found += (answer[k] == inDoubt) & (j != i);
          sure += answer[k] == shields;
        }
      }
    }
    certain_[i] = sure;
    piece.firstDoubt.push_back(static_cast<std::int32_t>(found));
  }
  piece.doubts.resize(found);
}

/// Whether the grains of the columns from `from` on shield a grain at p until the next listing.
void ShieldCounts::judge(const Quad& p, double mine, std::int32_t from, int count,
                         std::int64_t* answer) const {
  const double *x = columns_.x.data() + from, *y = columns_.y.data() + from, *z = columns_.z.data() + from,
               *radius = columns_.radius.data() + from, *allowed = columns_.allowed.data() + from;
#pragma GCC ivdep
  for (int k = 0; k < count; ++k) {
    const double margin = mine + allowed[k], reach = p.w + radius[k];
    const double dx = std::abs(p.x - x[k]), dy = std::abs(p.y - y[k]), above = p.z - z[k];
    const double aside = dx > dy ? dx : dy;
    const bool never = (aside >= reach + margin) | (above <= -margin);
    const bool always = (aside < reach - margin) & (above > margin);
    answer[k] = never ? std::int64_t{apart} : always ? std::int64_t{shields} : std::int64_t{inDoubt};
  }
}

void ShieldCounts::count(const GrainStore& grains, Parallel& parallel) {
  const auto n = static_cast<std::int64_t>(grains.size());
  const __m256d signs = _mm256_set1_pd(-0.0);
  const __m256d aside = _mm256_castsi256_pd(_mm256_set_epi64x(0, 0, -1, -1));
  const __m256d signsAside = _mm256_and_pd(signs, aside), lower = _mm256_set_pd(0.0, -0.0, -0.0, -0.0);
  parallel.forRange(static_cast<std::int64_t>(pieces_.size()), 4, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t index = first; index < last; ++index) {
      const Piece& piece = pieces_[index];
      for (std::int64_t i = index * pieceSize; i < std::min(n, (index + 1) * pieceSize); ++i) {
        const __m256d p = _mm256_load_pd(&grains.place[i].x), mine = _mm256_permute4x64_pd(p, 0xff);
        std::int32_t count = certain_[i];
        for (std::int32_t d = piece.firstDoubt[i - index * pieceSize];
             d < piece.firstDoubt[i - index * pieceSize + 1]; ++d) {
          // |dx| < reach, |dy| < reach, dz < 0, all at once.
          const __m256d q = _mm256_load_pd(&grains.place[piece.doubts[d]].x);
          const __m256d apart = _mm256_andnot_pd(signsAside, _mm256_sub_pd(q, p));
          const __m256d reach = _mm256_and_pd(aside, _mm256_add_pd(_mm256_permute4x64_pd(q, 0xff), mine));
          count += _mm256_testc_pd(_mm256_cmp_pd(apart, reach, _CMP_LT_OQ), lower);
        }
        counts_[i] = count;
      }
    }
  });
}

std::size_t ShieldCounts::doubts() const {
  std::size_t sum = 0;
  for (const Piece& piece : pieces_)
    sum += piece.doubts.size();
  return sum;
}

} // namespace sandglass
