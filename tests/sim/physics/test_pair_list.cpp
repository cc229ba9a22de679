// The neighbour list against a brute-force search, including boxes thinner than the cut-off.

#include "sim/base/random.h"
#include "sim/contact/pair_list.h"

#include <catch2/catch.hpp>

#include <set>
#include <tuple>

using namespace sandglass;

namespace {

using Key = std::tuple<std::int64_t, std::int64_t, int, int, int>;

GrainStore randomGrains(int n, const Domain& domain, double smallest, double largest, double allowed) {
  GrainStore store;
  store.imaged = domain.periodic[0] || domain.periodic[1] || domain.periodic[2];
  store.resize(n);
  for (int i = 0; i < n; ++i) {
    RandomStream random(5, RandomPurpose::test, i);
    Vec3 x;
    for (int k = 0; k < 3; ++k)
      x[k] = random.uniform(domain.lower[k], domain.upper[k]);
    store.place[i] = {x.x(), x.y(), x.z(), random.uniform(smallest, largest)};
    store.motion[i].w = 1.0;
    store.listed[i].w = allowed * i / n; // unequal allowances
    store.id[i] = (i * 7919) % n;        // ids in another order than storage
  }
  return store;
}

std::set<Key> bruteForce(const GrainStore& g, const Domain& d, double margin) {
  std::set<Key> keys;
  const Vec3 L = d.upper - d.lower;
  const int n = static_cast<int>(g.size());
  const auto reach = [&](int k) { return d.periodic[k] ? 3 : 0; };
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b) {
      if (g.id[a] > g.id[b]) continue;
      for (int x = -reach(0); x <= reach(0); ++x)
        for (int y = -reach(1); y <= reach(1); ++y)
          for (int z = -reach(2); z <= reach(2); ++z) {
            if (a == b && std::tuple(x, y, z) <= std::tuple(0, 0, 0)) continue;
            const Vec3 s(x * L[0], y * L[1], z * L[2]);
            const double r = g.place[a].w + g.place[b].w + margin + g.listed[a].w + g.listed[b].w;
            if ((g.place[a].vec() - (g.place[b].vec() + s)).squaredNorm() < r * r)
              keys.insert({g.id[a], g.id[b], x, y, z});
          }
    }
  return keys;
}

void compare(const Domain& domain, int n, double smallest, double largest, double margin) {
  GrainStore store = randomGrains(n, domain, smallest, largest, 0.02);
  PairList list(domain, 0, 3);
  Parallel parallel(2);
  list.build(store, margin, parallel);
  std::set<Key> keys;
  for (std::size_t p = 0; p < list.size(); ++p) {
    const auto [a, b] = list.pairs()[p];
    const auto image = list.image(p);
    CHECK(keys.insert({store.id[a], store.id[b], image[0], image[1], image[2]}).second); // none twice
  }
  CHECK(keys == bruteForce(store, domain, margin));
}

} // namespace

TEST_CASE("the list holds every pair once, in an open box") {
  compare({Vec3(0, 0, 0), Vec3(1, 2, 1.5), {false, false, false}}, 400, 0.03, 0.08, 0.02);
}

TEST_CASE("the list holds every pair once, in periodic boxes wide and thin") {
  compare({Vec3(0, 0, 0), Vec3(1, 2, 1.5), {true, true, true}}, 400, 0.03, 0.08, 0.02);
  compare({Vec3(-1, 0, 0), Vec3(1, 0.25, 1), {true, true, false}}, 300, 0.04, 0.05, 0.03); // 2.5 diameters
  compare({Vec3(0, 0, 0), Vec3(0.3, 0.09, 0.3), {true, true, true}}, 40, 0.02, 0.04,
          0.05); // thinner than a cut-off
}

TEST_CASE("sizes 1:20 in one list") {
  compare({Vec3(0, 0, 0), Vec3(1, 1, 1), {false, true, false}}, 300, 0.005, 0.1, 0.01);
}

TEST_CASE("grains far apart do not blow up the grid") {
  Domain domain{Vec3(-1e6, -1e6, -1e6), Vec3(1e6, 1e6, 1e6), {false, false, false}};
  GrainStore store = randomGrains(50, domain, 1e-3, 1e-3, 1e-4);
  PairList list(domain, 0, 3);
  Parallel parallel(1);
  list.build(store, 1e-4, parallel);
  CHECK(list.size() == 0);
}
