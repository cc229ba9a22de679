#include "sim/grains/fill_registry.h"

namespace sandglass {

namespace {

using enum ParameterType;

const ParameterSpec velocity{.name = "velocity",
                             .type = vector,
                             .unit = "m/s",
                             .description = "mean velocity",
                             .fallback = Vec3(Vec3::Zero()),
                             .minimum = -1e6,
                             .maximum = 1e6};
const ParameterSpec velocitySpread{.name = "velocity_spread",
                                   .type = vector,
                                   .unit = "m/s",
                                   .description =
                                       "velocities are drawn evenly within this of the mean, axis by axis",
                                   .fallback = Vec3(Vec3::Zero()),
                                   .minimum = 0,
                                   .maximum = 1e6};
const ParameterSpec spinSpread{.name = "spin_spread",
                               .type = number,
                               .unit = "rad/s",
                               .description = "spins are drawn evenly within this of zero, axis by axis",
                               .fallback = 0.0,
                               .minimum = 0,
                               .maximum = 1e9};

ParameterSpec point(std::string name, std::string description, bool optional) {
  return {.name = std::move(name),
          .type = vector,
          .unit = "m",
          .description = std::move(description),
          .optional = optional};
}

ParameterSpec length(std::string name, std::string description) {
  return {.name = std::move(name),
          .type = number,
          .unit = "m",
          .description = std::move(description),
          .optional = true,
          .minimum = 0,
          .openMinimum = true};
}

const std::vector<ParameterSpec> randomParameters{
    {.name = "region",
     .type = text,
     .unit = "1",
     .description =
         "shape of the space to fill; grains lie inside it as a whole. interior: all of the domain that is "
         "not "
         "behind a wall; walls touched from both sides and places beyond an open end are not in its way",
     .fallback = std::string("interior"),
     .choices = {"interior", "box", "cylinder"}},
    point("lower", "lower corner of a box", true),
    point("upper", "upper corner of a box", true),
    point("base", "centre of a cylinder's base", true),
    {.name = "axis", .type = vector, .unit = "1", .description = "direction of a cylinder", .optional = true},
    length("radius", "radius of a cylinder"),
    length("height", "height of a cylinder"),
    {.name = "number",
     .type = integer,
     .unit = "1",
     .description = "how many grains",
     .optional = true,
     .minimum = 1},
    {.name = "mass",
     .type = number,
     .unit = "kg",
     .description = "total mass of the grains",
     .optional = true,
     .minimum = 0,
     .openMinimum = true},
    {.name = "solid_fraction",
     .type = number,
     .unit = "1",
     .description = "share of the open space that grains fill",
     .optional = true,
     .minimum = 0,
     .maximum = 0.74,
     .openMinimum = true},
    {.name = "tries",
     .type = integer,
     .unit = "1",
     .description = "places that are tried in a row for one grain before giving up",
     .fallback = std::int64_t{100'000},
     .minimum = 1,
     .maximum = 1e9},
    {.name = "restarts",
     .type = integer,
     .unit = "1",
     .description = "how often the filling then begins anew with other places",
     .fallback = std::int64_t{0},
     .minimum = 0,
     .maximum = 1000},
    velocity,
    velocitySpread,
    spinSpread};

const std::vector<ParameterSpec> rainParameters{
    point("lower", "lower corner of the box in which grains appear", false),
    point("upper", "its upper corner", false),
    {.name = "rate",
     .type = number,
     .unit = "1/s",
     .description = "grains per time",
     .optional = true,
     .minimum = 0,
     .openMinimum = true},
    {.name = "mass_rate",
     .type = number,
     .unit = "kg/s",
     .description = "mass per time",
     .optional = true,
     .minimum = 0,
     .openMinimum = true},
    {.name = "number",
     .type = integer,
     .unit = "1",
     .description = "how many grains in all; without, it rains as long as the stage lasts",
     .optional = true,
     .minimum = 1},
    velocity,
    velocitySpread,
    spinSpread};

const std::vector<ParameterSpec> latticeParameters{
    {.name = "structure",
     .type = text,
     .unit = "1",
     .description = "simple cubic, face-centred cubic or hexagonal close-packed",
     .choices = {"sc", "fcc", "hcp"}},
    {.name = "spacing",
     .type = number,
     .unit = "m",
     .description = "distance between nearest centres",
     .minimum = 0,
     .openMinimum = true},
    point("lower", "first centre", false),
    point("upper", "centres lie below this along each axis", false),
    {.name = "jitter",
     .type = number,
     .unit = "m",
     .description = "centres are moved evenly within this, axis by axis",
     .fallback = 0.0,
     .minimum = 0},
    velocity,
    velocitySpread,
    spinSpread};

} // namespace

const std::vector<FillKind>& fillKinds() {
  static const std::vector<FillKind> kinds{
      {"random", "at random without overlap", randomParameters},
      {"rain", "appearing at random in a box, at a rate, while the stage runs", rainParameters},
      {"lattice", "on the points of a lattice", latticeParameters},
      {"list", "one by one, as written in the scene or a CSV file", {}},
  };
  return kinds;
}

} // namespace sandglass
