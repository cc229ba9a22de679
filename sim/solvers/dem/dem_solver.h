#pragma once
// Soft-sphere discrete element method: contact laws over a neighbour list, leapfrog (ParticleLoop).
// Between steps velocities are half a step behind; frames, energies and checkpoints of other programs see
// those of the full step.
// Bit-equal for any number of threads and across save and load.

#include "sim/base/parallel.h"
#include "sim/contact/law_stack.h"
#include "sim/contact/pair_forces.h"
#include "sim/contact/pair_list.h"
#include "sim/contact/sector_contacts.h"
#include "sim/contact/wall_contacts.h"
#include "sim/fields/field_stack.h"
#include "sim/grains/grain_lives.h"
#include "sim/solvers/dem/frozen_grains.h"
#include "sim/solvers/dem/particle_loop.h"
#include "sim/solvers/solver.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace sandglass {

class DemSolver final : public Solver {
public:
  /// `added`: laws beside those that the scene names. Throws InputError when the scene cannot be run so.
  explicit DemSolver(const Scene& scene, const SolverOptions& options = {},
                     const std::vector<std::shared_ptr<const Law>>& added = {});

  void add(const std::vector<GrainSeed>& grains) override;
  void removeWall(const std::string& name) override;
  void setWallPace(const std::string& name, double pace) override;
  void setDrag(double rate) override { drag_ = rate; }
  void setGravity(const Vec3& gravity) override;
  void setField(const std::string& name, double factor) override;
  void beginStage(const std::string& name) override;
  void advance(std::int64_t steps) override;

  double time() const override { return static_cast<double>(step_) * dt_; }
  std::int64_t step() const override { return step_; }
  double stepSize() const override { return dt_; }
  std::size_t grains() const override { return grains_.size(); }
  std::size_t freeGrains() const override { return grains_.size() - frozen_.count(); }
  std::int64_t nextId() const override { return nextId_; }
  bool isFree(const Vec3& position, double radius) const override;
  double greatestSpeed() const override;
  std::vector<LeftGrain> takeLeft() override { return std::exchange(left_, {}); }

  FramePtr frame() const override;
  Energies energies() const override;
  const Flow& flow() const override { return flow_; }
  std::vector<GrainSeed> present() const override;
  std::vector<FrameWall> walls() const override;
  double wallWork() const override;

  State save() override;
  void load(const State& state) override;

  /// Conserved quantity of a law, in id order of the grains now present.
  std::vector<double> quantity(const std::string& name) const;
  void setQuantity(const std::string& name, const std::vector<double>& values);

  // For benches, tests and `explain`.
  void overrideStep(double step) { dt_ = step; } ///< unchecked [s]; to study what the limit guards against
  std::size_t pairsListed() const { return static_cast<std::size_t>(list_.size()); }
  std::int64_t rebuilds() const { return rebuilds_; }
  bool hasOwnLoop() const { return pairForces_.hasOwnLoop(); } ///< as PairForces
  double bytesPerGrain() const;

private:
  /// Velocities at the full step, and the forces there.
  struct FullStep {
    bool valid = false;              ///< velocities and spins
    bool forcesValid = false;        ///< the rest
    std::vector<Quad> force, torque; ///< of contacts and fields
    std::vector<Vec3> velocity, spin;
    std::vector<WallTally> tallies; ///< of the walls, with what the forces of this instant add
  };

  void checkPromisedSizes(); ///< laws may count on one grain mass a material until a grain has another
  void rebuild(const std::vector<std::uint8_t>& drop = {});
  /// Some group has used up what it may move, as far as steps know: looks at where the grains are. If not,
  /// the lists are to be made anew.
  bool listsLastOn();
  void prepare();     ///< fresh list, newcomers half a step back, after grains or walls have changed
  void changeAhead(); ///< before grains or walls change: keeps the full step as it is, `stale_` from here on
  /// With semi-implicit steps velocities in store are those of the full step, and forces need not be
  /// evaluated.
  const FullStep& fullStep(bool withForces) const;
  void evaluate(std::vector<Quad>& force, std::vector<Quad>& torque) const;
  void stepOnce();
  void applyEvents(std::vector<PairEvent>& events);
  void damp();      ///< a step of drag
  bool discharge(); ///< takes out what has passed an outlet; whether anything has
  void checkOverlap(const DeepestOverlap& deepest) const;
  [[noreturn]] void reportBadMotion() const;
  void refuseFastWalls(double fastest) const; ///< [m/s]
  void checkEscapes() const;
  std::vector<std::int32_t> idOrder() const;
  /// [s] from the velocities in store to those of the full step.
  double halfStep() const { return scene_.accuracy.semiImplicit ? 0.0 : 0.5 * dt_; }
  bool heldFast(std::size_t i) const { return frozen_.holds(grains_.species[i]); }
  double massOf(std::int32_t i) const; ///< [kg] of its material, also when it is frozen
  GrainSeed seedOf(std::int32_t i) const;
  Vec3 wrapped(Vec3 x) const;

  std::vector<FrameWall> wallsNow(bool loads) const;
  std::vector<FrameContact> contactsNow() const; ///< with grains in the order of their ids, then with walls
  void loadWalls(const State& state);
  void loadGrains(const State& state); ///< and their lists
  void loadHistories(const State& state);

  Scene scene_;
  bool wallLoads_; ///< in frames
  mutable FieldStack fields_;
  LawStack laws_;
  mutable Parallel parallel_;
  GrainStore grains_;
  PairList list_;
  PairForces pairForces_;
  mutable WallContacts wallContacts_;
  mutable SectorContacts across_; ///< the faces of a wedge
  FrozenGrains frozen_;
  mutable ParticleLoop loop_;
  mutable FullStep atFullStep_;
  mutable std::vector<SolverWall> walls_;
  double wallRadius_ = 0; ///< [m] no grain is further from a moving wall's reference
  double dt_ = 0, skin_ = 0, meanDiameter_ = 0, smallestRadius_ = 0;
  std::int64_t step_ = 0, nextId_ = 0, rebuilds_ = 0;
  bool stale_ = true;                   ///< list and forces are not those of the grains and walls now
  std::vector<std::int64_t> newcomers_; ///< ids of grains whose velocities are still those of the full step
  double drag_ = 0;                     ///< [1/s]
  Vec3 gravity_;                        ///< [m/s^2], of now
  Flow flow_;
  GrainLives lives_;
  std::vector<LeftGrain> left_;
};

} // namespace sandglass
