#pragma once
// What a panel does to a curve before it is drawn, and from a pixel back to a point of it.

#include "analysis/result.h"
#include "vis/renderer.h"

#include <optional>
#include <string>

namespace sandglass::desktop {

/// Values of one axis become their decimal logarithms, and its name says so. Points that have none are left
/// out; errors become those of the logarithm.
analysis::Curve logarithmic(analysis::Curve curve, bool x);

/// The part between two x, lines cut where they cross the ends.
analysis::Curve cutOut(analysis::Curve curve, double low, double high);

struct NearestPoint {
  std::string series;
  double x = 0, y = 0, pixelX = 0, pixelY = 0;
};

/// The point of any series nearest to a pixel of the picture.
std::optional<NearestPoint> nearestPoint(const analysis::Curve& curve, const vis::ChartPlace& place,
                                         double pixelX, double pixelY);

} // namespace sandglass::desktop
