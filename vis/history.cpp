#include "vis/history.h"

#include "sim/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sandglass::vis {

void History::addOriginals(const Frame& frame) {
  for (std::size_t i = 0; i < frame.size(); ++i)
    originals_.try_emplace(frame.id[i], frame.position[i]);
}

void History::addTracks(const Frame& frame, const std::vector<std::int64_t>& grains) {
  for (const std::int64_t id : grains) {
    const auto at = std::lower_bound(frame.id.begin(), frame.id.end(), id);
    auto found = at != frame.id.end() && *at == id ? at : std::find(frame.id.begin(), frame.id.end(), id);
    if (found == frame.id.end()) continue;
    Track& track = tracks_[id];
    if (!track.time.empty() && frame.time <= track.time.back()) continue;
    track.time.push_back(frame.time);
    track.position.push_back(frame.position[static_cast<std::size_t>(found - frame.id.begin())]);
  }
}

std::vector<double> History::original(const Frame& frame, int axis) const {
  std::vector<double> values(frame.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < frame.size(); ++i)
    if (const auto found = originals_.find(frame.id[i]); found != originals_.end())
      values[i] = found->second[axis];
  return values;
}

std::array<double, 2> History::originalRange(int axis) const {
  if (originals_.empty()) return {0, 1};
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const auto& [id, position] : originals_) {
    low = std::min(low, position[axis]);
    high = std::max(high, position[axis]);
  }
  return {low, high};
}

std::optional<int> originalAxis(const std::string& quantity) {
  for (int axis = 0; axis < 3; ++axis)
    if (quantity == std::string("original.") + "xyz"[axis]) return axis;
  return std::nullopt;
}

bool needsHistory(const View& view) {
  return originalAxis(view.colouring.quantity) || !view.tracks.grains.empty() ||
         view.selection.expression.find("original.") != std::string::npos;
}

History historyOf(const FrameSource& source, const View& view, const std::function<void()>& onFrame) {
  History history;
  if (source.size() == 0 || !needsHistory(view)) return history;
  const FramePtr last = source.load(source.size() - 1);
  if (!last->persistentIds)
    throw InputError(fmt::format("{}: its ids do not mean the same grain from frame to frame, so neither "
                                 "original positions nor tracks can be drawn",
                                 source.name()));
  // Stages follow each other: bisection finds where the last one begins.
  std::size_t before = 0, in = source.size() - 1;
  FramePtr first = last;
  if (const FramePtr start = source.load(0); start->stage == last->stage) {
    first = start;
    in = 0;
  }
  while (in > before + 1) {
    const std::size_t middle = (before + in) / 2;
    const FramePtr frame = source.load(middle);
    if (frame->stage == last->stage) {
      in = middle;
      first = frame;
    } else {
      before = middle;
    }
  }
  history.addOriginals(*first);
  for (std::size_t k = 0; k < source.size() && !view.tracks.grains.empty(); ++k) {
    history.addTracks(*source.load(k), view.tracks.grains);
    if (onFrame) onFrame();
  }
  return history;
}

std::vector<double> quantityValues(const Frame& frame, const std::string& quantity, const History* history) {
  const auto axis = originalAxis(quantity);
  if (!axis) return grainScalar(frame, quantity);
  if (!history || !history->hasOriginals())
    throw InputError(fmt::format("there is no '{}' without the other frames of the run; colour a run, not a "
                                 "single frame, by it",
                                 quantity));
  return history->original(frame, *axis);
}

std::string quantityUnit(const std::string& quantity) {
  return originalAxis(quantity) ? "m" : unitOf(quantity);
}

} // namespace sandglass::vis
