#include "sim/fields/field_registry.h"

#include "sim/base/error.h"
#include "sim/fields/field.h"
#include "sim/fields/field_kinds.h"

namespace sandglass {

const std::vector<FieldKind>& fieldKinds() {
  static const std::vector<FieldKind> kinds{
      solidBodyVortexField(), rankineVortexField(), lambOseenVortexField(), windField(),
      griddedWindField(),     shieldField(),        overlapLiftField(),     dragField(),
      spinDragField(),
  };
  return kinds;
}

const FieldKind* findField(const std::string& name) {
  for (const FieldKind& kind : fieldKinds())
    if (kind.name == name) return &kind;
  return nullptr;
}

ParameterSpec vortexPoint() {
  return {.name = "point",
          .type = ParameterType::vector,
          .unit = "m",
          .description = "a point of its axis",
          .fallback = Vec3(Vec3::Zero())};
}

ParameterSpec vortexAxis() {
  return {.name = "axis",
          .type = ParameterType::vector,
          .unit = "1",
          .description = "direction of its axis; the fluid turns about it as a right-handed screw",
          .fallback = Vec3(Vec3::UnitZ())};
}

Vec3 unitAxis(const Parameters& parameters) {
  const Vec3& axis = parameters.vector("axis");
  if (!(axis.norm() > 0.0)) throw InputError("axis must not be zero; write for example [0, 0, 1]");
  return axis.normalized();
}

ParameterSpec heightDecay(const char* what) {
  return {.name = "decay",
          .type = ParameterType::number,
          .unit = "1/m",
          .description = what,
          .fallback = 0.0,
          .minimum = 0};
}

ParameterSpec heightReference() {
  return {.name = "reference",
          .type = ParameterType::number,
          .unit = "m",
          .description = "height at which that share is one",
          .fallback = 0.0};
}

ParameterSpec fieldNumber(const char* name, const char* unit, const char* description, double minimum,
                          bool openMinimum, std::optional<double> fallback) {
  ParameterSpec spec{.name = name,
                     .type = ParameterType::number,
                     .unit = unit,
                     .description = description,
                     .minimum = minimum,
                     .openMinimum = openMinimum};
  if (fallback) spec.fallback = *fallback;
  return spec;
}

ParameterSpec optionalNumber(const char* name, const char* unit, const char* description, double minimum,
                             bool openMinimum) {
  ParameterSpec spec = fieldNumber(name, unit, description, minimum, openMinimum);
  spec.optional = true;
  return spec;
}

} // namespace sandglass
