#include "sim/contact/pair_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace sandglass {

namespace {

constexpr double safety = 1e-9; ///< of a cell's width, against rounding
/// One above the other: the grains around them still fit into registers nearly as well as those around one.
/// Not around a periodic box, where cells might be met twice.
constexpr std::int64_t cellsTogether = 3;

int floorDivide(int a, int b) {
  return a >= 0 ? a / b : -((b - 1 - a) / b);
}

struct Window {
  int low, high; ///< cells, beyond the grid where it is periodic
};

/// Cells of `there` along one axis in which partners of the grains of cell `at` of `here` may stand.
Window window(const CellGrid::Level& here, const CellGrid::Level& there, int at, int axis, bool periodic) {
  Window w;
  if (&here == &there) {
    w = {at - here.look[axis], at + here.look[axis]};
  } else {
    const double cutoff = here.reach + there.reach + safety * here.width[axis];
    const double low = here.lower[axis] + at * here.width[axis] - cutoff - there.lower[axis];
    w.low = static_cast<int>(std::floor(low * there.perWidth[axis] - safety));
    w.high =
        static_cast<int>(std::floor((low + here.width[axis] + 2.0 * cutoff) * there.perWidth[axis] + safety));
  }
  if (!periodic) w = {std::max(w.low, 0), std::min(w.high, there.count[axis] - 1)};
  return w;
}

/// Orders a row by (partner, code).
void sortRow(std::int32_t* partner, std::uint8_t* code, std::int64_t size) {
  const auto key = [&](std::int64_t k) {
    return static_cast<std::int64_t>(partner[k]) << 8 | (code ? code[k] : 0);
  };
  bool sorted = true;
  for (std::int64_t k = 1; k < size; ++k)
    sorted &= key(k - 1) < key(k);
  if (sorted) return;
  thread_local std::vector<std::int64_t> row;
  row.resize(static_cast<std::size_t>(size));
  for (std::int64_t k = 0; k < size; ++k)
    row[k] = key(k);
  std::sort(row.begin(), row.end());
  for (std::int64_t k = 0; k < size; ++k) {
    partner[k] = static_cast<std::int32_t>(row[k] >> 8);
    if (code) code[k] = static_cast<std::uint8_t>(row[k] & 255);
  }
}

} // namespace

std::int64_t spreadRows(const std::int32_t* length, std::int64_t first, std::int64_t grains,
                        std::vector<std::int32_t>& owner) {
  constexpr std::int32_t atOnce = CellSearch::writeAhead;
  std::int64_t total = 0;
  for (std::int64_t i = 0; i < grains; ++i)
    total += length[i];
  if (owner.size() < static_cast<std::size_t>(total + atOnce)) owner.resize(total + atOnce);
  std::int32_t* to = owner.data();
  for (std::int64_t i = 0; i < grains; ++i, to += length[i - 1]) // most rows are shorter than a register
    for (std::int32_t k = 0; k < length[i]; k += atOnce)
      std::fill_n(to + k, atOnce, static_cast<std::int32_t>(first + i));
  return total;
}

/// Cells one above the other on some level, in one image along x and y.
struct PairSearch::Column {
  std::int32_t firstCell;
  int level;
  int code; ///< of the image with no shift along z; shifts along z add to it
};

struct PairSearch::Scratch {
  std::vector<Column> columns;
  std::vector<Stretch> stretches; ///< longer than `count`
  int count = 0;
  std::int64_t most = 0;     ///< grains in all stretches
  std::int32_t furthest = 0; ///< end of the last one
  bool shifted = false;      ///< some stretch is seen in another image
};

PairSearch::PairSearch(const CellGrid& grid, const ImageCodes& codes, const GrainColumns& columns,
                       KernelWidth width)
    : grid_(grid), codes_(codes), columns_(columns), search_(cellSearcher(width)),
      imaged_(codes.image.size() > 1), together_(grid.periodic()[2] ? 1 : cellsTogether) {
  // A finer cell can see one cell more of a coarser level.
  const int beyond = grid.levels().size() > 1 ? 3 : 1;
  for (const CellGrid::Level& level : grid.levels())
    for (int k = 0; k < 3; ++k)
      thin_ = thin_ || (grid.periodic()[k] && level.count[k] < 2 * level.look[k] + beyond);
}

