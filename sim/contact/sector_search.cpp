#include "sim/contact/sector_search.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace sandglass {

namespace {

struct Image {
  Vec3 at;
  double reach;
  std::int32_t grain, turn;
};

/// Images of about one size, sorted along the axis.
struct SizeClass {
  double largest = 0;
  std::vector<Image> images;
};

} // namespace

std::vector<SectorContacts::Contact> searchAcross(const GrainStore& grains, double range,
                                                  const Sector& sector) {
  const auto n = static_cast<std::int32_t>(grains.size());
  const auto reachOf = [&](std::int32_t i) { return grains.place[i].w + grains.listed[i].w + 0.5 * range; };
  double largest = 0.0;
  for (std::int32_t i = 0; i < n; ++i)
    largest = std::max(largest, reachOf(i));

  const int axis = sector.axis();
  std::map<int, SizeClass> classes; // by the power of two of the reach
  std::vector<std::int32_t> near;
  for (std::int32_t i = 0; i < n; ++i) {
    const Vec3 x = grains.place[i].vec();
    const double reach = reachOf(i);
    bool any = false;
    sector.eachImage(x, reach + largest, [&](int turn) {
      any = true;
      int power = 0;
      std::frexp(reach, &power);
      SizeClass& group = classes[power];
      group.largest = std::max(group.largest, reach);
      group.images.push_back({sector.turned(x, turn), reach, i, turn});
    });
    // Whoever is near a face has its own image near the other one.
    if (any) near.push_back(i);
  }

  std::vector<SectorContacts::Contact> found;
  for (auto& [power, group] : classes) {
    std::sort(group.images.begin(), group.images.end(), [&](const Image& s, const Image& t) {
      return std::tie(s.at[axis], s.grain, s.turn) < std::tie(t.at[axis], t.grain, t.turn);
    });
    for (const std::int32_t i : near) {
      const Vec3 x = grains.place[i].vec();
      const double reach = reachOf(i), furthest = reach + group.largest;
      auto image = std::lower_bound(group.images.begin(), group.images.end(), x[axis] - furthest,
                                    [&](const Image& s, double at) { return s.at[axis] < at; });
      for (; image != group.images.end() && image->at[axis] <= x[axis] + furthest; ++image) {
        const double cutoff = reach + image->reach;
        if ((x - image->at).squaredNorm() >= cutoff * cutoff) continue;
        const std::int64_t mine = grains.id[i], other = grains.id[image->grain];
        if (mine < other || (mine == other && 2 * image->turn <= sector.count()))
          found.push_back({i, image->grain, image->turn});
      }
    }
  }
  std::sort(found.begin(), found.end(), [](const auto& s, const auto& t) {
    return std::tie(s.a, s.b, s.turn) < std::tie(t.a, t.b, t.turn);
  });
  return found;
}

} // namespace sandglass
