// The neighbour list against a brute-force search, including boxes thinner than the cut-off, and the layout
// that the particle loop relies on.

#include "sim/base/random.h"
#include "sim/contact/pair_list.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

using namespace sandglass;

namespace {

using Key = std::tuple<std::int64_t, std::int64_t, int, int, int>;

void fillAtRandom(GrainStore& store, int n, const Domain& domain, double smallest, double largest,
                  double allowed, std::uint64_t seed = 5) {
  store.imaged = domain.periodic[0] || domain.periodic[1] || domain.periodic[2];
  store.resize(n);
  for (int i = 0; i < n; ++i) {
    RandomStream random(seed, RandomPurpose::test, i);
    Vec3 x;
    for (int k = 0; k < 3; ++k)
      x[k] = random.uniform(domain.lower[k], domain.upper[k]);
    store.place[i] = {x.x(), x.y(), x.z(), random.uniform(smallest, largest)};
    store.motion[i].w = 1.0;
    store.listed[i].w = allowed * i / n;                     // unequal allowances
    store.id[i] = (static_cast<std::int64_t>(i) * 7919) % n; // ids in another order than storage
  }
}

std::set<Key> bruteForce(const GrainStore& g, const Domain& d, double margin) {
  std::set<Key> keys;
  const Vec3 L = d.upper - d.lower;
  const int n = static_cast<int>(g.size());
  const auto reach = [&](int k) { return d.periodic[k] ? 3 : 0; };
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b) {
      if (g.id[a] > g.id[b]) continue;
      const Quad p = g.place[a], q = g.place[b];
      const double r = p.w + q.w + margin + g.listed[a].w + g.listed[b].w;
      for (int x = -reach(0); x <= reach(0); ++x) {
        const double dx = p.x - (q.x + x * L[0]);
        if (std::abs(dx) >= r) continue;
        for (int y = -reach(1); y <= reach(1); ++y) {
          const double dy = p.y - (q.y + y * L[1]);
          if (std::abs(dy) >= r) continue;
          for (int z = -reach(2); z <= reach(2); ++z) {
            if (a == b && std::tuple(x, y, z) <= std::tuple(0, 0, 0)) continue;
            const double dz = p.z - (q.z + z * L[2]);
            if (dx * dx + dy * dy + dz * dz < r * r) keys.insert({g.id[a], g.id[b], x, y, z});
          }
        }
      }
    }
  return keys;
}

std::set<Key> keysOf(const PairList& list, const GrainStore& store) {
  std::set<Key> keys;
  for (std::int64_t p = 0; p < list.entries(); ++p) {
    if (list.isPadding(p)) continue;
    const auto [a, b] = list.pairs()[p];
    const auto image = list.image(p);
    if (!keys.insert({store.id[a], store.id[b], image[0], image[1], image[2]}).second)
      FAIL("pair " << p << " is listed twice");
  }
  return keys;
}

/// Sweeps the chunks as the particle loop does, with pair numbers for outputs: when a group of grains is
/// done, their rows of the ring and what crosses chunks must hold all their contacts, and nothing else.
void sweep(const PairList& list, std::map<std::int64_t, std::vector<std::int32_t>>& expected) {
  bool right = true, ordered = true;
  const std::int64_t rows = list.sumRows(), block = 64;
  CHECK((rows & (rows - 1)) == 0);
  CHECK(rows >= PairList::group);
  std::vector<std::vector<std::pair<std::int64_t, std::int32_t>>> ring(rows); // grain, entry
  std::int64_t crossing = 0;
  for (int c = 0; c < list.chunks(); ++c) {
    const auto [begin, end] = list.chunkPairs(c);
    std::int64_t next = begin;
    for (std::int64_t first = list.chunkGrains(c).begin; first < list.chunkGrains(c).end;
         first += PairList::group) {
      const std::int64_t g = first / PairList::group;
      while (next < list.groupEnd(g)) {
        for (std::int64_t p = next; p < std::min(next + block, end); ++p)
          for (const bool second : {false, true}) {
            const std::int64_t grain = second ? list.pairs()[p].b : list.pairs()[p].a;
            if (!list.isPadding(p))
              ring[grain & (rows - 1)].push_back({grain, static_cast<std::int32_t>(p << 1 | second)});
          }
        next = std::min(next + block, end);
      }
      std::map<std::int64_t, std::vector<std::int32_t>> found;
      const std::int64_t last = std::min<std::int64_t>(first + PairList::group, list.chunkGrains(c).end);
      for (std::int64_t i = first; i < last; ++i) {
        for (const auto& [grain, entry] : ring[i & (rows - 1)]) {
          right = right && grain == i;
          found[i].push_back(entry);
        }
        ring[i & (rows - 1)].clear();
      }
      ordered = ordered && list.groupCrossings(g).begin == crossing;
      crossing = list.groupCrossings(g).end;
      for (std::int64_t e = list.groupCrossings(g).begin; e < crossing; ++e) {
        const auto [grain, entry] = list.crossings()[e];
        ordered = ordered && grain >= first && grain < last;
        right = right && entry >> 1 < list.crossing().end;
        found[grain].push_back(entry);
      }
      for (std::int64_t i = first; i < last; ++i) {
        std::sort(found[i].begin(), found[i].end());
        std::sort(expected[i].begin(), expected[i].end());
        right = right && found[i] == expected[i];
      }
    }
    right = right && std::all_of(ring.begin(), ring.end(), [](const auto& row) { return row.empty(); });
  }
  CHECK(crossing == static_cast<std::int64_t>(list.crossings().size()));
  CHECK(ordered);
  CHECK(right);
}

