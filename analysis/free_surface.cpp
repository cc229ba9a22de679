#include "analysis/free_surface.h"

#include "analysis/neighbours.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sandglass::analysis {

namespace {
constexpr double infinity = std::numeric_limits<double>::infinity();
}

UpFrame::UpFrame(const Vec3& upDirection) : up(upDirection.normalized()) {
  int dominant = 0;
  up.cwiseAbs().maxCoeff(&dominant);
  const Vec3 seed = Vec3::Unit((dominant + 1) % 3);
  e1 = (seed - seed.dot(up) * up).normalized();
  e2 = up.cross(e1);
}

int FreeSurface::Direction::index(double s) const {
  const int i = static_cast<int>(std::floor((s - origin) / width));
  return periodic ? ((i % count) + count) % count : std::clamp(i, 0, count - 1);
}

FreeSurface::FreeSurface(const Frame& frame, const Vec3& up, double columnWidth, double diameter)
    : axes_(up) {
  const auto setUp = [&](Direction& d, const Vec3& axis) {
    d.axis = axis;
    double lower = infinity, upper = -infinity;
    for (const auto& x : frame.position) {
      lower = std::min(lower, x.dot(axis));
      upper = std::max(upper, x.dot(axis));
    }
    for (int k = 0; k < 3; ++k)
      if (frame.domain.periodic[k] && std::abs(axis[k]) == 1) {
        const double a = frame.domain.lower[k] * axis[k], b = frame.domain.upper[k] * axis[k];
        lower = std::min(a, b);
        upper = std::max(a, b);
        d.periodic = true;
      }
    if (!(upper > lower)) {
      lower = frame.position.empty() ? 0 : lower - 0.5 * columnWidth;
      upper = lower + columnWidth;
    }
    d.origin = lower;
    d.count = std::max(1, static_cast<int>((upper - lower) / columnWidth));
    d.width = (upper - lower) / d.count;
  };
  setUp(first_, axes_.e1);
  setUp(second_, axes_.e2);
  height_.assign(static_cast<std::size_t>(first_.count) * second_.count, -infinity);

  const auto neighbours = countNeighbours(frame.position, frame.domain, 1.5 * diameter);
  for (std::size_t i = 0; i < frame.size(); ++i) {
    if (neighbours[i] < 4) continue;
    double& h = height_[column(frame.position[i])];
    h = std::max(h, frame.position[i].dot(axes_.up));
  }
}

std::size_t FreeSurface::column(const Vec3& x) const {
  return static_cast<std::size_t>(first_.index(x.dot(first_.axis))) * second_.count +
         second_.index(x.dot(second_.axis));
}

double FreeSurface::lowestNear(const Vec3& x, double reach) const {
  const auto range = [&](const Direction& d) {
    const double s = x.dot(d.axis);
    int from = static_cast<int>(std::floor((s - reach - d.origin) / d.width));
    int to = static_cast<int>(std::floor((s + reach - d.origin) / d.width));
    if (!d.periodic) {
      from = std::clamp(from, 0, d.count - 1);
      to = std::clamp(to, 0, d.count - 1);
    } else if (to - from >= d.count) {
      from = 0;
      to = d.count - 1;
    }
    return std::pair{from, to};
  };
  const auto [a0, a1] = range(first_);
  const auto [b0, b1] = range(second_);
  double lowest = infinity;
  for (int a = a0; a <= a1; ++a)
    for (int b = b0; b <= b1; ++b) {
      const int ia = (a % first_.count + first_.count) % first_.count;
      const int ib = (b % second_.count + second_.count) % second_.count;
      lowest = std::min(lowest, height_[static_cast<std::size_t>(ia) * second_.count + ib]);
    }
  return lowest;
}

double FreeSurface::highest() const {
  return *std::max_element(height_.begin(), height_.end());
}

} // namespace sandglass::analysis
