#include "sim/solvers/dem/group_travel.h"

#include "sim/contact/pair_list.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace sandglass {

namespace {

constexpr std::int64_t group = PairList::group;
constexpr std::int64_t groupsPerPiece = 32;
/// Lists that have less than this share of their allowance left are made anew: what is left would soon be
/// used up, and looking costs a twentieth of making them.
constexpr double leastLeft = 0.25;
/// The common motion is fitted to one grain in so many of each group: any motion is right.
constexpr std::int64_t grainsPerSample = 8;

/// For the fit of displacements: sums of (1, X) by itself and with d.
struct Sums {
  Eigen::Matrix4d square = Eigen::Matrix4d::Zero();
  Eigen::Matrix<double, 4, 3> product = Eigen::Matrix<double, 4, 3>::Zero();
};

Vec3 displacement(const GrainStore& grains, std::int64_t i) {
  return grains.place[i].vec() - grains.listed[i].vec();
}

} // namespace

void GroupTravel::begin(const GrainStore& grains) {
  const std::size_t groups = (grains.size() + group - 1) / group;
  moved_.assign(groups, 0.0);
  allowed_.resize(groups);
  for (std::size_t g = 0; g < groups; ++g)
    allowed_[g] = grains.listed[g * group].w;
}

bool GroupTravel::measure(const GrainStore& grains, double range, const std::array<bool, 3>& periodic,
                          Parallel& parallel) {
  const auto n = static_cast<std::int64_t>(grains.size()), groups = static_cast<std::int64_t>(moved_.size());
  if (n == 0) return true;
  const auto eachGroup = [&](auto&& body) {
    parallel.forRange(groups, groupsPerPiece, [&](std::int64_t from, std::int64_t to) {
      for (std::int64_t g = from; g < to; ++g)
        body(g, g * group, std::min(n, (g + 1) * group));
    });
  };
  // From the first grain, so that a scene may lie anywhere.
  const Vec3 origin = grains.listed[0].vec();
  const Vec3 counts(periodic[0] ? 0 : 1, periodic[1] ? 0 : 1, periodic[2] ? 0 : 1);
  const auto basis = [&](std::int64_t i) -> Eigen::Vector4d {
    Eigen::Vector4d x;
    x << 1.0, (grains.listed[i].vec() - origin).cwiseProduct(counts);
    return x;
  };
  std::vector<Sums> parts(static_cast<std::size_t>(groups)); // added in one order, whatever the threads
  eachGroup([&](std::int64_t g, std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; i += grainsPerSample) {
      const Eigen::Vector4d x = basis(i);
      parts[g].square += x * x.transpose();
      parts[g].product += x * displacement(grains, i).transpose();
    }
  });
  Sums all;
  for (const Sums& part : parts) {
    all.square += part.square;
    all.product += part.product;
  }
  // Any A is right; a little of the unit matrix keeps the best one finite where grains lie in a plane.
  const double radius = grains.place[0].w;
  for (int k = 1; k < 4; ++k)
    all.square(k, k) += radius * radius;
  const Eigen::Matrix<double, 4, 3> fit = all.square.ldlt().solve(all.product);
  const Vec3 shift = fit.row(0);
  const Eigen::Matrix3d gradient = fit.bottomRows<3>().transpose() * counts.asDiagonal();
  std::vector<double> widest(static_cast<std::size_t>(groups)); // the largest reach [m]
  eachGroup([&](std::int64_t g, std::int64_t first, std::int64_t last) {
    double farthest = 0.0, reach = 0.0;
    for (std::int64_t i = first; i < last; ++i) {
      const Vec3 x = grains.listed[i].vec() - origin;
      const Vec3 rest = displacement(grains, i) - (shift + gradient * x);
      farthest = std::max(farthest, rest.squaredNorm());
      reach = std::max(reach, grains.place[i].w + grains.listed[i].w);
    }
    moved_[g] = std::sqrt(farthest);
    widest[g] = reach;
  });
  const double sheared = gradient.norm() * (*std::max_element(widest.begin(), widest.end()) + 0.5 * range);
  for (double& moved : moved_)
    moved += sheared;
  for (std::int64_t g = 0; g < groups; ++g)
    if (!(moved_[g] <= (1.0 - leastLeft) * allowed_[g])) return false;
  return true;
}

} // namespace sandglass
