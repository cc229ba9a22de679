#include "vis/solids.h"

#include <algorithm>

namespace sandglass::vis {

Solid tube(const Vec3& from, const Vec3& to, double radius, const Rgb& colour) {
  Solid solid;
  solid.position = (from + to) / 2;
  solid.turn = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), to - from);
  solid.shape = {Vec3(radius, radius, std::max((to - from).norm() / 2, 1e-6 * radius)), 0.1, 1};
  solid.colour = colour;
  return solid;
}

void addLine(std::vector<Solid>& solids, const std::vector<Vec3>& points, double radius, const Rgb& colour) {
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    if (points[k + 1] == points[k]) continue;
    solids.push_back(tube(points[k], points[k + 1], radius, colour));
    if (k == 0) continue;
    Solid ball;
    ball.position = points[k];
    ball.shape.semiAxes.setConstant(radius);
    ball.colour = colour;
    solids.push_back(ball);
  }
}

void addArrow(std::vector<Solid>& solids, const Vec3& from, const Vec3& along, double radius,
              const Rgb& colour) {
  const double length = along.norm();
  if (!(length > 0)) return;
  const double tip = std::min(7 * radius, 0.6 * length);
  const Vec3 way = along / length;
  solids.push_back(tube(from, from + (length - tip) * way, radius, colour));
  Solid head = tube(from + (length - 1.25 * tip) * way, from + along, radius, colour);
  head.shape = {Vec3(2.6 * radius, 2.6 * radius, 0.625 * tip), 2, 1};
  solids.push_back(head);
}

void thicken(std::vector<Solid>& solids, double radius) {
  for (Solid& solid : solids)
    solid.shape.semiAxes.head<2>() = solid.shape.semiAxes.head<2>().cwiseMax(radius);
}

} // namespace sandglass::vis
