#pragma once

namespace sandglass {

/// Optional columns of a block; those that no law of a scene reads are left out.
struct LawColumns {
  enum : unsigned { radii = 1, masses = 2, effectiveRadius = 4, effectiveMass = 8 };
};

} // namespace sandglass
