#include "vis/arrows.h"

#include "vis/fit.h"
#include "vis/visible_grains.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sandglass::vis {

namespace {

double meanRadius(const Frame& frame) {
  const std::vector<double> radii = drawnRadii(frame);
  return std::accumulate(radii.begin(), radii.end(), 0.0) /
         static_cast<double>(std::max<std::size_t>(radii.size(), 1));
}

} // namespace

void addArrows(std::vector<Solid>& solids, const Frame& frame, const View& view, const History* history) {
  const Arrows& arrows = view.arrows;
  if (arrows.vector.empty() || frame.size() == 0) return;
  const std::vector<Vec3>& vectors = frame.vector(arrows.vector);
  View all = view;
  all.grains = true;
  const VisibleGrains grains = visibleGrains(frame, all, history);
  const double radius = meanRadius(frame);
  double scale = arrows.scale;
  if (!(scale > 0)) {
    double longest = 0;
    for (const Vec3& v : vectors)
      if (v.allFinite()) longest = std::max(longest, v.norm());
    scale = longest > 0 ? 4 * radius / longest : 0;
  }
  for (const std::size_t k : evenSubset(grains.size(), arrows.maximum))
    if (const Vec3& v = vectors[grains.index[k]]; v.allFinite())
      addArrow(solids, grains.position[k], scale * v, 0.12 * radius, rgb(arrows.colour));
}

void addTracks(std::vector<Solid>& solids, const Frame& frame, const View& view, const History* history) {
  if (!history || view.tracks.grains.empty()) return;
  const double far = domainBox(frame).diagonal().norm() / 4, radius = 0.2 * meanRadius(frame);
  const double since = view.tracks.duration > 0 ? frame.time - view.tracks.duration : -1e300;
  const ColourMap colours("discrete");
  for (std::size_t g = 0; g < view.tracks.grains.size(); ++g) {
    const auto found = history->tracks().find(view.tracks.grains[g]);
    if (found == history->tracks().end()) continue;
    const History::Track& track = found->second;
    std::vector<Vec3> line;
    const auto finish = [&] {
      addLine(solids, line, radius, colours.ofIndex(static_cast<long>(g)));
      line.clear();
    };
    for (std::size_t k = 0; k < track.time.size() && track.time[k] <= frame.time; ++k) {
      if (track.time[k] < since) continue;
      if (!line.empty() && (track.position[k] - line.back()).norm() > far) finish();
      line.push_back(track.position[k]);
    }
    finish();
  }
}

} // namespace sandglass::vis
