#include "analysis/state_map.h"

#include "analysis/coarse_graining.h"
#include "analysis/coordination.h"
#include "analysis/free_surface.h"
#include "analysis/neighbour_list.h"

#include <Eigen/LU>
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sandglass::analysis {

GrainState stateOf(const GrainMotion& m, const StateThresholds& limits) {
  if ((m.fraction < limits.gasFraction && m.contacts < limits.gasContacts) || m.inertia > limits.gasInertia)
    return GrainState::gas;
  if (m.inertia < limits.solidInertia && !(m.rearrangement > limits.rearranged)) return GrainState::solid;
  return GrainState::liquid;
}

/// D2min: what is left of the neighbours' relative displacements after the best affine map, per neighbour.
std::vector<double> StateMap::rearrangement(const Frame& frame) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const std::size_t n = frame.size();
  std::vector<double> d2min(n, nan);
  const auto nearest = [&](Vec3 h) {
    for (int k = 0; k < 3; ++k)
      if (frame.domain.periodic[static_cast<std::size_t>(k)]) {
        const double length = frame.domain.upper[k] - frame.domain.lower[k];
        h[k] -= length * std::round(h[k] / length);
      }
    return h;
  };
  std::unordered_map<std::int64_t, std::size_t> now;
  for (std::size_t i = 0; i < n; ++i)
    now.emplace(frame.id[i], i);
  if (!before_.empty() && frame.persistentIds)
    for (std::size_t i = 0; i < n; ++i) {
      const auto self = beforeIndex_.find(frame.id[i]);
      if (self == beforeIndex_.end()) continue;
      std::vector<std::pair<Vec3, Vec3>> bonds; // before, now
      for (const std::int64_t id : beforeNeighbours_[self->second]) {
        const auto other = now.find(id);
        const auto then = beforeIndex_.find(id);
        if (other == now.end() || then == beforeIndex_.end()) continue;
        bonds.emplace_back(nearest(before_[then->second] - before_[self->second]),
                           nearest(frame.position[other->second] - frame.position[i]));
      }
      if (bonds.size() < 4) continue;
      Eigen::Matrix3d x = Eigen::Matrix3d::Zero(), y = x;
      for (const auto& [a, b] : bonds) {
        x += b * a.transpose();
        y += a * a.transpose();
      }
      // Neighbours in one plane leave the map open: a grain's share of the unit keeps it defined.
      y += 1e-6 * y.trace() * Eigen::Matrix3d::Identity();
      const Eigen::Matrix3d affine = x * y.inverse();
      double sum = 0;
      for (const auto& [a, b] : bonds)
        sum += (b - affine * a).squaredNorm();
      d2min[i] = sum / static_cast<double>(bonds.size()) / (options_.diameter * options_.diameter);
    }
  const NeighbourList list = neighboursWithin(frame.position, frame.domain, 1.5 * options_.diameter);
  before_ = frame.position;
  beforeIndex_ = std::move(now);
  beforeNeighbours_.assign(n, {});
  for (std::size_t i = 0; i < n; ++i)
    for (const auto j : list.indices(i))
      beforeNeighbours_[i].push_back(frame.id[j]);
  return d2min;
}

