#pragma once
// Takes a run from stage to stage: what a stage changes at its start, rain while it lasts, when it ends.
//
// All decisions fall at fixed steps after the stage's start, so they do not depend on how the steps in
// between are grouped.

#include "sim/base/log.h"
#include "sim/run/energy_watchdog.h"
#include "sim/run/recycling.h"
#include "sim/scene/scene.h"
#include "sim/solvers/solver.h"

#include <memory>
#include <string>

namespace sandglass {

/// Throws InputError for a stage that lasts, or settles no sooner than, more steps than can be counted in a
/// double (2^53, fourteen years of a single grain).
void refuseEndlessStages(const Scene& scene, double stepSize);

class StageControl {
public:
  /// Steps between two looks at rain and cheap end conditions (mass, number of grains).
  static constexpr std::int64_t shortInterval = 20;
  // A stage's quiet_time counts from the last grain that left in the stage; before any has, ten times the
  // time must pass.
  /// Steps between two sums over all grains (settled?, energy from nowhere?); a multiple of shortInterval.
  static constexpr std::int64_t longInterval = 200;

  StageControl(const Scene& scene, Solver& solver, Log log);

  /// Starts the current stage unless it has started: removes walls, places grains. Throws InputError when
  /// they do not fit.
  void begin();
  /// Applies what scene.events say for the steps up to now, each event once; whether there was one.
  bool applyEvents();
  /// The next step at which look() or applyEvents() has something to do.
  std::int64_t nextLook() const;
  /// After steps: rain, energy check, end conditions. Throws RunError from the energy check.
  void look();
  /// Grains that have left, as the solver gives them after each advance.
  void left(const std::vector<LeftGrain>& grains);

  bool done() const { return stage_ >= scene_.stages.size(); } ///< all stages have ended
  std::size_t index() const { return stage_; }
  const std::string& name() const; ///< of the stage that last began; empty before the first
  const std::vector<double>& starts() const { return starts_; } ///< [s], of the stages that have begun
  double fraction() const;                                      ///< of the whole run, 0..1, an estimate

  std::vector<std::byte> save() const;
  void load(const std::vector<std::byte>& bytes);

private:
  /// Fillings look at walls where the scene puts them. Throws InputError for a grain that one has moved onto.
  void checkMovedWalls(const std::vector<GrainSeed>& grains) const;
  std::int64_t stageSteps() const; ///< since the stage began
  void bringIn();                  ///< rain and grains put back
  bool ended(bool longLook) const;
  bool atRest() const;
  double recirculated() const; ///< grains put back in this stage, as a multiple of those there are
  double stageFraction() const;

  const Scene& scene_;
  Solver& solver_;
  Log log_;
  EnergyWatchdog watchdog_;
  std::size_t stage_ = 0;
  bool begun_ = false;
  std::vector<double> starts_;
  std::int64_t start_ = 0; ///< step at which the stage began
  double massAtStart_ = 0; ///< [kg] discharged before the stage
  std::int64_t grainsAtStart_ = 0, recycledAtStart_ = 0;
  std::uint64_t events_ = 0; ///< applied
  double drag_ = 0;          ///< [1/s], of now
  bool endNow_ = false;      ///< an event ends the stage
  std::unique_ptr<Rain> rain_;
  Recycling recycling_;
};

} // namespace sandglass
