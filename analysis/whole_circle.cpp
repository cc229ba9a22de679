#include "analysis/whole_circle.h"

#include "sim/base/error.h"

#include <fmt/format.h>

#include <cmath>

namespace sandglass::analysis {

namespace {

constexpr std::int64_t stride = std::int64_t{1} << 40;

Eigen::Quaterniond turnOf(const Sector& sector, int k) {
  Eigen::Matrix3d matrix;
  for (int axis = 0; axis < 3; ++axis)
    matrix.col(axis) = sector.turned(Vec3::Unit(axis), k);
  return Eigen::Quaterniond(matrix);
}

/// Bounds that hold all images, too.
void widen(Domain& domain, const std::vector<Vec3>& positions) {
  for (const Vec3& x : positions) {
    domain.lower = domain.lower.cwiseMin(x);
    domain.upper = domain.upper.cwiseMax(x);
  }
}

} // namespace

Frame WholeCircle::add(const Frame& frame) {
  const std::size_t n = frame.size();
  const int count = sector_.count();
  std::unordered_map<std::int64_t, Place> now;
  std::vector<int> turns(n);
  for (std::size_t i = 0; i < n; ++i) {
    if (frame.id[i] < 0 || frame.id[i] >= stride)
      throw InputError(
          fmt::format("the id {} is beyond {}, up to which the grains of a wedge can be told apart",
                      frame.id[i], stride));
    Place& place = now[frame.id[i]];
    place.position = frame.position[i];
    if (const auto before = place_.find(frame.id[i]); before != place_.end()) {
      const Vec3 was = sector_.turned(before->second.position, sector_.modulo(before->second.turns));
      double least = INFINITY;
      for (const int step : {0, -1, 1}) {
        const int k = sector_.modulo(before->second.turns + step);
        const double moved = (sector_.turned(frame.position[i], k) - was).squaredNorm();
        if (moved >= least) continue;
        least = moved;
        place.turns = k;
      }
    }
    turns[i] = place.turns;
  }
  place_ = std::move(now);

  Frame whole;
  whole.time = frame.time;
  whole.step = frame.step;
  whole.stage = frame.stage;
  whole.persistentIds = frame.persistentIds;
  whole.speciesNames = frame.speciesNames;
  whole.domain = frame.domain;
  whole.walls = frame.walls;
  whole.shapes = frame.shapes;
  whole.fields = frame.fields;
  whole.provenance = frame.provenance;
  for (int k = 0; k < count; ++k) {
    const auto turned = [&](const Vec3& v, std::size_t i) {
      return sector_.turned(v, sector_.modulo(k + turns[i]));
    };
    for (std::size_t i = 0; i < n; ++i) {
      whole.id.push_back(frame.id[i] + k * stride);
      whole.position.push_back(turned(frame.position[i], i));
    }
    for (const auto& [name, values] : frame.scalars)
      whole.scalars[name].insert(whole.scalars[name].end(), values.begin(), values.end());
    for (const auto& [name, values] : frame.vectors)
      for (std::size_t i = 0; i < n; ++i)
        whole.vectors[name].push_back(turned(values[i], i));
    for (std::size_t i = 0; i < frame.orientation.size(); ++i)
      whole.orientation.push_back(turnOf(sector_, sector_.modulo(k + turns[i])) * frame.orientation[i]);
    for (const FrameContact& contact : frame.contacts) {
      const int turnsOfA = place_.at(contact.a).turns, turn = sector_.modulo(k + turnsOfA);
      FrameContact copy = contact;
      copy.a += k * stride;
      if (contact.b >= 0)
        copy.b += sector_.modulo(k + turnsOfA + contact.image[0] - place_.at(contact.b).turns) * stride;
      copy.image = {0, 0, 0};
      copy.point = sector_.turned(contact.point, turn);
      copy.normal = sector_.turned(contact.normal, turn);
      copy.force = sector_.turned(contact.force, turn);
      whole.contacts.push_back(copy);
    }
  }
  widen(whole.domain, whole.position);
  return whole;
}

} // namespace sandglass::analysis
