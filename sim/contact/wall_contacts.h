#pragma once
// Grains at walls: who is near which wall, the forces there, and histories that follow a grain along a wall.

#include "sim/contact/law_stack.h"
#include "sim/contact/pair_forces.h"
#include "sim/contact/solver_wall.h"
#include "sim/contact/wall_block.h"
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

  /// What one thread needs for a sweep over a stretch of grains. Contacts are evaluated many at a time, ahead
  /// of the grains whose forces are asked for.
  struct Sweep {
    DeepestOverlap deepest; ///< of all contacts since it was last reset

  private:
    friend class WallContacts;
    WallBlock block;
    std::int32_t next = 0, end = 0; ///< candidates of the stretch that are to come
    int row = 0;                    ///< of the block, to be added next
    std::int64_t upcoming = 0;      ///< its grain; greater than any if there is none
    double dt = 0;
    bool keepHistory = false, loads = false;
  };
  /// Begins a sweep over the grains in [first, last), for a step of length dt. `loads`: total() and tally()
  /// will be asked about this step. They need all grains' forces of it.
  void begin(Sweep& sweep, const GrainStore& grains, const std::vector<SolverWall>& walls, std::int64_t first,
             std::int64_t last, double dt, bool keepHistory, bool loads);
  /// Adds forces and torques over radius to the sums of the grains in [first, last), in wall order. From
  /// group to group of a sweep; grains behind `first` are still where the step found them.
  void addTo(GroupSums sums, const GrainStore& grains, const std::vector<SolverWall>& walls,
             std::int64_t first, std::int64_t last, Sweep& sweep);

  /// Whether tally() reads the forces of each step.
  bool tallied() const { return moving_; }

  /// Force of the grains on wall w [N] and its torque about the origin [N m], of the last sweep with loads.
  void total(int wall, Vec3& force, Vec3& torque) const;

  /// After a sweep over all grains: adds to the walls' tallies what moving and counted walls have done in it.
  /// The work of a step is dt times the mean of the powers at its ends, as leap-frog integration makes it.
  void tally(std::vector<SolverWall>& walls, double dt) const;

  double storedEnergy(const GrainStore& grains, const std::vector<SolverWall>& walls) const;

  /// Calls visit(grain, wall, block, c, touch) for each contact with present forces; changes nothing.
  template <class Visit>
  void visitContacts(const GrainStore& grains, const std::vector<SolverWall>& walls, Visit&& visit) const;

  /// Calls change(grain, history) for the history of each contact there is, between a step and build().
  template <class Change> void changeHistories(Change&& change) {
    const std::size_t size = static_cast<std::size_t>(laws_.historySize());
    for (std::size_t k = 0; size > 0 && k < feature_.size(); ++k)
      if (feature_[k] >= 0) change(candidates_[k % candidates_.size()].grain, history_.data() + k * size);
  }

  /// For checkpoints: what cannot be made again from positions.
  /// All slots of a candidate side by side.
  std::vector<double> histories() const;
  std::vector<std::int32_t> features() const;
  /// False, and nothing done, if the size is another.
  bool setHistories(const std::vector<double>& all);
  bool setFeatures(const std::vector<std::int32_t>& all);

  std::size_t size() const { return candidates_.size(); }

private:
  static constexpr int mostSlots = WallShape::maxTouches;
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
  std::size_t row(std::int32_t candidate, int slot) const { return slot * candidates_.size() + candidate; }
  /// Puts contacts of the candidates from k on into an empty block, until it is full or `end` is reached:
  /// geometry, motion and history. Returns the first candidate that had no place.
  std::int32_t gather(const GrainStore& grains, const std::vector<SolverWall>& walls, std::int32_t k,
                      std::int32_t end, WallBlock& block) const;
  void gatherOne(const GrainStore& grains, const SolverWall& wall, std::int32_t candidate,
                 const WallTouch& touch, int slot, WallBlock& block) const;
  void finish(const std::vector<SolverWall>& walls, double dt, WallBlock& block) const;
  /// Slots of history that the candidate's contacts go on with: that of the same feature, or
  /// one whose feature has just ended; -1: it begins. Returns how many begin.
  int matchHistories(std::int32_t candidate, const WallShape::Touches& now, int* source) const;
  bool counted(std::int32_t candidate, const std::vector<SolverWall>& walls) const {
    return walls[candidates_[candidate].wall].counted;
  }
  void evaluate(const GrainStore& grains, const std::vector<SolverWall>& walls, Sweep& sweep);
  void remember(const WallBlock& block);
  void next(const GrainStore& grains, const std::vector<SolverWall>& walls, Sweep& sweep);
  void keepLoad(const GrainStore& grains, const Sweep& sweep);

  const LawStack& laws_;
  int slots_ = 1; ///< of history a candidate: as many as any of the walls can be touched in
  std::vector<Candidate> candidates_;
  std::vector<Slack> slack_;          ///< per candidate
  std::vector<std::int32_t> offsets_; ///< candidates of each grain
  std::vector<std::int64_t> ids_;     ///< id of each candidate's grain, for carrying
  // Slot by slot, candidates side by side: few have more than one contact.
  std::vector<std::int32_t> feature_; ///< -1: empty
  std::vector<double> history_;       ///< historySize each
  std::vector<double> load_;        ///< force on the grain and its torque about the origin, six per candidate
  bool moving_ = false;             ///< some wall moves
  bool counting_ = false;           ///< some listed wall is counted
  std::vector<double> slipWork_;    ///< [J] per candidate in the last step, where counted
  std::vector<std::int32_t> begun_; ///< contacts that began in it
};

template <class Visit>
void WallContacts::visitContacts(const GrainStore& grains, const std::vector<SolverWall>& walls,
                                 Visit&& visit) const {
  WallBlock block;
  const auto end = static_cast<std::int32_t>(candidates_.size());
  for (std::int32_t k = 0; k < end;) {
    k = gather(grains, walls, k, end, block);
    finish(walls, 0.0, block);
    for (int c = 0; c < block.contact.size; ++c) {
      const Candidate& at = candidates_[block.owner[c]];
      const ContactBlock& b = block.contact;
      visit(at.grain, at.wall, b, c,
            WallTouch{block.distance[c], Vec3(b.nx[c], b.ny[c], b.nz[c]), block.feature[c]});
    }
  }
}

} // namespace sandglass
