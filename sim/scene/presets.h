#pragma once
// Presets: one key at the top of a scene that fills in others. Keys that the scene gives stay as they are,
// but for the few that a preset says it replaces. The resolved scene has what was filled in, and no preset.

#include "sim/scene/document.h"

namespace sandglass {

/// Carries out what `preset` at the top of the document says; an unknown name is left for the reader to find.
///
/// rice2012: every defect of the program behind H. E. Rice, Simulation and Phases of Macroscopic Particles in
/// Vortex Flow (M.S. thesis, University of Mississippi, 2012), so that its published numbers come out.
/// docs/vortex.md lists them.
void applyPreset(Value& root);

} // namespace sandglass
