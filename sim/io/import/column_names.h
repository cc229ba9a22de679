#pragma once
// What the columns of other programs' files mean: LAMMPS, LIGGGHTS, OVITO, ParaView, Yade and trackers give
// the same quantity different names.

#include "sim/io/import/import_settings.h"

#include <string>
#include <vector>

namespace sandglass {

/// Names of quantities that columns can become; a triple appears as its three components:
///   id  species  mass  radius  diameter  time  step
///   x y z (position)  x_scaled y_scaled z_scaled (0 to 1 across the box)
///   velocity.x  spin.x  force.x  torque.x ...      any other NAME.x NAME.y NAME.z: a vector of that name
///   orientation.w orientation.x orientation.y orientation.z (quaternion, from the grain's axes to the
///   file's) shape.x shape.y shape.z (semi-axes)   shape_diameter.x ... (whole axes)   shape_unknown.x ...
///   (either) e1 e2 (exponents, sim/frame/frame.h)    blockiness1 blockiness2 (2 / e1, 2 / e2)
/// A column that is none of them becomes a scalar of its own name. "" when the settings leave it out.
std::string quantityOfColumn(const std::string& column, const ImportSettings& settings);

/// The known quantities, for messages.
const std::vector<std::string>& importQuantities();

} // namespace sandglass