/// Everything that the header promises about the arrays.
void checkLayout(PairList& list, const GrainStore& store) {
  const std::int64_t n = static_cast<std::int64_t>(store.size()), entries = list.entries();
  REQUIRE(entries % PairList::lane == 0);
  REQUIRE(static_cast<std::int64_t>(list.pairs().size()) == entries);
  REQUIRE(list.shiftOf().size() == (list.periodic() ? list.pairs().size() : 0));
  int chunks =
      1; // from 4096 grains on the largest power of two that leaves a cube's chunks five layers, at most 16
  while (n >= 4096 && chunks < 16 && std::pow(10.0 * chunks, 3) <= static_cast<double>(n))
    chunks *= 2;
  REQUIRE(list.chunks() == chunks);

  std::vector<int> chunkOf(n), sectionOf(entries, -1);
  std::int64_t grain = 0, at = list.crossing().end;
  REQUIRE(list.crossing().begin == 0);
  for (int c = 0; c < chunks; ++c) {
    const auto grains = list.chunkGrains(c), pairs = list.chunkPairs(c);
    REQUIRE(grains.begin == grain);
    REQUIRE((grains.begin % PairList::group == 0));
    REQUIRE((pairs.begin == at && pairs.begin % PairList::lane == 0));
    grain = grains.end;
    at = pairs.end;
    std::fill(chunkOf.begin() + grains.begin, chunkOf.begin() + grains.end, c);
    std::fill(sectionOf.begin() + pairs.begin, sectionOf.begin() + pairs.end, c);
  }
  REQUIRE((grain == n && at == entries));

  bool right = true;
  std::int64_t real = 0;
  std::map<std::int64_t, std::vector<std::int32_t>> expected;                  // contacts of a grain, by row
  std::vector<std::tuple<std::int64_t, std::int64_t, int, std::int64_t>> rows; // (row, partner, image, pair)
  for (std::int64_t p = 0; p < entries; ++p) {
    const auto [a, b] = list.pairs()[p];
    if (list.isPadding(p)) {
      right = right && a == n && b == n + 1;
      if (list.periodic()) right = right && list.image(p) == std::array<int, 3>{0, 0, 0};
      for (int k = 0; k < list.historySize(); ++k)
        right = right && list.historyOf(p, k) == 0.0;
      continue;
    }
    ++real;
    right = right && a < n && b < n && store.id[a] <= store.id[b];
    const std::int64_t row = std::min(a, b), other = std::max(a, b);
    if (sectionOf[p] < 0)
      right = right && chunkOf[a] != chunkOf[b];
    else
      right = right && chunkOf[a] == sectionOf[p] && chunkOf[b] == sectionOf[p];
    if (sectionOf[p] >= 0) { // rows end where groupEnd says
      const std::int64_t g = row / PairList::group;
      const bool first = g * PairList::group == list.chunkGrains(sectionOf[p]).begin;
      right = right && p < list.groupEnd(g) &&
              p >= (first ? list.chunkPairs(sectionOf[p]).begin : list.groupEnd(g - 1));
    }
    int image = list.periodic() ? list.shiftOf()[p] : 0;
    if (a != row) image = static_cast<int>(list.shifts().size()) - 1 - image;
    rows.push_back({row, other, image, p});
  }
  CHECK(right);
  CHECK(real == list.size());
  std::sort(rows.begin(), rows.end());
  for (const auto& [row, other, image, p] : rows) {
    const auto [a, b] = list.pairs()[p];
    expected[a].push_back(static_cast<std::int32_t>(p << 1));
    expected[b].push_back(static_cast<std::int32_t>(p << 1 | 1));
  }
  sweep(list, expected);
}

