#pragma once
// One function per kind of field, each in its own file; field_registry.cpp lists them. Below them what
// several kinds share.

#include "sim/fields/field_registry.h"

namespace sandglass {

FieldKind solidBodyVortexField();
FieldKind rankineVortexField();
FieldKind lambOseenVortexField();
FieldKind windField();
FieldKind griddedWindField();
FieldKind shieldField();
FieldKind overlapLiftField();
FieldKind dragField();
FieldKind spinDragField();

/// Keys `point` and `axis` of a vortex.
ParameterSpec vortexPoint();
ParameterSpec vortexAxis();
/// The key `axis`, made a unit vector. Throws InputError for a zero vector.
Vec3 unitAxis(const Parameters& parameters);
/// Keys `decay` and `reference`: forces and winds that fall off exponentially with height.
ParameterSpec heightDecay(const char* what);
ParameterSpec heightReference();
/// A number that must be given, or with `fallback` may be left out.
ParameterSpec fieldNumber(const char* name, const char* unit, const char* description, double minimum,
                          bool openMinimum = false, std::optional<double> fallback = {});
ParameterSpec optionalNumber(const char* name, const char* unit, const char* description, double minimum,
                             bool openMinimum = false);

} // namespace sandglass
