#include "vis/pair_view.h"

#include "vis/fit.h"
#include "vis/history.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sandglass::vis {

namespace {

bool canColour(const Frame& frame, const std::string& quantity) {
  if (quantity.empty() || originalAxis(quantity)) return true;
  const auto known = grainScalarNames(frame);
  return std::find(known.begin(), known.end(), quantity) != known.end();
}

std::string titleOf(const Frame& frame) {
  const auto found = frame.provenance.find("title");
  return found == frame.provenance.end() ? std::string() : found->second;
}

/// Of both frames; what is counted instead (species) ignores it.
void shareRange(Colouring& colouring, const Frame& left, const Frame& right) {
  if (colouring.range != ColourRange::frame || colouring.quantity.empty() || originalAxis(colouring.quantity))
    return;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Frame* frame : {&left, &right}) {
    if (!canColour(*frame, colouring.quantity)) continue;
    for (const double value : grainScalar(*frame, colouring.quantity)) {
      if (!std::isfinite(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  if (!(high > low)) return; // each half says that all are alike
  colouring.range = ColourRange::fixed;
  colouring.low = low;
  colouring.high = high;
}

} // namespace

View drawableView(const View& view, const Frame& frame) {
  View result = view;
  if (!canColour(frame, view.colouring.quantity)) result.colouring.quantity.clear();
  return result;
}

PairViews pairViews(const Frame& left, const Frame& right, const View& view,
                    const std::array<std::string, 2>& names) {
  View common = view;
  shareRange(common.colouring, left, right);
  if (!common.camera.preset.empty()) {
    GrainExtent extent;
    extent.add(left);
    extent.add(right);
    View half = common;
    half.width /= 2;
    common.camera = fitCamera(left, half, extent);
  }
  PairViews views{drawableView(common, left), drawableView(common, right)};
  if (!view.title.empty()) return views;
  const bool alike = titleOf(left) == titleOf(right);
  const auto title = [&](const Frame& frame, const std::string& name) {
    const std::string own = titleOf(frame);
    if (own.empty()) return name;
    return alike && !name.empty() ? name + ": " + own : own;
  };
  views.left.title = title(left, names[0]);
  views.right.title = title(right, names[1]);
  return views;
}

} // namespace sandglass::vis