void compare(const Domain& domain, GrainStore& store, double margin) {
  PairList list(domain, 0, 2, false);
  Parallel parallel(2);
  list.build(store, margin, parallel);
  const std::set<Key> found = keysOf(list, store), right = bruteForce(store, domain, margin);
  CHECK(found.size() == right.size());
  CHECK((found == right));
  checkLayout(list, store);
}

void compare(const Domain& domain, int n, double smallest, double largest, double margin) {
  GrainStore store;
  fillAtRandom(store, n, domain, smallest, largest, 0.02);
  compare(domain, store, margin);
}

} // namespace

TEST_CASE("the list holds every pair once, in an open box") {
  compare({Vec3(0, 0, 0), Vec3(1, 2, 1.5), {false, false, false}}, 400, 0.03, 0.08, 0.02);
  compare({Vec3(0, 0, 0), Vec3(1, 1, 1), {false, false, false}}, 9000, 0.025, 0.025, 0.002);
}

TEST_CASE("the list holds every pair once, in periodic boxes wide and thin") {
  compare({Vec3(0, 0, 0), Vec3(1, 2, 1.5), {true, true, true}}, 400, 0.03, 0.08, 0.02);
  compare({Vec3(-1, 0, 0), Vec3(1, 0.25, 1), {true, true, false}}, 300, 0.04, 0.05, 0.03); // 2.5 diameters
  compare({Vec3(0, 0, 0), Vec3(0.3, 0.09, 0.3), {true, true, true}}, 40, 0.02, 0.04,
          0.05);                                                              // thinner than a cut-off
  for (const double width : {0.09, 0.11, 0.17, 0.21, 0.31, 0.41, 0.51, 0.61}) // 1 to 6 cells across
    for (const int axis : {0, 1, 2}) {
      Vec3 upper(1, 1, 1);
      upper[axis] = width;
      Domain domain{Vec3(0, 0, 0), upper, {false, false, false}};
      domain.periodic[axis] = true;
      compare(domain, 200, 0.03, 0.04, 0.0);
    }
}

TEST_CASE("sizes 1:20 in one list") {
  compare({Vec3(0, 0, 0), Vec3(1, 1, 1), {false, true, false}}, 300, 0.005, 0.1, 0.01);
}

TEST_CASE("sizes 1:50 in one list of several levels") {
  for (const bool periodic : {false, true}) {
    const Domain domain{Vec3(0, 0, 0), Vec3(1, 1, 1), {periodic, periodic, periodic}};
    GrainStore store;
    fillAtRandom(store, 4500, domain, 0.005, 0.006, 0.0);
    for (int i = 0; i < 5; ++i)
      store.place[i * 900].w = 0.25 - 0.04 * i;
    for (int i = 0; i < 40; ++i)
      store.place[i * 100 + 7].w = 0.03 + 0.001 * i;
    compare(domain, store, 0.001);
  }
}

TEST_CASE("no grain, one grain, one cell") {
  const Domain open{Vec3(0, 0, 0), Vec3(1, 1, 1), {false, false, false}};
  const Domain periodic{Vec3(0, 0, 0), Vec3(1, 1, 1), {true, true, true}};
  for (const Domain& domain : {open, periodic})
    for (const int n : {0, 1, 2, 9})
      compare(domain, n, 0.1, 0.45, 0.0);
  compare({Vec3(0, 0, 0), Vec3(0.1, 0.1, 0.1), {false, false, false}}, 60, 0.1, 0.1, 0.0);
}

TEST_CASE("a periodic box too thin for its images is refused") {
  const Domain domain{Vec3(0, 0, 0), Vec3(0.05, 0.05, 0.05), {true, true, true}};
  GrainStore store;
  fillAtRandom(store, 3, domain, 0.2, 0.2, 0.0);
  PairList list(domain, 0, 1, false);
  Parallel parallel(1);
  CHECK_THROWS_WITH(list.build(store, 0.0, parallel), Catch::Contains("at most 255 are possible"));
}

