#pragma once
// Fonts and inks of everything written into pictures and charts.

#include <vtkTextProperty.h>

#include <array>
#include <string>

namespace sandglass::vis {

/// Sets the sans-serif font of the program (DejaVu Sans where it is installed, VTK's own otherwise).
void setFont(vtkTextProperty* text, int size, bool bold = false);

/// Black on light ground, near-white on dark ground; `strength` 1 is full ink, 0 is the ground.
std::array<double, 3> inkOn(const std::array<double, 3>& background, double strength = 0.85);

} // namespace sandglass::vis