void StateMap::add(const Frame& frame) {
  const double d = options_.diameter, solid = options_.density > 0 ? options_.density : 2500;
  const std::size_t n = frame.size();
  const CoarseGrainer grainer(frame, options_.width * d, d, solid);
  const auto averages = grainer.at(frame.position);
  forces_ = forces_ || grainer.hasContacts();
  const ContactCounts counts = contactCounts(frame, options_.contactGap, 1);
  const auto d2min = rearrangement(frame);
  std::optional<FreeSurface> surface;
  if (options_.up && options_.gravity > 0) surface.emplace(frame, *options_.up, 1.5 * d, d);

  // Contacts as the mean over the grain and its neighbours: one grain's number is coarse.
  const NeighbourList list = neighboursWithin(frame.position, frame.domain, 1.5 * d);
  motion_.resize(n);
  tbb::parallel_for(std::size_t{0}, n, [&](std::size_t i) {
    const CoarseAverage& a = averages[i];
    GrainMotion& m = motion_[i];
    m.fraction = a.volume;
    m.temperature = a.temperature();
    m.rearrangement = d2min[i];
    double contacts = counts.contacts[i];
    for (const auto j : list.indices(i))
      contacts += counts.contacts[j];
    m.contacts = contacts / (1 + list.count(i));
    double pressure = a.kineticStress().trace() / 3;
    if (grainer.hasContacts()) pressure = a.pressure();
    const double layer = solid * options_.gravity * d * 0.6;
    if (surface) {
      const double height = surface->heightAt(frame.position[i]) - frame.position[i].dot(surface->axes().up);
      if (!grainer.hasContacts() && m.contacts >= options_.limits.gasContacts)
        pressure = std::max(pressure, a.volume * solid * options_.gravity * std::max(0.0, height));
      if (m.contacts >= options_.limits.gasContacts) pressure = std::max(pressure, layer);
    }
    const double shear = a.shearRate();
    m.inertia = shear == 0     ? 0
                : pressure > 0 ? shear * d * std::sqrt(solid / pressure)
                               : std::numeric_limits<double>::infinity();
  });

  std::array<double, 3> count{};
  states_.resize(n);
  std::unordered_map<std::int64_t, std::vector<std::uint8_t>> memory;
  for (std::size_t i = 0; i < n; ++i) {
    const auto now = static_cast<std::uint8_t>(stateOf(motion_[i], options_.limits));
    std::vector<std::uint8_t> history;
    if (frame.persistentIds)
      if (auto it = past_.find(frame.id[i]); it != past_.end()) history = std::move(it->second);
    history.push_back(now);
    if (static_cast<int>(history.size()) > options_.memory) history.erase(history.begin());
    std::array<int, 3> votes{};
    for (const auto s : history)
      ++votes[s];
    std::uint8_t smooth = now; // of equal ones the newest
    for (std::uint8_t s = 0; s < 3; ++s)
      if (votes[s] > votes[smooth]) smooth = s;
    states_[i] = static_cast<GrainState>(smooth);
    count[smooth] += 1;
    flicker_[now][smooth] += 1;
    memory.emplace(frame.id[i], std::move(history));
  }
  past_ = std::move(memory);
  Shares shares{frame.time, {}};
  for (std::size_t s = 0; s < 3; ++s)
    shares.share[s] = n > 0 ? count[s] / static_cast<double>(n) : 0;
  shares_.push_back(shares);
  const std::size_t stride = std::max<std::size_t>(1, n / 20000);
  for (std::size_t i = 0; i < n; i += stride)
    sample_.push_back(motion_[i]);
}

std::vector<std::pair<std::string, std::array<double, 3>>> StateMap::sensitivity() const {
  std::vector<std::pair<std::string, std::array<double, 3>>> rows;
  const auto row = [&](const std::string& name, const StateThresholds& limits) {
    std::array<double, 3> share{};
    for (const auto& m : sample_)
      share[static_cast<std::size_t>(stateOf(m, limits))] += 1.0 / static_cast<double>(sample_.size());
    rows.emplace_back(name, share);
  };
  row("as given", options_.limits);
  for (const double factor : {0.8, 1.2})
    for (const auto& [name, member] : {std::pair{"solid_inertia", &StateThresholds::solidInertia},
                                       {"gas_inertia", &StateThresholds::gasInertia},
                                       {"gas_fraction", &StateThresholds::gasFraction},
                                       {"gas_contacts", &StateThresholds::gasContacts},
                                       {"rearranged", &StateThresholds::rearranged}}) {
      StateThresholds limits = options_.limits;
      limits.*member *= factor;
      row(fmt::format("{} x {}", name, factor), limits);
    }
  return rows;
}

std::string StateMap::definition() const {
  const auto& l = options_.limits;
  return fmt::format(
      "gas: phi < {} and fewer than {} contacts, or I > {}; solid: I < {} and D2min < {} d^2 between "
      "frames; liquid: the rest; I = shear rate d sqrt(rho_s / P), P from {}; averages with Lucy's kernel of "
      "width {} d; the commonest state of the last {} frame{}",
      l.gasFraction, l.gasContacts, l.gasInertia, l.solidInertia, l.rearranged,
      forces_                               ? "contact forces"
      : options_.up && options_.gravity > 0 ? "the weight above, since there are no forces"
                                            : "kinetic stress, since there are no forces",
      options_.width, options_.memory, options_.memory == 1 ? "" : "s");
}

} // namespace sandglass::analysis