TEST_CASE("grains far apart do not blow up the grid") {
  Domain domain{Vec3(-1e6, -1e6, -1e6), Vec3(1e6, 1e6, 1e6), {false, false, false}};
  GrainStore store;
  fillAtRandom(store, 50, domain, 1e-3, 1e-3, 1e-4);
  PairList list(domain, 0, 3, false);
  Parallel parallel(1);
  list.build(store, 1e-4, parallel);
  CHECK(list.size() == 0);
  CHECK(list.bytes() < 50000);
}

TEST_CASE(
    "allowances that are shared within groups of grains are respected, and listing again changes nothing") {
  const Domain domain{Vec3(0, 0, 0), Vec3(1, 1, 1), {false, true, false}};
  GrainStore store;
  fillAtRandom(store, 3000, domain, 0.004, 0.04, 0.02);
  PairList list(domain, 0, 1, false);
  Parallel parallel(3);
  for (std::size_t i = 0; i < store.size(); ++i)
    store.motion[i].x = std::exchange(store.listed[i].w, 0.0);
  list.build(store, 0.001, parallel, {}, [](double speed) { return 2.0 * speed; });
  for (std::int64_t first = 0; first < static_cast<std::int64_t>(store.size()); first += PairList::group) {
    double fastest = 0.0;
    const std::int64_t last = std::min<std::int64_t>(first + PairList::group, store.size());
    for (std::int64_t i = first; i < last; ++i)
      fastest = std::max(fastest, store.motion[i].x);
    for (std::int64_t i = first; i < last; ++i)
      CHECK(store.listed[i].w == Approx(2.0 * fastest));
  }
  CHECK((keysOf(list, store) == bruteForce(store, domain, 0.001)));

  // As a checkpoint does: what is sorted stays as it is.
  const std::vector<std::int64_t> ids = store.id;
  PairList again(domain, 0, 1, false);
  again.build(store, 0.001, parallel);
  CHECK(store.id == ids);
  REQUIRE(again.entries() == list.entries());
  bool same = true;
  for (std::int64_t p = 0; p < list.entries(); ++p)
    same = same && list.pairs()[p].a == again.pairs()[p].a && list.pairs()[p].b == again.pairs()[p].b;
  CHECK(same);
  CHECK(list.shiftOf() == again.shiftOf());
}

namespace {

using History = std::map<std::tuple<std::int64_t, std::int64_t, std::int64_t>, std::vector<double>>;

/// Histories and live flags by key.
History historiesOf(PairList& list, const GrainStore& store) {
  History all;
  for (std::int64_t p = 0; p < list.entries(); ++p) {
    if (list.isPadding(p)) continue;
    auto& values = all[{store.id[list.pairs()[p].a], store.id[list.pairs()[p].b], list.imageKey(p, store)}];
    for (int k = 0; k < list.historySize(); ++k)
      values.push_back(list.historyOf(p, k));
    values.push_back(list.live() ? list.live()[p] : 0);
  }
  return all;
}

/// Moves grains at random and lists them again, several times: pairs that stay keep what they had, others
/// start from nothing.
void checkCarrying(const Domain& domain, int n, double smallest, double largest, double step, bool drops) {
  GrainStore store;
  fillAtRandom(store, n, domain, smallest, largest, 0.0);
  PairList list(domain, 3, 2, true);
  Parallel parallel(3);
  list.build(store, 0.002, parallel);
  std::int64_t kept = 0, fresh = 0, wrapped = 0;
  for (int round = 0; round < 6; ++round) {
    for (std::int64_t p = 0; p < list.entries(); ++p) {
      if (list.isPadding(p)) continue;
      for (int k = 0; k < 3; ++k)
        list.setHistory(p, k, 1.0 + round + 3.0 * p + k);
      list.live()[p] = p % 2;
    }
    const History before = historiesOf(list, store);
    for (std::size_t i = 0; i < store.size(); ++i) {
      RandomStream random(6 + round, RandomPurpose::test, store.id[i]);
      store.place[i].x += random.uniform(-step, step);
      store.place[i].y += random.uniform(-step, step);
      store.place[i].z += random.uniform(-step, step);
    }
    std::vector<std::uint8_t> drop;
    if (drops) {
      drop.assign(store.size(), 0);
      for (std::size_t i = 0; i < store.size(); ++i)
        drop[i] = store.id[i] % 7 == round;
      const std::size_t at = store.size(); // and some new ones
      store.resize(at + 20);
      drop.resize(at + 20, 0);
      for (std::size_t i = at; i < store.size(); ++i) {
        RandomStream random(60 + round, RandomPurpose::test, i);
        store.place[i] = {random.uniform(domain.lower.x(), domain.upper.x()),
                          random.uniform(domain.lower.y(), domain.upper.y()),
                          random.uniform(domain.lower.z(), domain.upper.z()), largest};
        store.motion[i].w = 1.0;
        store.listed[i].w = 0.0;
        store.id[i] = 7'000'000 + 1000 * round + static_cast<std::int64_t>(i - at);
      }
    }
    std::map<std::int64_t, std::array<std::int32_t, 3>> counters;
    if (store.imaged)
      for (std::size_t i = 0; i < store.size(); ++i)
        counters[store.id[i]] = store.image[i];
    list.build(store, 0.002, parallel, drop);
    checkLayout(list, store);
    if (store.imaged)
      for (std::size_t i = 0; i < store.size(); ++i)
        wrapped += counters[store.id[i]] != store.image[i];
    const History after = historiesOf(list, store);
    bool right = true;
    for (const auto& [key, values] : after) {
      const auto old = before.find(key);
      right = right && values == (old == before.end() ? std::vector<double>(4, 0.0) : old->second);
      ++(old == before.end() ? fresh : kept);
    }
    CHECK(right);
  }
  CHECK(kept > 6 * n / 4);
  CHECK(fresh > 0);
  if (store.imaged) CHECK(wrapped > 0);
}

} // namespace

