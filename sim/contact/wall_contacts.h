#pragma once
// Grains at walls: who is near which wall, the forces there, and histories that follow a grain along a wall.

#include "sim/contact/law_stack.h"
#include "sim/contact/pair_forces.h"
#include "sim/contact/solver_wall.h"
#include "sim/grains/grain_store.h"
#include "sim/walls/wall_shape.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace sandglass {

class WallContacts {
public:
  explicit WallContacts(const LawStack& laws) : laws_(laws) {}

  /// Lists grains within radius + range + allowed movement of an active wall, its own movement too. Histories
  /// are carried by (grain id, wall).
  void build(const GrainStore& grains, const std::vector<SolverWall>& walls, double margin,
             Parallel& parallel);

  void step(const GrainStore& grains, const std::vector<SolverWall>& walls, double dt, Parallel& parallel,
            DeepestOverlap& deepest);

  /// Adds forces and torques over radius of the last step to the sums of the grains in [first, last), in
  /// wall order.
  void addTo(GroupSums& sums, const GrainStore& grains, std::int64_t first, std::int64_t last) const;

  /// Force of the grains on wall w [N] and its torque about the origin [N m], of the last step.
  void total(const GrainStore& grains, int wall, Vec3& force, Vec3& torque) const;

  /// After step(): adds to the walls' tallies what moving and counted walls have done in it. The work of
  /// a step is dt times the mean of the powers at its ends, as leap-frog integration makes it.
  void tally(const GrainStore& grains, std::vector<SolverWall>& walls, double dt) const;

  double storedEnergy(const GrainStore& grains, const std::vector<SolverWall>& walls) const;

  /// Calls visit(grain, wall, block, c, distance) for each contact with present forces; changes nothing.
  template <class Visit>
  void visitContacts(const GrainStore& grains, const std::vector<SolverWall>& walls, Visit&& visit) const;

  /// Calls change(grain, history) for the history of each contact there is, between step() and build().
  template <class Change> void changeHistories(Change&& change) {
    const std::size_t size = static_cast<std::size_t>(laws_.historySize());
    for (std::size_t k = 0; size > 0 && k < feature_.size(); ++k)
      if (feature_[k] >= 0) change(candidates_[k / slots].grain, history_.data() + k * size);
  }

  /// For checkpoints: what cannot be made again from positions.
  std::vector<double>& historyArray() { return history_; }
  std::vector<std::int32_t>& featureArray() { return feature_; }
  const std::vector<double>& historyArray() const { return history_; }
  const std::vector<std::int32_t>& featureArray() const { return feature_; }

  std::size_t size() const { return candidates_.size(); }

private:
  static constexpr int slots = WallShape::maxTouches;
  struct Candidate {
    std::int32_t grain = 0;
    std::int32_t wall = 0;
  };
  /// Where a grain was when it was listed, and the square of the way that it can go from there without
  /// touching the wall: most grains near a wall do not touch it, and need no more than a comparison. 0 for
  /// moving walls.
  struct Slack {
    double x = 0, y = 0, z = 0, squared = 0;
  };
  struct Found {
    Candidate candidate;
    Slack slack;
  };
  /// Grains that may touch a wall before they are listed again, in storage order, in pieces.
  std::vector<std::vector<Found>> findNear(const GrainStore& grains, const std::vector<SolverWall>& walls,
                                           double range, Parallel& parallel) const;
  bool parted(const GrainStore& grains, std::size_t candidate) const {
    const Slack& s = slack_[candidate];
    const Quad& now = grains.place[candidates_[candidate].grain];
    const double dx = now.x - s.x, dy = now.y - s.y, dz = now.z - s.z;
    return dx * dx + dy * dy + dz * dz < s.squared;
  }
  /// Contacts of one candidate, in ascending order of feature.
  int touches(const GrainStore& grains, const std::vector<SolverWall>& walls, std::size_t candidate,
              double reach, WallShape::Touches& out) const;
  bool counted(std::size_t candidate, const std::vector<SolverWall>& walls) const {
    return counting_ && walls[candidates_[candidate].wall].counted;
  }
  void fillOne(const GrainStore& grains, const SolverWall& wall, std::int32_t grain, const WallTouch& touch,
               const double* history, ContactBlock& block, int c) const;
  /// Row of history that each contact goes on with: that of its feature, or one whose feature has just ended.
  /// Returns how many contacts have none, and so begin.
  int matchHistories(std::size_t candidate, const WallShape::Touches& now, double* histories) const;

  const LawStack& laws_;
  std::vector<Candidate> candidates_;
  std::vector<Slack> slack_;          ///< per candidate
  std::vector<std::int32_t> offsets_; ///< candidates of each grain
  std::vector<std::int64_t> ids_;     ///< id of each candidate's grain, for carrying
  std::vector<std::int32_t> feature_; ///< slots per candidate; -1: empty
  std::vector<double> history_;       ///< slots x historySize per candidate
  std::vector<double> result_;        ///< force and torque on the grain, six per candidate
  bool counting_ = false;             ///< some listed wall is counted
  std::vector<double> slipWork_;      ///< [J] per candidate in the last step, where counted
  std::vector<std::int32_t> begun_;   ///< contacts that began in it
};

template <class Visit>
void WallContacts::visitContacts(const GrainStore& grains, const std::vector<SolverWall>& walls,
                                 Visit&& visit) const {
  ContactBlock block;
  block.dt = 0.0;
  std::vector<double> histories(static_cast<std::size_t>(slots) * std::max(1, laws_.historySize()));
  for (std::size_t k = 0; k < candidates_.size(); ++k) {
    WallShape::Touches now;
    if (touches(grains, walls, k, laws_.range(), now) == 0) continue;
    matchHistories(k, now, histories.data());
    block.size = now.count;
    const Candidate& at = candidates_[k];
    for (int c = 0; c < now.count; ++c)
      fillOne(grains, walls[at.wall], at.grain, now.at[c], histories.data() + c * laws_.historySize(), block,
              c);
    laws_.apply(block, true);
    for (int c = 0; c < now.count; ++c)
      visit(at.grain, at.wall, block, c, now.at[c]);
  }
}

} // namespace sandglass
