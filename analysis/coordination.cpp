#include "analysis/coordination.h"

#include "analysis/grain_sizes.h"

#include <fmt/format.h>

#include <unordered_map>

namespace sandglass::analysis {

namespace {

/// Partners of each grain; -1 for a wall.
std::vector<std::vector<int>> fromFrame(const Frame& frame) {
  std::unordered_map<std::int64_t, int> index;
  for (std::size_t i = 0; i < frame.size(); ++i)
    index.emplace(frame.id[i], static_cast<int>(i));
  std::vector<std::vector<int>> partners(frame.size());
  for (const auto& contact : frame.contacts) {
    if (contact.overlap < 0) continue;
    const auto a = index.find(contact.a), b = index.find(contact.b);
    if (a != index.end())
      partners[static_cast<std::size_t>(a->second)].push_back(b != index.end() ? b->second : -1);
    if (b != index.end() && a != index.end())
      partners[static_cast<std::size_t>(b->second)].push_back(a->second);
  }
  return partners;
}

std::vector<std::vector<int>> fromGaps(const Frame& frame, double gap) {
  const auto& radius = frame.scalar(quantity::radius);
  const double slack = gap * meanDiameter(frame);
  std::vector<std::vector<int>> partners(frame.size());
  std::vector<double> reach;
  for (const double r : radius)
    reach.push_back(r + 0.5 * slack);
  const NeighbourList list = neighboursByGap(frame.position, reach, frame.domain, 1);
  for (std::size_t i = 0; i < frame.size(); ++i) {
    for (const auto j : list.indices(i))
      partners[i].push_back(static_cast<int>(j));
    for (const auto& wall : frame.walls) {
      if (!wall.active) continue;
      WallShape::Touches touches;
      wall.shape->touches(frame.position[i], radius[i] + slack, touches);
      partners[i].insert(partners[i].end(), static_cast<std::size_t>(touches.count), -1);
    }
  }
  return partners;
}

} // namespace

ContactCounts contactCounts(const Frame& frame, double gap, int least, bool again) {
  const bool known = !frame.contacts.empty();
  const auto partners = known ? fromFrame(frame) : fromGaps(frame, gap);
  ContactCounts counts;
  counts.definition = known ? std::string("contacts of the frame with overlap, walls included")
                            : fmt::format("pairs and walls with a gap of at most {:.3g} d", gap);
  counts.definition +=
      fmt::format("; rattlers: fewer than {} contacts{}", least, again ? ", taken out again and again" : "");
  counts.rattler.assign(frame.size(), 0);
  std::vector<int> left;
  for (const auto& p : partners)
    left.push_back(static_cast<int>(p.size()));
  counts.contacts = left;
  std::vector<std::size_t> loose;
  for (std::size_t i = 0; i < left.size(); ++i)
    if (left[i] < least) loose.push_back(i);
  while (!loose.empty()) {
    const std::size_t i = loose.back();
    loose.pop_back();
    if (counts.rattler[i]) continue;
    counts.rattler[i] = 1;
    for (const int j : partners[i])
      if (j >= 0 && !counts.rattler[static_cast<std::size_t>(j)] &&
          --left[static_cast<std::size_t>(j)] < least && again)
        loose.push_back(static_cast<std::size_t>(j));
  }
  for (std::size_t i = 0; i < left.size(); ++i)
    counts.mechanical.push_back(counts.rattler[i] ? 0 : left[i]);
  return counts;
}

} // namespace sandglass::analysis