TEST_CASE("histories stay with their pairs while grains move, wrap, leave and arrive") {
  for (const bool drops : {false, true})
    for (const bool periodic : {false, true}) {
      const Domain domain{Vec3(0, 0, 0), Vec3(1, 0.8, 0.6), {periodic, periodic, false}};
      checkCarrying(domain, 9000, 0.02, 0.03, 0.004, drops);
    }
  const Domain thin{Vec3(0, 0, 0), Vec3(1, 0.11, 0.09), {false, true, true}}; // several images of a partner
  checkCarrying(thin, 100, 0.03, 0.04, 0.01, false);
  checkCarrying(thin, 100, 0.03, 0.04, 0.01, true);
}

TEST_CASE("histories of large grains with some fifty contacts are carried") {
  const Domain domain{Vec3(0, 0, 0), Vec3(1, 1, 1), {true, false, true}};
  checkCarrying(domain, 3000, 0.01, 0.1, 0.004, false);
}

TEST_CASE("the list is the same for any number of threads and any width of instructions") {
  for (const double largest : {0.013, 0.1}) {
    const Domain domain{Vec3(0, 0, 0), Vec3(1, 1, 1), {true, false, true}};
    struct Result {
      std::vector<std::int64_t> ids;
      std::vector<std::int32_t> numbers;
      std::vector<double> history;
      bool operator==(const Result&) const = default;
    };
    std::vector<Result> results;
    for (const char* kernel : {"plain", "avx2", "avx512"})
      for (const int threads : {1, 2, 3, 7}) {
        setenv("SANDGLASS_KERNEL", kernel, 1);
        GrainStore store;
        fillAtRandom(store, 40000 / (largest > 0.05 ? 4 : 1), domain, 0.012, largest, 0.001);
        PairList list(domain, 2, 1, false);
        Parallel parallel(threads);
        list.build(store, 0.001, parallel);
        for (std::int64_t p = 0; p < list.size(); ++p)
          if (!list.isPadding(p)) list.setHistory(p, 1, 1.0 + static_cast<double>(p));
        for (std::size_t i = 0; i < store.size(); ++i)
          store.place[i].x += 0.003 * static_cast<double>(store.id[i] % 17 - 8) / 8.0;
        list.build(store, 0.001, parallel);
        Result r{store.id, {}, list.histories()};
        for (const auto& pair : list.pairs())
          r.numbers.insert(r.numbers.end(), {pair.a, pair.b});
        r.numbers.insert(r.numbers.end(), list.shiftOf().begin(), list.shiftOf().end());
        for (const auto& crossing : list.crossings())
          r.numbers.insert(r.numbers.end(), {crossing.grain, crossing.entry});
        for (std::int64_t g = 0; g * PairList::group < static_cast<std::int64_t>(store.size()); ++g)
          r.numbers.push_back(static_cast<std::int32_t>(list.groupEnd(g)));
        r.numbers.push_back(static_cast<std::int32_t>(list.sumRows()));
        results.push_back(std::move(r));
      }
    unsetenv("SANDGLASS_KERNEL");
    for (const Result& r : results)
      CHECK((r == results.front()));
  }
}

