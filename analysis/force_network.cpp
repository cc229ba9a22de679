#include "analysis/force_network.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace sandglass::analysis {

Eigen::Matrix3d fabric(const Frame& frame, bool weighted) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  double total = 0;
  for (const auto& c : frame.contacts) {
    if (c.b < 0 || c.overlap < 0) continue;
    const double w = weighted ? std::max(0.0, c.force.dot(c.normal)) : 1;
    sum += w * c.normal * c.normal.transpose();
    total += w;
  }
  return total > 0 ? Eigen::Matrix3d(sum / total) : Eigen::Matrix3d(Eigen::Matrix3d::Identity() / 3);
}

double anisotropy(const Eigen::Matrix3d& fabric) {
  return std::sqrt(1.5) * (fabric - Eigen::Matrix3d::Identity() / 3).norm();
}

std::vector<ForceChain> forceChains(const Frame& frame, double angle) {
  const std::size_t n = frame.size();
  std::unordered_map<std::int64_t, std::size_t> index;
  for (std::size_t i = 0; i < n; ++i)
    index.emplace(frame.id[i], i);
  struct Link {
    std::size_t other;
    Vec3 direction; ///< towards it
  };
  std::vector<Eigen::Matrix3d> stress(n, Eigen::Matrix3d::Zero());
  std::vector<std::vector<Link>> links(n);
  for (const auto& c : frame.contacts) {
    if (c.overlap < 0) continue;
    const auto a = index.find(c.a), b = index.find(c.b);
    // Moment f x lever of each grain; the lever runs against the normal on a, along it on b.
    const double f = c.force.dot(c.normal);
    const Eigen::Matrix3d part = f * c.normal * c.normal.transpose();
    if (a != index.end()) stress[a->second] += part;
    if (c.b < 0 || b == index.end() || a == index.end()) continue;
    stress[b->second] += part;
    links[a->second].push_back({b->second, -c.normal});
    links[b->second].push_back({a->second, c.normal});
  }
  std::vector<double> strength(n);
  std::vector<Vec3> direction(n, Vec3::UnitX());
  double mean = 0, loaded = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (stress[i].isZero()) continue;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(stress[i]);
    strength[i] = eigen.eigenvalues()[2];
    direction[i] = eigen.eigenvectors().col(2);
    mean += strength[i], loaded += 1;
  }
  mean /= std::max(1.0, loaded);
  const double least = std::cos(angle);
  // The best continuation of a grain to either side of its principal direction.
  const auto next = [&](std::size_t i, double side) -> std::ptrdiff_t {
    std::ptrdiff_t best = -1;
    double straightest = least;
    for (const auto& link : links[i]) {
      const double along = side * link.direction.dot(direction[i]);
      if (!(strength[link.other] > mean) || along < straightest ||
          std::abs(link.direction.dot(direction[link.other])) < least)
        continue;
      straightest = along;
      best = static_cast<std::ptrdiff_t>(link.other);
    }
    return best;
  };
  std::vector<char> used(n);
  std::vector<ForceChain> chains;
  for (std::size_t i = 0; i < n; ++i) {
    if (used[i] || !(strength[i] > mean)) continue;
    std::vector<std::size_t> chain{i};
    used[i] = 1;
    for (const double side : {1.0, -1.0}) {
      Vec3 heading = side * direction[i];
      for (std::size_t at = i;;) {
        const std::ptrdiff_t to = next(at, heading.dot(direction[at]) > 0 ? 1 : -1);
        if (to < 0 || used[static_cast<std::size_t>(to)]) break;
        at = static_cast<std::size_t>(to);
        used[at] = 1;
        heading = heading.dot(direction[at]) > 0 ? direction[at] : Vec3(-direction[at]);
        chain.push_back(at);
      }
      std::reverse(chain.begin(), chain.end());
    }
    if (chain.size() >= 3) chains.push_back({std::move(chain)});
  }
  std::stable_sort(chains.begin(), chains.end(), [](const ForceChain& a, const ForceChain& b) {
    return a.grains.size() > b.grains.size();
  });
  return chains;
}

} // namespace sandglass::analysis
