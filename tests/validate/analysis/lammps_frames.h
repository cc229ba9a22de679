#pragma once
// The same frame through LAMMPS' computes and through ours.

#include "tests/validate/verdicts.h"

namespace sandglass::validate {

/// g(r) (compute rdf), q4 and q6 of each grain (compute orientorder/atom) and the volumes of Voronoi cells
/// (compute voronoi/atom, which is voro++). Recorded as skipped where `lmp` is not installed.
void lammpsFrames(Report& report);

} // namespace sandglass::validate
