#pragma once
// A block of contacts at walls, with what no law sees of them. Its loops run over columns, as those of the
// laws do.

#include "sim/contact/contact_block.h"

#include <cstdint>
#include <vector>

namespace sandglass {

struct WallBlock {
  using Column = ContactBlock::Column;
  static constexpr int capacity = ContactBlock::capacity;

  WallBlock();

  ContactBlock contact;
  alignas(64) Column distance;    ///< from the centre to the wall point [m]
  std::int32_t owner[capacity];   ///< whose contact it is
  std::int32_t feature[capacity]; ///< of the wall
  std::int8_t slot[capacity];     ///< which of its owner's contacts

  // What finishForces() makes: overlap as a share of the radius, by contact, and one row for each owner that
  // has contacts: sum of force and torque on the grain, each with a zero behind.
  alignas(64) Column share;
  int rows = 0;
  std::int32_t ownerOfRow[capacity];
  alignas(64) double row[capacity][8];

  /// Owners that now have other contacts than in the step before.
  struct Change {
    std::int32_t owner;
    int first, count; ///< contacts in the block
    int begun;        ///< of them
  };
  std::vector<Change> changes;
  std::int32_t crowded = -1; ///< an owner that touches its wall in more places than there are slots; -1: none

  /// From velocities (in v_t) and spins of the grains, relative to the wall's velocity there, to relative
  /// motion at the contacts; and the columns that follow from radii and masses. `radiusArm`: slip is that of
  /// the full radius.
  void finishMotion(bool turning, bool radiusArm);
  /// From what the laws wrote. `ownTorque`: couples are all that turns the grains.
  void finishForces(bool ownTorque, bool radiusArm);

  /// Greatest share of overlap, of contacts in the block or of earlier ones.
  double greatestShare() const;
};

} // namespace sandglass
