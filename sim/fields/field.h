#pragma once
// One field of a scene, evaluated group by group of grains inside the particle loop. What it needs of other
// grains it looks up before the loop moves any.

#include "sim/base/parallel.h"
#include "sim/contact/pair_list.h"
#include "sim/fields/field_block.h"
#include "sim/frame/frame.h"
#include "sim/grains/grain_store.h"

namespace sandglass {

class Field {
public:
  virtual ~Field() = default;

  /// Whether list() and look() do anything.
  virtual bool looks() const { return false; }
  /// After the neighbour list has been made anew. Until the next call no grain moves further from where it is
  /// now than its `listed.w`.
  virtual void list(const GrainStore&, const PairList&, Parallel&) {}
  /// Before each evaluation, with all grains where they are now.
  virtual void look(const GrainStore&, const PairList&, Parallel&) {}

  /// Acts on a group. `factor` is the field's strength now over what the scene says (docs/vortex.md tells
  /// what it multiplies); never 0.
  virtual void apply(FieldBlock& block, double factor) const = 0;

  /// Whether it reads FieldBlock::overlap.
  virtual bool readsOverlaps() const { return false; }

  /// Largest speed that a flow has in the domain at the start, or an estimate [m/s]; for the time step.
  virtual double topSpeed(const Domain&) const { return 0.0; }
};

} // namespace sandglass
