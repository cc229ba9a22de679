// The keys of [output] and [accuracy].
#include "sim/scene/scene_sections.h"

namespace sandglass {

using enum ParameterType;

const Keys& outputKeys() {
  static const Keys keys{
      {.name = "frame_interval",
       .type = number,
       .unit = "s",
       .description = "between frames; 0: first and last only",
       .fallback = 0.0,
       .minimum = 0},
      {.name = "checkpoint_interval",
       .type = number,
       .unit = "s",
       .description = "between checkpoints; 0: 20 in a run",
       .fallback = 0.0,
       .minimum = 0},
      {.name = "quantities",
       .type = texts,
       .unit = "1",
       .description = "what frames carry beside positions and radii",
       .fallback = std::vector<std::string>{"velocity"},
       .choices = {"radius", "mass", "species", "velocity", "spin", "force", "residence_time", "life"}},
      {.name = "contacts",
       .type = boolean,
       .unit = "1",
       .description = "whether frames carry the contacts",
       .fallback = false},
      {.name = "positions",
       .type = text,
       .unit = "1",
       .description = "precision of positions in frames",
       .fallback = std::string("double"),
       .choices = {"double", "single"}}};
  return keys;
}

const Keys& accuracyKeys() {
  static const Keys keys{
      {.name = "level",
       .type = text,
       .unit = "1",
       .description = "fills in the knobs that are not given",
       .fallback = std::string("standard"),
       .choices = {"draft", "standard", "reference"}},
      {.name = "steps_per_contact",
       .type = number,
       .unit = "1",
       .description = "steps in the shortest collision",
       .optional = true,
       .minimum = 6,
       .maximum = 10000},
      {.name = "time_step",
       .type = number,
       .unit = "s",
       .description = "step, when the scene fixes it",
       .optional = true,
       .minimum = 0,
       .openMinimum = true},
      {.name = "stiffness_scale",
       .type = number,
       .unit = "1",
       .description = "stiffness of all contacts over what the laws say; steps grow as one "
                      "over its root, overlaps as one over it",
       .fallback = 1.0,
       .minimum = 1e-6,
       .maximum = 1e6},
      {.name = "precision",
       .type = text,
       .unit = "1",
       .description = "mixed: pairs in single precision, overlaps to 1e-9 of a diameter; sums and motion in "
                      "double; for common laws alone",
       .fallback = std::string("double"),
       .choices = {"double", "mixed"}},
      {.name = "arithmetic",
       .type = text,
       .unit = "1",
       .description = "portable: the same bits on every processor; fast: roots and quotients of "
                      "common laws to two units in the last place, where AVX-512 is there",
       .fallback = std::string("portable"),
       .choices = {"portable", "fast"}},
      {.name = "integrator",
       .type = text,
       .unit = "1",
       .description = "leapfrog, of second order; or semi_implicit, the same steps begun with "
                      "velocities of the full step, of first order",
       .fallback = std::string("leapfrog"),
       .choices = {"leapfrog", "semi_implicit"}},
      {.name = "skin",
       .type = number,
       .unit = "1",
       .description = "of neighbour lists, as a share of the mean diameter of the finest species",
       .fallback = 0.02,
       .minimum = 0,
       .maximum = 2,
       .openMinimum = true},
      {.name = "maximum_overlap",
       .type = number,
       .unit = "1",
       .description =
           "share of the smaller radius at which a run stops; at walls other than planes 0.9 at most, beyond "
           "which a grain would pass through",
       .fallback = 0.5,
       .minimum = 0,
       .maximum = 3,
       .openMinimum = true},
      {.name = "maximum_travel",
       .type = number,
       .unit = "1",
       .description = "share of the smallest radius that a grain may go in a step; a run stops "
                      "where one goes further",
       .fallback = 0.25,
       .minimum = 0,
       .maximum = 1,
       .openMinimum = true}};
  return keys;
}

} // namespace sandglass