void PairSearch::openColumn(std::size_t home, int x, int y, Scratch& scratch) const {
  scratch.columns.clear();
  const CellGrid::Level& here = grid_.levels()[home];
  const auto& periodic = grid_.periodic();
  const std::int32_t own = here.firstCell + (x * here.count[1] + y) * here.count[2];
  for (std::size_t l = home; l < grid_.levels().size(); ++l) {
    const CellGrid::Level& there = grid_.levels()[l];
    const Window wx = window(here, there, x, 0, periodic[0]), wy = window(here, there, y, 1, periodic[1]);
    for (int u = wx.low; u <= wx.high; ++u)
      for (int v = wy.low; v <= wy.high; ++v) {
        const int ix = periodic[0] ? floorDivide(u, there.count[0]) : 0;
        const int iy = periodic[1] ? floorDivide(v, there.count[1]) : 0;
        if (!codes_.holds(ix, iy, 0)) continue;
        const std::int32_t column =
            there.firstCell +
            ((u - ix * there.count[0]) * there.count[1] + v - iy * there.count[1]) * there.count[2];
        // Each pair once: earlier columns hold earlier grains only.
        if (column >= own) scratch.columns.push_back({column, static_cast<int>(l), codes_.of(ix, iy, 0)});
      }
  }
  if (imaged_)
    std::sort(scratch.columns.begin(), scratch.columns.end(),
              [](const Column& s, const Column& t) { return s.firstCell < t.firstCell; });
}

void PairSearch::openCells(std::size_t home, int lowest, int highest, std::int32_t firstGrain,
                           Scratch& scratch) const {
  const std::int32_t* start = grid_.start().data();
  const bool periodic = grid_.periodic()[2];
  const std::size_t columns = scratch.columns.size();
  const std::size_t room = columns * (2 * codes_.reach[2] + 1) + 1;
  if (scratch.stretches.size() < room) scratch.stretches.resize(room);
  const Column* const column = scratch.columns.data();
  Stretch* to = scratch.stretches.data();
  // Kept in registers: stores to the stretches could change what stands in memory.
  const int center = codes_.center();
  std::int64_t most = 0;
  std::int32_t furthest = 0;
  int shifted = 0;
  const auto add = [&](std::int32_t begin, std::int32_t end, int code) {
    *to = {begin, end, code};
    const bool holdsPartners = end > begin && end > firstGrain;
    to += holdsPartners;
    most += end - begin;
    furthest = std::max(furthest, end);
    shifted |= code ^ center;
  };
  for (std::size_t c = 0; c < columns;) {
    const int level = column[c].level;
    const CellGrid::Level& there = grid_.levels()[level];
    const CellGrid::Level& here = grid_.levels()[home];
    const Window w{window(here, there, lowest, 2, periodic).low,
                   window(here, there, highest, 2, periodic).high};
    if (w.low >= 0 && w.high < there.count[2]) {
      const std::int32_t *const low = start + w.low, *const high = start + w.high + 1;
      for (; c < columns && column[c].level == level; ++c)
        add(low[column[c].firstCell], high[column[c].firstCell], column[c].code);
      continue;
    }
    for (; c < columns && column[c].level == level; ++c) {
      Stretch* const before = to;
      const std::int32_t* cells = start + column[c].firstCell;
      for (int from = w.low; from <= w.high;) {
        const int image = floorDivide(from, there.count[2]), first = image * there.count[2];
        const int high = std::min(w.high, first + there.count[2] - 1);
        if (codes_.holds(0, 0, image))
          add(cells[from - first], cells[high - first + 1], column[c].code + image);
        from = high + 1;
      }
      std::sort(before, to, [](const Stretch& s, const Stretch& t) { return s.begin < t.begin; });
    }
  }
  scratch.count = static_cast<int>(to - scratch.stretches.data());
  scratch.shifted = shifted != 0;
  scratch.most = most;
  scratch.furthest = furthest;
}

