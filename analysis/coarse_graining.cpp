#include "analysis/coarse_graining.h"

#include "analysis/cell_grid.h"
#include "sim/base/error.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>

namespace sandglass::analysis {

CoarseAverage& CoarseAverage::operator+=(const CoarseAverage& other) {
  mass += other.mass;
  volume += other.volume;
  momentum += other.momentum;
  flux += other.flux;
  contactStress += other.contactStress;
  massGradient += other.massGradient;
  momentumGradient += other.momentumGradient;
  return *this;
}

CoarseAverage& CoarseAverage::operator*=(double factor) {
  mass *= factor;
  volume *= factor;
  momentum *= factor;
  flux *= factor;
  contactStress *= factor;
  massGradient *= factor;
  momentumGradient *= factor;
  return *this;
}

Eigen::Matrix3d CoarseAverage::kineticStress() const {
  return flux - momentum * momentum.transpose() / mass;
}

double CoarseAverage::temperature() const {
  return std::max(0.0, kineticStress().trace() / (3 * mass));
}

Eigen::Matrix3d CoarseAverage::velocityGradient() const {
  return (momentumGradient - velocity() * massGradient.transpose()) / mass;
}

Eigen::Matrix3d CoarseAverage::strainRate() const {
  const Eigen::Matrix3d g = velocityGradient();
  return 0.5 * (g + g.transpose());
}

double CoarseAverage::shearRate() const {
  Eigen::Matrix3d d = strainRate();
  d -= Eigen::Matrix3d::Identity() * d.trace() / 3;
  return std::sqrt(2.0) * d.norm();
}

Vec3 CoarseAverage::vorticity() const {
  const Eigen::Matrix3d g = velocityGradient();
  return {g(2, 1) - g(1, 2), g(0, 2) - g(2, 0), g(1, 0) - g(0, 1)};
}

namespace {

/// One line of force.
struct Branch {
  Vec3 middle, half;      ///< of the line; half of it, towards the grain
  Eigen::Matrix3d stress; ///< f l^T, symmetric part
};

} // namespace

struct CoarseGrainer::Data {
  Domain domain;
  double reach, norm;
  CellGrid grid;
  std::vector<double> mass, volume; ///< sorted as the grid
  std::vector<Vec3> velocity;
  std::vector<Branch> branch;
  std::unique_ptr<CellGrid> branches;
  double longest = 0; ///< half branch

  Data(const Frame& frame, double width)
      : domain(frame.domain), reach(2 * width), norm(105 / (16 * std::numbers::pi * std::pow(2 * width, 3))),
        grid(frame.position, frame.domain, width) {}

  double kernel(double q) const { return q < 1 ? norm * (1 + 3 * q) * (1 - q) * (1 - q) * (1 - q) : 0; }

