#pragma once
// Advances a scene and publishes Frames. `dem` is the first; others come with the same interface.

#include "sim/frame/frame.h"
#include "sim/grains/seeding.h"
#include "sim/scene/scene.h"

#include <cstdint>
#include <iosfwd>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace sandglass {

/// Energies by kind [J]; sums over all grains present, in id order.
struct Energies {
  double translational = 0, rotational = 0, gravitational = 0, elastic = 0;
  double total() const { return translational + rotational + gravitational + elastic; }
};

/// Totals that only grow while a run goes on.
struct Flow {
  // A grain that is put back counts as discharged and as recycled, not as entered again: entered + recycled -
  // discharged is what is there.
  std::int64_t grainsEntered = 0, grainsDischarged = 0, grainsRecycled = 0;
  double massEntered = 0, massDischarged = 0, massRecycled = 0; ///< [kg]
  double lastDischarge = 0; ///< [s], time when a grain last left; 0 if none did
};

/// How the step was chosen, in words and numbers, for `explain`.
struct StepChoice {
  double step = 0;            ///< [s]
  double shortestContact = 0; ///< [s], collision time of the stiffest pair
  double stableLimit = 0;     ///< [s]
  std::string rule;           ///< one sentence
};

class Solver {
public:
  virtual ~Solver() = default;

  /// Adds grains between steps.
  virtual void add(const std::vector<GrainSeed>& grains) = 0;
  virtual void removeWall(const std::string& name) = 0;
  /// From now on the motion of this wall goes `pace` (0 or more) times as fast as the scene says. Part of
  /// what save() gives. Throws InputError when there is no such wall, it has no motion, or it would get too
  /// fast.
  virtual void setWallPace(const std::string& name, double pace) = 0;
  /// From now on velocities and spins decay at this rate [1/s], beside all forces; 0: no more.
  virtual void setDrag(double rate) = 0;
  /// From now on grains fall so; the velocities of this instant stay. Part of what save() gives.
  virtual void setGravity(const Vec3& gravity) = 0; ///< [m/s^2]
  /// From now on a field of the scene is `factor` times as strong as the scene says; 0: off. The velocities
  /// of this instant stay. Part of what save() gives.
  virtual void setField(const std::string& name, double factor);
  /// A stage of the scene begins now; for walls whose motion waits for one.
  virtual void beginStage(const std::string& name) {}

  /// Runs `steps` steps; 0 brings forces up to date after grains or walls have changed. Throws RunError when
  /// the state turned bad (NaN, escape, overlap); then the state is not to be used any more.
  virtual void advance(std::int64_t steps) = 0;

  virtual double time() const = 0; ///< [s]
  virtual std::int64_t step() const = 0;
  virtual double stepSize() const = 0; ///< [s]
  virtual std::size_t grains() const = 0;
  virtual std::size_t freeGrains() const { return grains(); } ///< those that forces can move
  virtual std::int64_t nextId() const = 0;
  virtual bool isFree(const Vec3& position, double radius) const = 0;
  virtual double greatestSpeed() const = 0; ///< [m/s] of a grain that forces can move
  /// Grains that have left through outlets that record or recycle since the last call, in order. To be called
  /// after every advance(): the state that save() gives does not hold them.
  virtual std::vector<LeftGrain> takeLeft() = 0;

  /// Velocities and positions at the same instant; quantities as the scene's output asks, radius always.
  virtual FramePtr frame() const = 0;
  virtual Energies energies() const = 0;
  virtual const Flow& flow() const = 0;
  virtual std::vector<GrainSeed> present() const = 0; ///< ascending ids
  virtual std::vector<FrameWall> walls() const = 0;   ///< with forces now
  /// What moving walls, grains that are frozen in a motion and fields have done to the grains since the run
  /// began [J].
  virtual double wallWork() const { return 0.0; }

  /// Everything that decides the future, bit for bit: a named set of byte arrays.
  using State = std::map<std::string, std::vector<std::byte>>;
  virtual State save() = 0;
  virtual void load(const State& state) = 0;
};

struct SolverOptions {
  int threads = 0; ///< 0: all cores
  /// Frames tell what grains do to walls; else force, torque, work and wear of their walls are zero, and a
  /// frame need not evaluate all forces where velocities do not ask for it.
  bool wallLoads = true;
};

/// Refusals, each a sentence; empty when the solver can run the scene.
std::vector<std::string> solverRefusals(const Scene& scene);
std::unique_ptr<Solver> makeSolver(const Scene& scene, const SolverOptions& options = {});

/// What a run of the scene will model and cost, for `explain`.
struct Forecast {
  StepChoice step;
  std::int64_t grains = 0;
  double bytesPerGrain = 0;
  double secondsPerGrainStep = 0;       ///< measured by a short trial on this machine, one thread
  std::vector<std::string> modelled;    ///< one line each: feature, why, cost
  std::vector<std::string> notModelled; ///< features that cost nothing here
};
Forecast forecast(const Scene& scene);

} // namespace sandglass
