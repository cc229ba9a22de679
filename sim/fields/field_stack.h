#pragma once
// The fields of one scene, as the particle loop sees them: forces and torques added to the sums of a group of
// grains, and the work that they have done. A scene without fields has none of this.

#include "sim/fields/field.h"
#include "sim/fields/field_registry.h"
#include "sim/scene/scene.h"

#include <memory>
#include <string>
#include <vector>

namespace sandglass {

class FieldStack {
public:
  /// Throws InputError (a phrase) when a field contradicts itself or names another that is not there.
  explicit FieldStack(const Scene& scene);

  bool any() const { return !parts_.empty(); }
  bool readsOverlaps() const { return overlaps_; } ///< FieldBlock::overlap

  /// Strength of a field over what the scene says, from now on; 0 switches it off.
  void setFactor(const std::string& name, double factor);

  /// After each new neighbour list.
  void list(const GrainStore& grains, const PairList& pairs, Parallel& parallel);
  /// Before each evaluation.
  void look(const GrainStore& grains, const PairList& pairs, double time, Parallel& parallel);

  /// Adds to the sums of the grains in [first, last), which hold all contact forces. From several threads at
  /// once, for different groups. `count`: whether the step is really done, so that its work counts.
  void addTo(GroupSums sums, const GrainStore& grains, std::int64_t first, std::int64_t last, double dt,
             const Vec3& gravity, bool couples, bool count);

  /// [J] done on grains that are free, since the start.
  double work() const;

  // For checkpoints.
  std::vector<double> factors() const;
  void setFactors(const std::vector<double>& factors);
  std::vector<double> workState() const; ///< total of earlier lists, then of each group
  void setWorkState(const std::vector<double>& state);

private:
  struct Part {
    std::string name;
    FieldRole role;
    std::unique_ptr<Field> field;
    double factor = 1;
    std::vector<int> others; ///< of a drag: the flows that it feels, then its shields; indices into parts_
  };
  void resolve(const Scene& scene);
  void fill(FieldBlock& b, GroupSums sums, const GrainStore& grains, const Vec3& gravity, bool couples) const;
  void pass(FieldBlock& b) const;

  std::vector<Part> parts_;
  std::vector<int> order_; ///< lifts, drags, spins
  bool spins_ = false, overlaps_ = false;
  double time_ = 0;
  double worked_ = 0;             ///< [J] of groups of earlier lists
  std::vector<double> groupWork_; ///< [J] by group of grains
};

/// Largest sum of the speeds of a scene's flows [m/s], an estimate.
double fastestFlow(const Scene& scene);

} // namespace sandglass
