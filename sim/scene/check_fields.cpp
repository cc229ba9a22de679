#include "sim/scene/check_fields.h"

#include "sim/fields/field_registry.h"
#include "sim/scene/check_parts.h"
#include "sim/scene/suggest.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace sandglass {

namespace {

std::vector<std::string> namesOf(const Scene& scene) {
  std::vector<std::string> names;
  for (const FieldSpec& field : scene.fields)
    names.push_back(field.name);
  return names;
}

/// Names under `key` must be those of fields with that role.
void checkReferences(const Scene& scene, const FieldSpec& field, const std::string& path, const char* key,
                     FieldRole role, const char* what, FaultList& faults) {
  if (!field.what.parameters.has(key)) return;
  std::vector<std::string> names;
  for (const FieldSpec& other : scene.fields)
    if (const FieldKind* kind = findField(other.what.kind); kind && kind->role == role)
      names.push_back(other.name);
  for (const auto& name : field.what.parameters.texts(key))
    if (std::find(names.begin(), names.end(), name) == names.end())
      faults.wrong(path + "." + key, fmt::format("but the scene has no {} '{}' among its fields; {}", what,
                                                 name, suggestion(name, names, "there are")));
}

void checkFactors(const Scene& scene, const std::vector<FieldFactor>& factors, const std::string& path,
                  FaultList& faults) {
  const std::vector<std::string> names = namesOf(scene);
  std::set<std::string> seen;
  for (const FieldFactor& f : factors) {
    if (f.field.empty() || std::isnan(f.factor)) { // what one of the two lists has more
      faults.about(path, "has not as many field_factors as fields; give one for each");
      return;
    }
    if (std::find(names.begin(), names.end(), f.field) == names.end())
      faults.wrong(path + ".fields", fmt::format("but the scene has no [[field]] '{}'; {}", f.field,
                                                 suggestion(f.field, names, "there are")));
    if (!seen.insert(f.field).second)
      faults.wrong(path + ".fields", fmt::format("but '{}' stands there twice; give it once", f.field));
  }
}

} // namespace

void checkFields(const Scene& scene, FaultList& faults) {
  for (std::size_t i = 0; i < scene.fields.size(); ++i) {
    const FieldSpec& field = scene.fields[i];
    const std::string path = partPath("field", field.name, i);
    if (faults.has(path)) continue;
    checkReferences(scene, field, path, "flows", FieldRole::flow, "flow", faults);
    checkReferences(scene, field, path, "of", FieldRole::drag, "drag", faults);
    const FieldKind* kind = findField(field.what.kind);
    if (kind && kind->objection)
      if (const std::string why = kind->objection(field.what.parameters, scene.domain); !why.empty())
        faults.about(path, why);
    if (kind && kind->role == FieldRole::shield && (scene.domain.periodic[0] || scene.domain.periodic[1]))
      faults.about(path,
                   "counts grains below each other, which has no end where the domain is periodic along "
                   "x or y; close those sides or leave the shield out");
  }
  if (scene.wedge && !scene.fields.empty())
    faults.about("wedge", "cannot go with [[field]] tables: fields do not know images across its faces; "
                          "simulate the whole circle");
  for (std::size_t i = 0; i < scene.stages.size(); ++i)
    checkFactors(scene, scene.stages[i].fields, partPath("stage", scene.stages[i].name, i), faults);
  for (std::size_t i = 0; i < scene.events.size(); ++i)
    checkFactors(scene, scene.events[i].fields, partPath("event", "", i), faults);
}

} // namespace sandglass
