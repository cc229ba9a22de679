#include "vis/force_chains.h"

#include "vis/clip.h"
#include "vis/periodic_images.h"
#include "vis/visible_grains.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

namespace sandglass::vis {

namespace {

double mean(const std::vector<double>& values) {
  if (values.empty()) return 0;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Where the tube of a contact begins and ends; the grain where one of the ids is not in the frame.
struct Ends {
  Vec3 from, to;
};

class Places {
public:
  explicit Places(const Frame& frame) : frame_(frame), period_(frame.domain.upper - frame.domain.lower) {
    for (std::size_t i = 0; i < frame.id.size(); ++i)
      index_[frame.id[i]] = i;
  }
  std::optional<Ends> of(const FrameContact& contact) const {
    const auto a = index_.find(contact.a);
    if (a == index_.end()) return std::nullopt;
    const Vec3 from = frame_.position[a->second];
    if (contact.b < 0) return Ends{from, contact.point};
    const auto b = index_.find(contact.b);
    if (b == index_.end()) return std::nullopt;
    const Vec3 image(contact.image[0], contact.image[1], contact.image[2]);
    return Ends{from, frame_.position[b->second] + image.cwiseProduct(period_)};
  }

private:
  const Frame& frame_;
  Vec3 period_;
  std::unordered_map<std::int64_t, std::size_t> index_;
};

} // namespace

std::optional<Legend> addForceChains(std::vector<Solid>& solids, const Frame& frame, const View& view) {
  const ForceChains& chains = view.forceChains;
  if (!chains.shown) return std::nullopt;
  std::vector<double> forces;
  for (const auto& contact : frame.contacts)
    forces.push_back(contact.force.norm());
  Legend legend;
  legend.name = "contact force";
  legend.unit = "N";
  legend.map = ColourMap(chains.map);
  legend.low = 0;
  legend.high = chains.highest;
  if (!(chains.highest > 0))
    legend.high = forces.empty() ? 1 : *std::max_element(forces.begin(), forces.end());
  if (!(legend.high > 0)) legend.high = 1; // contacts without force
  const double width = chains.width > 0 ? chains.width : mean(drawnRadii(frame));
  const double least = chains.minimum * mean(forces);
  constexpr double thinnest = 0.03; // of the full width: still seen
  const Places places(frame);
  const auto shifts = imageShifts(frame.domain, view);
  for (std::size_t k = 0; k < forces.size(); ++k) {
    const double share = std::min(forces[k] / legend.high, 1.0);
    const auto ends = places.of(frame.contacts[k]);
    if (forces[k] < least || !(forces[k] > 0) || !ends) continue;
    for (const Vec3& shift : shifts)
      if (!isClipped(view, frame.contacts[k].point + shift))
        solids.push_back(tube(ends->from + shift, ends->to + shift, std::max(share, thinnest) * width / 2,
                              legend.map.at(share)));
  }
  return legend;
}

} // namespace sandglass::vis
