#include "sim/scene/from_file.h"

#include "sim/base/error.h"

#include <fmt/format.h>

namespace sandglass {

ParameterSpec fileScale() {
  return {.name = "scale",
          .type = ParameterType::number,
          .unit = "m",
          .description = "length of one unit of the file",
          .optional = true,
          .minimum = 0,
          .maximum = 1e6,
          .openMinimum = true};
}

ParameterSpec fileShift() {
  return {.name = "shift",
          .type = ParameterType::vector,
          .unit = "m",
          .description = "added to all points of the file",
          .optional = true};
}

double scaleOf(const Parameters& parameters, const char* example) {
  if (!parameters.has("scale"))
    throw InputError(fmt::format(
        "it lacks the key 'scale', the length of one unit of the file, such as scale = \"{}\"", example));
  return parameters.number("scale");
}

Vec3 shiftOf(const Parameters& parameters) {
  return parameters.has("shift") ? parameters.vector("shift") : Vec3(Vec3::Zero());
}

} // namespace sandglass
