// The keys of the fixed tables but [output] and [accuracy]: names, dimensions, ranges, defaults.
#include "sim/scene/scene_sections.h"

namespace sandglass {

namespace {

using enum ParameterType;

const ParameterSpec name{
    .name = "name", .type = text, .unit = "1", .description = "by which the rest of the scene calls it"};
const ParameterSpec materialName{
    .name = "material", .type = text, .unit = "1", .description = "name of a [[material]]"};

const ParameterSpec fieldNames{.name = "fields",
                               .type = texts,
                               .unit = "1",
                               .description =
                                   "fields whose strength changes now, in the order of field_factors",
                               .fallback = std::vector<std::string>{}};
const ParameterSpec fieldFactors{
    .name = "field_factors",
    .type = numbers,
    .unit = "1",
    .description = "strengths of these fields from now on over what their tables say; 0: off",
    .fallback = std::vector<double>{},
    .minimum = -1e6,
    .maximum = 1e6};

ParameterSpec positive(const char* key, const char* unit, const char* description) {
  return {.name = key,
          .type = number,
          .unit = unit,
          .description = description,
          .optional = true,
          .minimum = 0,
          .openMinimum = true};
}

} // namespace

const Keys& sceneKeys() {
  static const Keys keys{
      {.name = "title", .type = text, .unit = "1", .description = "one line", .fallback = std::string()},
      {.name = "description",
       .type = text,
       .unit = "1",
       .description = "any length",
       .fallback = std::string()},
      {.name = "preset",
       .type = text,
       .unit = "1",
       .description = "fills in keys that are left out: rice2012 has the defects of a program of that year, "
                      "docs/vortex.md; the resolved scene has what was filled in, and no preset",
       .optional = true,
       .choices = {"rice2012"}},
      {.name = "seed",
       .type = integer,
       .unit = "1",
       .description = "of all random numbers",
       .fallback = std::int64_t{1},
       .minimum = 0},
      {.name = "solver",
       .type = text,
       .unit = "1",
       .description = "method",
       .fallback = std::string("dem"),
       .choices = {"dem"}},
      {.name = "gravity",
       .type = vector,
       .unit = "m/s^2",
       .description = "acceleration of all grains",
       .fallback = Vec3(0, 0, -9.81),
       .minimum = -1e6,
       .maximum = 1e6}};
  return keys;
}

const Keys& domainKeys() {
  static const Keys keys{
      {.name = "lower", .type = vector, .unit = "m", .description = "lower corner of the space"},
      {.name = "upper", .type = vector, .unit = "m", .description = "upper corner of the space"},
      {.name = "periodic",
       .type = texts,
       .unit = "1",
       .description = "periodic directions",
       .fallback = std::vector<std::string>{},
       .choices = {"x", "y", "z"}}};
  return keys;
}

const Keys& wedgeKeys() {
  static const Keys keys{{.name = "angle",
                          .type = number,
                          .unit = "rad",
                          .description = "between its faces; a full circle must be a whole number of it",
                          .minimum = 0.01,
                          .maximum = 3.2},
                         {.name = "axis",
                          .type = text,
                          .unit = "1",
                          .description =
                              "through the origin; the wedge lies at azimuths from 0, the direction "
                              "of the next axis, to its angle",
                          .fallback = std::string("z"),
                          .choices = {"x", "y", "z"}}};
  return keys;
}

const Keys& materialKeys() {
  static const Keys keys{name,
                         positive("density", "kg/m^3", "of the solid; walls need none"),
                         {.name = "mass_share",
                          .type = number,
                          .unit = "1",
                          .description = "factor of the density, for programs that lost a part of the mass",
                          .optional = true,
                          .minimum = 0,
                          .maximum = 1,
                          .openMinimum = true},
                         positive("youngs_modulus", "Pa", "needed by Hertzian laws"),
                         {.name = "poisson_ratio",
                          .type = number,
                          .unit = "1",
                          .description = "needed by Hertzian laws",
                          .optional = true,
                          .minimum = -1,
                          .maximum = 0.5,
                          .openMinimum = true}};
  return keys;
}

const Keys& contactKeys() {
  static const Keys keys{{.name = "between", .type = texts, .unit = "1", .description = "the two materials"}};
  return keys;
}

const Keys& speciesKeys() {
  static const Keys keys{name,
                         materialName,
                         {.name = "frozen",
                          .type = boolean,
                          .unit = "1",
                          .description = "whether its grains keep the velocity and spin that their filling "
                                         "gives them, whatever pushes them, as a rough wall does",
                          .optional = true}};
  return keys;
}

const Keys& wallKeys() {
  static const Keys keys{name, materialName};
  return keys;
}

const Keys& fieldKeys() {
  static const Keys keys{name};
  return keys;
}

const Keys& outletKeys() {
  static const Keys keys{
      name,
      {.name = "point", .type = vector, .unit = "m", .description = "a point of the plane"},
      {.name = "normal", .type = vector, .unit = "1", .description = "points to where grains are taken out"},
      {.name = "record",
       .type = boolean,
       .unit = "1",
       .description = "whether each grain that passes gets a row in discharged.csv",
       .optional = true}};
  return keys;
}

const Keys& recycleKeys() {
  static const Keys keys{
      {.name = "lower", .type = vector, .unit = "m", .description = "lower corner of the box"},
      {.name = "upper", .type = vector, .unit = "m", .description = "upper corner of the box"},
      {.name = "velocity",
       .type = vector,
       .unit = "m/s",
       .description = "with which they begin",
       .fallback = Vec3(Vec3::Zero())}};
  return keys;
}

const Keys& fillKeys() {
  static const Keys keys{{.name = "stage",
                          .type = text,
                          .unit = "1",
                          .description = "name of the stage in which it happens (the first)",
                          .optional = true},
                         {.name = "species",
                          .type = text,
                          .unit = "1",
                          .description = "name of a [[species]]",
                          .optional = true},
                         {.name = "by",
                          .type = text,
                          .unit = "1",
                          .description = "whether the mixture's fractions are of number or mass",
                          .fallback = std::string("number"),
                          .choices = {"number", "mass"}}};
  return keys;
}

const Keys& shareKeys() {
  static const Keys keys{
      {.name = "species", .type = text, .unit = "1", .description = "name of a [[species]]"},
      {.name = "fraction",
       .type = number,
       .unit = "1",
       .description = "its share",
       .minimum = 0,
       .maximum = 1}};
  return keys;
}

const Keys& stageKeys() {
  static const Keys keys{name,
                         {.name = "remove_walls",
                          .type = texts,
                          .unit = "1",
                          .description = "walls that vanish as it begins",
                          .fallback = std::vector<std::string>{}},
                         fieldNames,
                         fieldFactors,
                         positive("drag", "1/s",
                                  "rate at which velocities and spins decay while it lasts, to settle a bed "
                                  "sooner")};
  return keys;
}

const Keys& untilKeys() {
  static const Keys keys{
      positive("duration", "s", "time from the start of the stage"),
      positive("settled", "J", "mean kinetic energy of a grain below which the bed is at rest"),
      positive("settled_speed", "m/s",
               "speed of the fastest grain below which the bed is at rest; with 'settled' both must hold"),
      {.name = "settled_after",
       .type = number,
       .unit = "s",
       .description = "earliest time at which 'settled' and 'settled_speed' count",
       .fallback = 0.0,
       .minimum = 0},
      {.name = "empty", .type = boolean, .unit = "1", .description = "no grain is left", .fallback = false},
      positive("mass_discharged", "kg", "mass that has left through outlets"),
      positive("quiet", "s", "time without any grain leaving"),
      positive("recirculations", "1",
               "grains put back by outlets, as a multiple of the number of grains at the start of the stage "
               "or now, "
               "whichever is larger")};
  return keys;
}

const Keys& eventKeys() {
  static const Keys keys{{.name = "step",
                          .type = integer,
                          .unit = "1",
                          .description = "step of the run before which it happens",
                          .minimum = 0},
                         {.name = "gravity",
                          .type = vector,
                          .unit = "m/s^2",
                          .description = "acceleration of all grains from now on",
                          .optional = true,
                          .minimum = -1e6,
                          .maximum = 1e6},
                         {.name = "drag",
                          .type = number,
                          .unit = "1/s",
                          .description = "rate at which velocities and spins decay until the next stage",
                          .optional = true,
                          .minimum = 0},
                         {.name = "remove_walls",
                          .type = texts,
                          .unit = "1",
                          .description = "walls that vanish",
                          .fallback = std::vector<std::string>{}},
                         fieldNames,
                         fieldFactors,
                         {.name = "pace_walls",
                          .type = texts,
                          .unit = "1",
                          .description = "walls whose motion goes at another pace from now on",
                          .fallback = std::vector<std::string>{}},
                         {.name = "pace",
                          .type = number,
                          .unit = "1",
                          .description = "that pace, as a multiple of the motion in [[wall]]; 0 holds them",
                          .optional = true,
                          .minimum = 0,
                          .maximum = 100},
                         {.name = "end_stage",
                          .type = boolean,
                          .unit = "1",
                          .description = "the stage ends after this step",
                          .fallback = false}};
  return keys;
}

const Keys& probeKeys() {
  static const Keys keys{name,
                         {.name = "interval",
                          .type = number,
                          .unit = "s",
                          .description = "between samples",
                          .minimum = 0,
                          .openMinimum = true}};
  return keys;
}

} // namespace sandglass