  Vec3 wrapped(Vec3 x) const {
    for (int k = 0; k < 3; ++k)
      if (domain.periodic[k]) {
        const double length = domain.upper[k] - domain.lower[k];
        x[k] -= length * std::floor((x[k] - domain.lower[k]) / length);
      }
    return x;
  }
};

CoarseGrainer::~CoarseGrainer() = default;

bool CoarseGrainer::hasContacts() const {
  return !data_->branch.empty();
}

CoarseGrainer::CoarseGrainer(const Frame& frame, double width, double diameter, double density)
    : data_(std::make_unique<Data>(frame, width)) {
  Data& d = *data_;
  const auto& velocity = frame.vector(quantity::velocity);
  const auto* radius = frame.has(quantity::radius) ? &frame.scalar(quantity::radius) : nullptr;
  const auto* mass = frame.has(quantity::mass) ? &frame.scalar(quantity::mass) : nullptr;
  for (std::size_t s = 0; s < frame.size(); ++s) {
    const std::size_t i = d.grid.original(s);
    const double r = radius ? (*radius)[i] : 0.5 * diameter;
    d.volume.push_back(4.0 / 3 * std::numbers::pi * r * r * r);
    d.mass.push_back(mass ? (*mass)[i] : density * d.volume.back());
    d.velocity.push_back(velocity[i]);
  }
  if (frame.contacts.empty()) return;

  std::unordered_map<std::int64_t, std::size_t> index;
  for (std::size_t i = 0; i < frame.size(); ++i)
    index.emplace(frame.id[i], i);
  std::vector<Vec3> middles;
  for (const auto& contact : frame.contacts) {
    const auto a = index.find(contact.a);
    if (a == index.end()) continue;
    const Vec3& x = frame.position[a->second];
    Vec3 from = contact.point;
    if (contact.b >= 0) {
      const auto b = index.find(contact.b);
      if (b == index.end()) continue;
      from = frame.position[b->second];
      for (int k = 0; k < 3; ++k)
        from[k] +=
            contact.image[static_cast<std::size_t>(k)] * (frame.domain.upper[k] - frame.domain.lower[k]);
    }
    const Vec3 l = x - from;
    const Eigen::Matrix3d stress = contact.force * l.transpose();
    d.branch.push_back({d.wrapped(0.5 * (x + from)), 0.5 * l, 0.5 * (stress + stress.transpose())});
    d.longest = std::max(d.longest, 0.5 * l.norm());
    middles.push_back(d.branch.back().middle);
  }
  d.branches = std::make_unique<CellGrid>(middles, frame.domain, width);
}

std::vector<CoarseAverage> CoarseGrainer::at(std::span<const Vec3> points) const {
  const Data& d = *data_;
  const auto axes = d.grid.axes();
  std::vector<CoarseAverage> averages(points.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), 64), [&](const auto& range) {
    for (std::size_t p = range.begin(); p < range.end(); ++p) {
      CoarseAverage& sum = averages[p];
      const Vec3 x = d.wrapped(points[p]);
      const std::array<double, 3> c{x[axes[0]], x[axes[1]], x[axes[2]]};
      d.grid.around(c, d.reach, -1, [&](std::size_t begin, std::size_t end, const auto& shift) {
        for (std::size_t s = begin; s < end; ++s) {
          Vec3 h; // from the grain to the point
          for (int k = 0; k < 3; ++k)
            h[axes[k]] = c[k] - shift[k] - d.grid.coordinates(k)[s];
          const double r2 = h.squaredNorm();
          if (r2 >= d.reach * d.reach) continue;
          const double q = std::sqrt(r2) / d.reach, left = 1 - q;
          const double m = d.mass[s] * d.norm * (1 + 3 * q) * left * left * left;
          // grad W = -12 W_0 (1 - q)^2 h / c^2
          const Vec3 gradient = d.mass[s] * d.norm * -12 * left * left / (d.reach * d.reach) * h;
          const Vec3& v = d.velocity[s];
          sum.mass += m;
          sum.volume += d.volume[s] / d.mass[s] * m;
          sum.momentum += m * v;
          sum.flux.noalias() += (m * v) * v.transpose();
          sum.massGradient += gradient;
          sum.momentumGradient.noalias() += v * gradient.transpose();
        }
      });
      if (!d.branches) continue;
      const auto other = d.branches->axes();
      const std::array<double, 3> e{x[other[0]], x[other[1]], x[other[2]]};
      d.branches->around(
          e, d.reach + d.longest, -1, [&](std::size_t begin, std::size_t end, const auto& shift) {
            for (std::size_t s = begin; s < end; ++s) {
              const Branch& branch = d.branch[d.branches->original(s)];
              Vec3 h;
              for (int k = 0; k < 3; ++k)
                h[other[k]] = e[k] - shift[k] - d.branches->coordinates(k)[s];
              // Five-point Gauss-Legendre along the branch: the kernel is a polynomial of degree 4 in r.
              constexpr std::array<double, 3> node{0, 0.5384693101056831, 0.9061798459386640};
              constexpr std::array<double, 3> weight{0.2844444444444444, 0.2393143352496832,
                                                     0.1184634425280945};
              double integral = weight[0] * d.kernel(h.norm() / d.reach);
              for (std::size_t n = 1; n < 3; ++n)
                integral += weight[n] * (d.kernel((h - node[n] * branch.half).norm() / d.reach) +
                                         d.kernel((h + node[n] * branch.half).norm() / d.reach));
              sum.contactStress += integral * branch.stress;
            }
          });
    }
  });
  return averages;
}

} // namespace sandglass::analysis