/// Calls visit(scratch, first, last) for the grains of each few cells, `together` of them one above the
/// other, among first .. last - 1.
template <class Visit>
void PairSearch::eachCells(std::int64_t together, std::int64_t first, std::int64_t last,
                           Visit&& visit) const {
  const auto& start = grid_.start();
  const std::int64_t cells = static_cast<std::int64_t>(start.size()) - 1;
  Scratch scratch;
  std::int64_t cell = std::upper_bound(start.begin(), start.end(), first) - start.begin() - 1;
  std::size_t home = 0;
  while (cell < cells && start[cell] < last) {
    while (home + 1 < grid_.levels().size() && cell >= grid_.levels()[home + 1].firstCell)
      ++home;
    const CellGrid::Level& level = grid_.levels()[home];
    const std::int64_t column = (cell - level.firstCell) / level.count[2];
    const std::int64_t firstCell = level.firstCell + column * level.count[2];
    bool open = false;
    for (std::int64_t next; cell < firstCell + level.count[2]; cell = next) {
      next = std::min(cell + together, firstCell + level.count[2]);
      const std::int64_t begin = std::max<std::int64_t>(first, start[cell]);
      const std::int64_t end = std::min<std::int64_t>(last, start[next]);
      if (begin >= end) continue;
      if (!open)
        openColumn(home, static_cast<int>(column / level.count[1]), static_cast<int>(column % level.count[1]),
                   scratch);
      open = true;
      openCells(home, static_cast<int>(cell - firstCell), static_cast<int>(next - 1 - firstCell),
                static_cast<std::int32_t>(begin), scratch);
      visit(scratch, static_cast<std::int32_t>(begin), static_cast<std::int32_t>(end));
    }
  }
}

void PairSearch::rows(std::int64_t first, std::int64_t last, std::int64_t crossingFrom, std::int32_t* count,
                      FoundRows& found) const {
  found.size = found.crossing = 0;
  CellSearch task{};
  task.x = columns_.x;
  task.y = columns_.y;
  task.z = columns_.z;
  task.reach = columns_.reach;
  task.shift = codes_.shift.data();
  task.center = codes_.center();
  eachCells(together_, first, last, [&](const Scratch& scratch, std::int32_t begin, std::int32_t end) {
    const std::size_t room =
        static_cast<std::size_t>(found.size + scratch.most * (end - begin)) + CellSearch::writeAhead;
    if (found.partner.size() < room) found.partner.resize(room + room / 4);
    if (imaged_ && found.code.size() < found.partner.size()) found.code.resize(found.partner.size());
    task.stretches = scratch.stretches.data();
    task.stretchCount = scratch.count;
    task.shifted = scratch.shifted;
    task.first = begin;
    task.last = end;
    std::int32_t* partner = found.partner.data() + found.size;
    std::uint8_t* code = imaged_ ? found.code.data() + found.size : nullptr;
    std::int32_t* lengths = count + (begin - first);
    found.size += search_(task, partner, code, lengths);
    if (!thin_ && scratch.furthest <= crossingFrom) return;
    for (std::int32_t i = begin; i < end; ++i) {
      const std::int32_t length = *lengths++;
      if (thin_) sortRow(partner, code, length);
      for (std::int32_t k = length; k > 0 && partner[k - 1] >= crossingFrom; --k)
        ++found.crossing;
      partner += length;
      if (code) code += length;
    }
  });
}

std::int64_t PairSearch::distanceTests() const {
  std::int64_t tests = 0; // of one cell at a time
  eachCells(1, 0, columns_.grains, [&](const Scratch& scratch, std::int32_t begin, std::int32_t end) {
    for (std::int32_t i = begin; i < end; ++i)
      for (int k = 0; k < scratch.count; ++k) {
        const Stretch& s = scratch.stretches[k];
        tests += std::max(0, s.end - std::max(s.begin, s.code > codes_.center() ? i : i + 1));
      }
  });
  return tests;
}

} // namespace sandglass