namespace {

/// Distance tests of the search over all grains, per grain and mean occupant of a cell.
double testsPerOccupant(const Domain& domain, GrainStore& store, double range) {
  Parallel parallel(2);
  CellGrid grid;
  AlignedVector<Quad> scratch;
  grid.sort(store, domain, range, parallel, {}, scratch);
  store.reorder(grid.order(), parallel, scratch);
  const double n = static_cast<double>(store.size());
  GrainColumns columns;
  columns.grains = static_cast<std::int64_t>(store.size());
  const ImageCodes codes(domain, 2.0 * grid.largestReach());
  const PairSearch search(grid, codes, columns, KernelWidth::plain);
  const auto& count = grid.levels().front().count;
  REQUIRE(grid.levels().size() == 1);
  // As many cells as cut-offs fit along each side.
  const double cutoff = 2.0 * grid.largestReach();
  for (int k = 0; k < 3; ++k)
    CHECK(count[k] == static_cast<int>((domain.upper[k] - domain.lower[k]) / cutoff));
  return static_cast<double>(search.distanceTests()) / (n * n / (1.0 * count[0] * count[1] * count[2]));
}

} // namespace

TEST_CASE("the search measures 13 partners per grain and occupant of a cell") {
  // Half of the 26 cells around a grain's own (Hockney and Eastwood), and half of its own.
  const Domain cube{Vec3(0, 0, 0), Vec3(1, 1, 1), {true, true, true}};
  for (const int n : {1000, 10000, 100000}) {
    GrainStore store;
    const double radius = 0.5 * 0.999 / std::floor(std::cbrt(n / 2.0)); // two grains a cell
    fillAtRandom(store, n, cube, radius, radius, 0.0);
    CHECK(testsPerOccupant(cube, store, 0.0) == Approx(13.0).epsilon(0.15));
  }
}

TEST_CASE("grains in a cone are found as by brute force") {
  // A grid over the cone's bounding box: most cells are empty, and occupied ones hold what they hold in a
  // cube.
  const Domain box{Vec3(0, 0, 0), Vec3(1, 1, 1), {false, false, false}};
  for (const int n : {1000, 9000}) {
    GrainStore store;
    const double radius = 0.5 / std::floor(std::cbrt(n / 2.0));
    fillAtRandom(store, n, box, radius, radius, 0.0);
    for (std::size_t i = 0; i < store.size(); ++i) { // into a cone with its tip at the bottom
      Quad& q = store.place[i];
      q.x = 0.5 + (q.x - 0.5) * q.z;
      q.y = 0.5 + (q.y - 0.5) * q.z;
    }
    compare(box, store, 0.0);
  }
}

TEST_CASE("a sorted grid chains each grain to exactly one cell") {
  const Domain domain{Vec3(0, 0, 0), Vec3(1, 1, 1), {true, false, true}};
  GrainStore store;
  fillAtRandom(store, 9000, domain, 0.004, 0.005, 0.001);
  for (int i = 0; i < 5; ++i)
    store.place[1000 * i].w = 0.2;
  Parallel parallel(3);
  CellGrid grid;
  AlignedVector<Quad> scratch;
  grid.sort(store, domain, 0.001, parallel, {}, scratch);
  std::vector<std::int32_t> order = grid.order();
  CHECK(grid.levels().size() > 1);
  REQUIRE(order.size() == store.size());
  REQUIRE(grid.start().front() == 0);
  REQUIRE(grid.start().back() == static_cast<std::int32_t>(order.size()));
  bool ascending = true; // grains of one cell stand in the order they had
  for (std::size_t c = 0; c + 1 < grid.start().size(); ++c) {
    REQUIRE(grid.start()[c] <= grid.start()[c + 1]);
    for (std::int32_t k = grid.start()[c] + 1; k < grid.start()[c + 1]; ++k)
      ascending = ascending && order[k - 1] < order[k];
  }
  CHECK(ascending);
  std::sort(order.begin(), order.end());
  for (std::size_t k = 0; k < order.size(); ++k)
    REQUIRE(order[k] == static_cast<std::int32_t>(k));
}
