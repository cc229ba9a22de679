#pragma once
// A contact law: a pure function of geometry, relative motion and history, evaluated block by block.
// To add one: a file in laws/ and a line in law_registry.cpp.

#include "sim/contact/contact_block.h"
#include "sim/contact/kernel_width.h"
#include "sim/contact/law_columns.h"
#include "sim/contact/law_registry.h"
#include "sim/scene/parameters.h"

#include <limits>
#include <string>
#include <vector>

namespace sandglass {

/// What a law may know of a pair of materials.
struct PairType {
  bool used = false;        ///< whether grains of the scene can meet so
  Parameters parameters;    ///< of the law for this pair
  double referenceMass = 0; ///< [kg] reduced mass of the mean grains
  /// [kg] reduced mass that all its contacts have exactly, with walls or among grains of one size; 0 when
  /// they differ.
  double uniformMass = 0;
  double largestEffectiveRadius = 0; ///< [m] of two of the largest grains, or of one at a wall
  std::string materialA, materialB;  ///< names
  bool swapped = false;              ///< the scene names the two materials in the other order
  double effectiveYoungsModulus = 0; ///< [Pa], 1/E* = (1-nu1^2)/E1 + (1-nu2^2)/E2; 0 when not given
  double effectiveShearModulus = 0;  ///< [Pa], 1/G* = (2-nu1)/G1 + (2-nu2)/G2
};

struct FusedLaws;

struct LawContext {
  std::vector<PairType> types;
};

/// Conserved quantities of the two grains of an event; pointers are null for a wall.
struct EventGrains {
  std::vector<double*> a, b; ///< in the order of Law::grainQuantities()
};

class Law : public LawColumns {
public:
  virtual ~Law() = default;

  /// Doubles of history per pair. All zero when the pair is born.
  virtual int historySize() const { return 0; }
  /// Where in its history vectors begin, three numbers each: what turns with the grains where a wedge is
  /// simulated.
  virtual std::vector<int> historyVectors() const { return {}; }
  /// Largest gap at which the law can act [m]; 0 for laws that act in contact alone. Sizes lists.
  virtual double range() const { return 0.0; }
  /// Optional columns of the block that it reads, LawColumns.
  virtual unsigned reads() const { return radii | masses | effectiveRadius | effectiveMass; }
  /// Whether it reads the relative spin (wx, wy, wz) and writes couples, and whether it can turn grains at
  /// all.
  virtual bool readsSpin() const { return false; }
  virtual bool turnsGrains() const { return false; }
  /// Whether the couples that it writes are all that turns the grains, the same on both, while tangential
  /// forces have no torque. It then reads the sum of the spins in (wx, wy, wz). For laws that are kept for
  /// their results, not for their physics; grains of one size alone.
  virtual bool ownTorque() const { return false; }
  /// Whether slip and torque are to use the full radii as lever arms. Default: arms up to the contact point,
  /// which add up to the distance of the centres and so keep angular momentum to round-off.
  virtual bool fullRadiusArm() const { return false; }
  /// Names of per-grain conserved quantities (liquid, charge) that its events move.
  virtual std::vector<std::string> grainQuantities() const { return {}; }

  /// Adds its force for every contact of the block and updates its history, which is
  /// block.history[firstHistory ... firstHistory + historySize() - 1]. Every listed pair is in
  /// the block, also those with a gap; contact laws leave these without force and with zero history.
  virtual void apply(ContactBlock& block, int firstHistory, KernelWidth width) const = 0;
  /// Adds itself to a combination that may have a loop of its own. A law that does not is never fused.
  virtual void fuse(FusedLaws&) const {}
  /// The same under mixed precision, for laws that have it.
  virtual void apply(ContactBlockSingle& block, int firstHistory, KernelWidth width) const {}
  virtual bool singlePrecision() const { return false; }

  /// Energy stored in contact c [J], for the energy balance. Reads geometry, stiffness and history.
  virtual double storedEnergy(const ContactBlock& block, int c, int firstHistory) const { return 0.0; }

  /// Duration of a collision of a pair of materials [s]; infinite for laws that set no time scale. Hertzian
  /// laws read the impact speed [m/s].
  virtual double collisionTime(int type, double reducedMass, double effectiveRadius, double speed) const {
    return std::numeric_limits<double>::infinity();
  }

  /// What the cut-off of a force across a gap leaves out between two alike grains of this effective radius
  /// [m], or between a grain of this radius and a wall; empty for laws without a cut-off.
  virtual std::string truncation(int type, double effectiveRadius, bool wall) const { return {}; }

  /// Called after the force loop, in pair order, for events that apply() raised and for live pairs that are
  /// torn away (a grain leaves the run). May move grain quantities and set the pair's history.
  virtual void onEvent(ContactEvent event, double* history, const EventGrains& grains) const {}
};

} // namespace sandglass
