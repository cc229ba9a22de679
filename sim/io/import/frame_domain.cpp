#include "sim/io/import/frame_domain.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace sandglass {

namespace {

constexpr double mostPeriods = 1e9; // farther away the place in the box is rounding

/// How many periods `p` is above the box.
double periodsAbove(double p, const Domain& d, int axis, std::size_t grain, const FramePlace& place) {
  const double shift = std::floor((p - d.lower[axis]) / (d.upper[axis] - d.lower[axis]));
  if (!(std::abs(shift) < mostPeriods))
    place.failAt(grain, fmt::format("found a grain at {} along {}, farther than {} periods from its box", p,
                                    "xyz"[axis], mostPeriods));
  return shift;
}

void wrap(Frame& frame, int axis, const FramePlace& place) {
  const Domain& d = frame.domain;
  const double period = d.upper[axis] - d.lower[axis];
  if (!(period > 0)) place.fail(fmt::format("its box repeats along {} but has no extent there", "xyz"[axis]));
  for (std::size_t i = 0; i < frame.position.size(); ++i) {
    double& p = frame.position[i][axis];
    const double shift = periodsAbove(p, d, axis, i, place);
    if (shift != 0) p -= shift * period;
    if (!(p >= d.lower[axis] && p < d.upper[axis])) p = d.lower[axis];
  }
}

void bound(Frame& frame, int axis) {
  Domain& d = frame.domain;
  const auto& x = frame.position;
  const auto radius = frame.scalars.find(quantity::radius);
  d.lower[axis] = d.upper[axis] = x[0][axis];
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double half = radius == frame.scalars.end() ? 0 : radius->second[i];
    d.lower[axis] = std::min(d.lower[axis], x[i][axis] - half);
    d.upper[axis] = std::max(d.upper[axis], x[i][axis] + half);
  }
}

/// Whether a tilt is a whole number of periods; six digits are what text dumps have.
bool whole(double tilt, double period) {
  constexpr double rounding = 1e-5;
  return std::abs(tilt / period - std::round(tilt / period)) < rounding;
}

} // namespace

void fitDomain(Frame& frame, const std::optional<Domain>& box, const FramePlace& place) {
  frame.domain = box.value_or(Domain{});
  for (int k = 0; k < 3; ++k)
    if (frame.domain.periodic[static_cast<std::size_t>(k)])
      wrap(frame, k, place);
    else if (!box && !frame.position.empty())
      bound(frame, k);
}

std::string straighten(std::vector<Vec3>& position, Domain& box, const Vec3& tilt, const FramePlace& place) {
  const Vec3 length = box.upper - box.lower;
  const std::array<bool, 3> was = box.periodic;
  if (!(length.minCoeff() > 0)) place.fail("its box is tilted, but has no extent along one direction");
  if ((tilt[0] != 0 && !(was[0] && was[1])) || (tilt[1] != 0 && !(was[0] && was[2])) ||
      (tilt[2] != 0 && !(was[1] && was[2])))
    place.fail("its box is tilted along a side that does not repeat, and such a box cannot be put upright; "
               "give the space of the grains with --box and --periodic none");
  const Vec3 alongY(tilt[0], length[1], 0), alongZ(tilt[1], tilt[2], length[2]);
  for (std::size_t i = 0; i < position.size(); ++i) {
    Vec3& p = position[i];
    if (was[2]) p -= periodsAbove(p[2], box, 2, i, place) * alongZ;
    if (was[1]) p -= periodsAbove(p[1], box, 1, i, place) * alongY;
  }
  // c less a whole number of b must be upright for z to repeat, and b less a whole number of a for y.
  const double steps = std::round(tilt[2] / length[1]);
  box.periodic[1] = was[1] && whole(tilt[0], length[0]);
  box.periodic[2] = was[2] && whole(tilt[2], length[1]) && whole(tilt[1] - steps * tilt[0], length[0]);
  if (box.periodic == was) return {};
  const char* sides = was[1] == box.periodic[1] ? "z" : was[2] == box.periodic[2] ? "y" : "y and z";
  return fmt::format("the box is tilted; its grains are put into the upright box of the same volume, which "
                     "does not repeat along {}: those sides count as open, and neighbours across them are "
                     "not seen",
                     sides);
}

} // namespace sandglass
