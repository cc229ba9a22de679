#pragma once
// Pairs across the faces of a wedge, found from the few grains near them: their images on the other side are
// sorted along the axis, one size class after the other, and each grain looks along that line as far as it
// reaches.

#include "sim/contact/sector_contacts.h"

namespace sandglass {

/// All pairs (a, image of b) nearer than radii + range + `listed.w` of both, ordered by a, b and turn. Each
/// once: a has the smaller id; a grain and its own image with at most half a turn.
std::vector<SectorContacts::Contact> searchAcross(const GrainStore& grains, double range,
                                                  const Sector& sector);

} // namespace sandglass
