#pragma once
// The laws of one scene in the order in which a block passes them, and what they need between them.

#include "sim/contact/fused/fused_laws.h"
#include "sim/contact/law.h"
#include "sim/scene/scene.h"

#include <memory>
#include <string>
#include <vector>

namespace sandglass {

class LawStack {
public:
  /// Throws InputError (a phrase) when laws contradict their parameters or each other.
  /// Scenes may promise one size for a material; `anySize` ignores that, for grains that break the promise.
  explicit LawStack(const Scene& scene, bool anySize = false);

  /// Adds a law that no scene names; for programs and tests that bring their own.
  void add(std::shared_ptr<const Law> law);

  /// Runs a filled block through all laws, from zero forces. Events of gap laws stay in the block.
  void apply(ContactBlock& block, bool couples) const;
  /// The same onto forces that are there (zero, as kernels leave them).
  void addForces(ContactBlock& block) const;

  /// What the laws are together between grains of one material; `other` where they have no loop of their own.
  FusedLaws fused(int material) const;

  /// Whether a grain has the mass that PairType::uniformMass promised to the laws.
  bool asPromised(int material, double inverseMass) const {
    return promisedInverseMass_[material] == 0.0 || promisedInverseMass_[material] == inverseMass;
  }
  /// Takes the promise back: laws read each pair's mass from now on, with the same bits.
  void allowAnySize(const Scene& scene);

  struct Entry {
    std::shared_ptr<const Law> law;
    std::string name;
    LawRole role;
    int firstHistory = 0;
    std::vector<int> quantities; ///< rows of GrainStore::quantities
  };

  const std::vector<Entry>& entries() const { return entries_; }
  const LawContext& context() const { return context_; }
  int materials() const { return materials_; }
  int typeOf(int materialA, int materialB) const { return materialA * materials_ + materialB; }
  int historySize() const { return history_; }
  double range() const { return range_; }
  unsigned reads() const { return reads_; } ///< columns of the block, Law::Columns
  KernelWidth width() const { return width_; }
  bool fastArithmetic() const { return fastArithmetic_; } ///< AccuracySpec::fastArithmetic
  bool mixed() const { return mixed_; }                   ///< AccuracySpec::mixedPrecision
  void useWidth(KernelWidth width) { width_ = width; }
  bool turning() const { return turning_; }
  bool readsSpin() const { return readsSpin_; }
  /// Somebody reads the sum of a grain's overlaps: it stands beside the torque (ParticleView::sumsOverlaps).
  void sumOverlaps() { sumsOverlaps_ = true; }
  bool sumsOverlaps() const { return sumsOverlaps_; }
  bool ownTorque() const { return ownTorque_; }         ///< Law::ownTorque of the tangential law
  bool fullRadiusArm() const { return fullRadiusArm_; } ///< Law::fullRadiusArm of any law
  bool hasEvents() const { return events_; }
  const std::vector<std::string>& quantityNames() const { return quantityNames_; }
  /// Quads written per pair: force; with friction, or for sums of overlaps, also a torque; with couples those
  /// too, but for a law with a torque of its own, which takes them in.
  int outputQuads() const { return readsSpin_ && !ownTorque_ ? 3 : turning_ || sumsOverlaps_ ? 2 : 1; }
  int outputStride() const { return (mixed_ ? 2 : 4) * outputQuads(); } ///< doubles a pair, ParticleView

  /// What can be had in mixed precision, as a sentence that the laws of the scene may follow.
  static constexpr const char* mixedRule =
      "precision = \"mixed\" works for grains of one material under a linear normal law, or grains of one "
      "size under a hertz law with a given restitution, alone or with a tangential spring, and no other "
      "laws between grains; use precision = \"double\" here";

private:
  void appendRole(LawRole role, const std::vector<const ContactSpec*>& specs);
  void append(std::shared_ptr<const Law> law, std::string name, LawRole role);

  std::vector<Entry> entries_;
  LawContext context_;
  std::vector<std::string> quantityNames_;
  std::vector<double> promisedInverseMass_; ///< [1/kg] by material; 0: none
  int materials_ = 0, history_ = 0;
  double stiffnessScale_ = 1.0;
  bool fastArithmetic_ = false, mixed_ = false;
  double range_ = 0.0;
  unsigned reads_ = 0;
  KernelWidth width_ = bestKernelWidth();
  bool turning_ = false, readsSpin_ = false, fullRadiusArm_ = false, events_ = false, ownTorque_ = false,
       sumsOverlaps_ = false;
};

} // namespace sandglass
