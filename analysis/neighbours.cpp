#include "analysis/neighbours.h"

#include "analysis/cell_grid.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

namespace sandglass::analysis {

namespace {

/// Cells two fifths of the reach wide and a fifteenth along the rows: long runs, which hold 1.5 times the
/// points that are really in reach.
CellGrid gridFor(std::span<const Vec3> points, const Domain& domain, double reach) {
  return CellGrid(points, domain, reach / 2.5, 6);
}

/// Each bin is counted in so many places in turn: a counter that is raised again before its last value has
/// left the processor makes the loop wait, and a third of all points fall into one bin, that of the too far
/// ones.
constexpr std::size_t lanes = 4;

/// Distances from one centre to a run of points, as bin numbers; too far ones fall into bin `bins`.
class Binner {
public:
  Binner(const CellGrid& grid, const PairCountOptions& options)
      : x_(grid.coordinates(0)), y_(grid.coordinates(1)), z_(grid.coordinates(2)),
        inverseWidth_(options.bins / options.rMax), bins_(options.bins) {}

  template <class Histogram>
  void operator()(std::size_t begin, std::size_t end, double cx, double cy, double cz,
                  Histogram& histogram) const {
    // Whole vectors, whose last may reach beyond the run: runs are short, and a loop for what is left over
    // would take as long as all the rest.
    constexpr std::size_t chunk = 64, width = CellGrid::padding;
    int bin[chunk];
    const int last = static_cast<int>(bins_);
    for (std::size_t from = begin; from < end; from += chunk) {
      const std::size_t count = std::min(chunk, end - from);
      for (std::size_t at = 0; at < count; at += width)
        for (std::size_t j = at; j < at + width; ++j) {
          const double dx = x_[from + j] - cx, dy = y_[from + j] - cy, dz = z_[from + j] - cz;
          const double q = std::sqrt(dx * dx + dy * dy + dz * dz) * inverseWidth_;
          bin[j] = std::min(static_cast<int>(q), last); // runs hold no point that is very far
        }
      for (std::size_t j = 0; j < count; ++j)
        ++histogram[lanes * static_cast<std::size_t>(bin[j]) + j % lanes];
    }
  }
  std::size_t operator()(std::size_t j, double cx, double cy, double cz) const {
    const double dx = x_[j] - cx, dy = y_[j] - cy, dz = z_[j] - cz;
    const double q = std::sqrt(dx * dx + dy * dy + dz * dz) * inverseWidth_;
    return static_cast<std::size_t>(q < bins_ ? q : bins_);
  }

private:
  const double *x_, *y_, *z_;
  double inverseWidth_, bins_;
};

/// The shifts under which a point may see itself within reach.
std::vector<std::array<double, 3>> selfShifts(const CellGrid& grid, double reach) {
  std::array<int, 3> most{};
  for (int k = 0; k < 3; ++k)
    if (grid.period(k) > 0) most[k] = static_cast<int>(reach * (1 + 1e-9) / grid.period(k));
  std::vector<std::array<double, 3>> shifts;
  for (int a = -most[0]; a <= most[0]; ++a)
    for (int b = -most[1]; b <= most[1]; ++b)
      for (int c = -most[2]; c <= most[2]; ++c)
        if (a || b || c) shifts.push_back({a * grid.period(0), b * grid.period(1), c * grid.period(2)});
  return shifts;
}

} // namespace

std::vector<std::uint64_t> countPairs(std::span<const Vec3> points, const std::vector<char>& reference,
                                      const Domain& domain, const PairCountOptions& options) {
  const CellGrid grid = gridFor(points, domain, options.rMax);
  const Binner binner(grid, options);
  const std::size_t bins = static_cast<std::size_t>(options.bins);
  // When every point is a reference, each pair is visited from one side and counted twice.
  const bool half = reference.empty();
  tbb::enumerable_thread_specific<std::vector<std::uint64_t>> partial(
      [&] { return std::vector<std::uint64_t>(lanes * (bins + 1)); });
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), 256), [&](const auto& range) {
    auto& histogram = partial.local();
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      if (!half && !reference[grid.original(i)]) continue;
      const std::array<double, 3> c{grid.coordinates(0)[i], grid.coordinates(1)[i], grid.coordinates(2)[i]};
      grid.around(c, options.rMax, half ? static_cast<std::int64_t>(i) : -1,
                  [&](std::size_t begin, std::size_t end, const std::array<double, 3>& shift) {
                    binner(begin, end, c[0] - shift[0], c[1] - shift[1], c[2] - shift[2], histogram);
                  });
    }
  });
  std::vector<std::uint64_t> counts(bins + 1);
  for (const auto& histogram : partial)
    for (std::size_t b = 0; b < bins; ++b)
      for (std::size_t lane = 0; lane < lanes; ++lane)
        counts[b] += histogram[lanes * b + lane] * (half ? 2 : 1);

  // Self-images were counted like any other point; take them out (and the point itself, in a full search). A
  // half search visits them from one side only, in the half space of positive shifts.
  const auto shifts = selfShifts(grid, options.rMax);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!half && !reference[grid.original(i)]) continue;
    const std::array<double, 3> c{grid.coordinates(0)[i], grid.coordinates(1)[i], grid.coordinates(2)[i]};
    if (!half) --counts[0];
    if (options.selfImages) continue;
    for (const auto& s : shifts) {
      const bool forward = s > std::array<double, 3>{0, 0, 0};
      if (half && !forward) continue;
      counts[binner(i, c[0] - s[0], c[1] - s[1], c[2] - s[2])] -= half ? 2 : 1;
    }
  }
  counts.resize(bins);
  return counts;
}

std::vector<int> countNeighbours(std::span<const Vec3> points, const Domain& domain, double radius) {
  const CellGrid grid(points, domain, radius / 2);
  const double r2 = radius * radius;
  std::vector<int> count(points.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), 256), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const std::array<double, 3> c{grid.coordinates(0)[i], grid.coordinates(1)[i], grid.coordinates(2)[i]};
      int near = -1; // the point finds itself
      grid.around(c, radius, -1, [&](std::size_t begin, std::size_t end, const std::array<double, 3>& shift) {
        for (std::size_t j = begin; j < end; ++j) {
          double d2 = 0;
          for (int k = 0; k < 3; ++k) {
            const double d = grid.coordinates(k)[j] + shift[k] - c[k];
            d2 += d * d;
          }
          near += d2 < r2;
        }
      });
      count[grid.original(i)] = near;
    }
  });
  return count;
}

} // namespace sandglass::analysis
