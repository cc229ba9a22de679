#include "sim/scene/scene_reference.h"

#include "sim/contact/law_registry.h"
#include "sim/fields/field_registry.h"
#include "sim/grains/fill_registry.h"
#include "sim/grains/size_distribution.h"
#include "sim/scene/probe_registry.h"
#include "sim/scene/scene_sections.h"
#include "sim/scene/scene_writer.h"
#include "sim/scene/suggest.h"
#include "sim/scene/units.h"
#include "sim/walls/wall_motion.h"
#include "sim/walls/wall_registry.h"

#include <fmt/format.h>

#include <cmath>

namespace sandglass {

namespace {

std::string typeText(const ParameterSpec& spec) {
  const std::string unit = spec.unit.empty() ? "1" : spec.unit;
  const std::string one = dimensionName(unit).substr(dimensionName(unit).find(' ') + 1);
  switch (spec.type) {
  case ParameterType::number:
    return one;
  case ParameterType::integer:
    return "whole number";
  case ParameterType::boolean:
    return "true or false";
  case ParameterType::text:
    return spec.choices.empty() ? "text" : "one of " + joined(spec.choices);
  case ParameterType::vector:
    return "three of: " + one;
  case ParameterType::numbers:
    return "list of: " + one;
  case ParameterType::vectors:
    return "list of threes of: " + one;
  case ParameterType::texts:
    return spec.choices.empty() ? "list of texts" : "list of " + joined(spec.choices);
  }
  return "";
}

/// Limits beyond 1e15 stand for "any".
std::string rangeText(const ParameterSpec& spec) {
  if (spec.type == ParameterType::text || spec.type == ParameterType::texts) return "";
  const std::string unit = spec.unit.empty() ? "1" : spec.unit;
  const bool low = std::abs(spec.minimum) < 1e15, high = std::abs(spec.maximum) < 1e15;
  std::string text;
  if (low) text = (spec.openMinimum ? "above " : "from ") + quantityText(spec.minimum, unit);
  if (high) text += (low ? " to " : "up to ") + quantityText(spec.maximum, unit);
  return text;
}

std::string defaultText(const ParameterSpec& spec) {
  if (spec.fallback) return "`" + valueText(*spec.fallback, spec.unit) + "`";
  return spec.optional ? "may be left out" : "**due**";
}

std::string table(const Keys& keys) {
  if (keys.empty()) return "No further keys.\n\n";
  std::string text = "| key | meaning | value | range | default |\n|---|---|---|---|---|\n";
  for (const auto& key : keys)
    text += fmt::format("| `{}` | {} | {} | {} | {} |\n", key.name, key.description, typeText(key),
                        rangeText(key), defaultText(key));
  return text + "\n";
}

template <class Kinds> std::string kinds(const Kinds& all, const std::string& selector) {
  std::string text;
  for (const auto& kind : all)
    text += fmt::format("### `{} = \"{}\"`: {}\n\n{}", selector, kind.name, kind.description,
                        table(kind.parameters));
  return text;
}

std::string laws(LawRole role, const std::string& key) {
  std::string text = fmt::format("### `{}`\n\n", key);
  bool any = false;
  for (const auto& law : lawKinds())
    if (law.role == role) {
      any = true;
      text += fmt::format(
          "`law = \"{}\"`: {}{}\n\n{}", law.name, law.description,
          law.needsElasticity ? " (needs `youngs_modulus` and `poisson_ratio` of both materials)" : "",
          table(law.parameters));
    }
  return any ? text : "";
}

} // namespace

std::string sceneReference() {
  std::string text = "# The keys of a scene\n\n"
                     "Made by `sandglass explain --keys`. Quantities are texts with a unit (`\"3 mm\"`, "
                     "`\"45 deg\"`); a bare number "
                     "stands for a plain number, and for zero.\n"
                     "Keys that are marked **due** must be given.\n\n";
  text += "## The top of the file\n\n" + table(sceneKeys());
  text += "## `[domain]`: the space\n\n" + table(domainKeys());
  text +=
      "## `[wedge]`: a sector instead of the whole circle\n\nFor scenes that look the same after a turn "
      "by the angle about a vertical axis: only the grains of one sector are\nsimulated, those that cross "
      "a face come back through the other one, and contacts reach across. Rates, masses and\nforces are "
      "those of the sector. Walls must be their own images under the turn. docs/wedge.md says more.\n\n" +
      table(wedgeKeys());
  text += "## `[[material]]`\n\n" + table(materialKeys());
  text += "## `[[contact]]`: how two materials touch\n\nOne for each two materials that can meet. Each law "
          "is a table: "
          "`normal = { law = \"linear\", … }`; a law left out is `none`.\nPairs of materials may "
          "use different kinds; docs/laws.md has the formulas and says when to use which.\n\n" +
          table(contactKeys()) + laws(LawRole::normal, "normal") + laws(LawRole::tangential, "tangential") +
          laws(LawRole::rolling, "rolling") + laws(LawRole::torsion, "torsion") + laws(LawRole::gap, "gap");
  text += "## `[[species]]`: grains of one sort\n\n" + table(speciesKeys()) +
          "and `size = { distribution = \"…\", … }`:\n\n" + kinds(sizeKinds(), "distribution");
  text += "## `[[wall]]`\n\n" + table(wallKeys()) + kinds(wallKinds(), "kind") +
          "A wall that moves has `motion = { kind = \"…\", … }` besides; its shape is described where it is "
          "when its motion begins.\n\n";
  text += kinds(motionKinds(), "motion.kind");
  text +=
      "## `[[field]]`: what acts on grains beside contacts and gravity\n\nFlows say how a fluid moves, drags "
      "draw grains along with it, shields weaken drags; docs/vortex.md has the formulas.\n\n" +
      table(fieldKeys()) + kinds(fieldKinds(), "kind");
  text +=
      "## `[[outlet]]`: a plane beyond which grains leave the run\n\n" + table(outletKeys()) +
      "and, if wanted, `recycle = { … }`: grains that pass are put back over what lies in a box, at random "
      "places, "
      "each as low\nas its own diameter is free above it; they wait until there is such a place. Each keeps "
      "its id and counts its lives.\n\n" +
      table(recycleKeys());
  text += "## `[[fill]]`: where grains come from\n\nGrains are named by `species`, or by `mixture = [{ "
          "species = \"…\", fraction "
          "= 0.3 }, …]`.\n\n" +
          table(fillKeys()) + kinds(fillKinds(), "kind") +
          "A list has either `grains = [{ position = […], velocity = […], spin = […], species = \"…\", "
          "diameter = \"…\" }, …]`, "
          "of which\nonly `position` is due where the species has a single size, or `csv = \"FILE\"`: "
          "comma-separated, with the "
          "headings\n`x[mm],y[mm],z[mm]` and, if wanted, `vx[m/s]`…, `wx[rad/s]`…, `diameter[mm]`, "
          "`species`, in any unit of the "
          "dimension.\n\n";
  text += "## `[[stage]]`: what happens in turn\n\n" + table(stageKeys()) +
          "and `until = { … }`: the stage ends at the first condition met, and must have one.\n\n" +
          table(untilKeys());
  text +=
      "## `[[event]]`: what somebody changed while the run went on\n\nThe desktop adds these to the scene of "
      "the run, in the order of their steps; running that scene again gives the same bits.\n\n" +
      table(eventKeys());
  text += "## `[[probe]]`: what goes into series.csv\n\n" + table(probeKeys()) + kinds(probeKinds(), "kind");
  text += "## `[output]`\n\n" + table(outputKeys());
  text += "## `[accuracy]`: speed against error\n\nThe levels `draft`, `standard` and `reference` take 15, "
          "25 and 50 steps per "
          "contact.\n\n" +
          table(accuracyKeys());
  text += "## Changing a scene from the command line\n\n`--set key.path=value` replaces one value and is "
          "checked like the file: "
          "`--set seed=3`, `--set species.bead.size.diameter=\"2 mm\"`,\n`--set wall.bin.outlet=\"3 cm\"`. "
          "Tables of a list go by "
          "their name, contacts by their materials (`contact.glass-wall.tangential.friction=0.3`),\nany by "
          "its place from 1 "
          "(`fill.1.number=500`).\n";
  return text;
}

} // namespace sandglass
