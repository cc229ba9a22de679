#pragma once
// Reads one table of a scene by a list of ParameterSpec: types, dimensions, ranges, unknown and missing keys.

#include "sim/scene/document.h"
#include "sim/scene/fault_list.h"
#include "sim/scene/parameters.h"
#include "sim/scene/scene.h"
#include "sim/scene/suggest.h"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <vector>

namespace sandglass {

class TableReader {
public:
  /// `path` names the table in messages ("" for the root, "species.bead").
  TableReader(const ValueTable& table, std::string path, FaultList& faults)
      : table_(table), path_(std::move(path)), faults_(faults) {}

  /// Reads every key of `specs`; what is wrong is reported and left out of the result.
  void read(const std::vector<ParameterSpec>& specs, Parameters& values);

  /// A table below this one: null when absent or not a table (then reported).
  const ValueTable* subtable(const std::string& key);
  /// A list of tables below this one, with the path of each (by its name, else by its position); empty when
  /// absent.
  std::vector<std::pair<const ValueTable*, std::string>> subtables(const std::string& key, bool named = true);
  /// Marks a key as known and gives its value, or null.
  const Value* take(const std::string& key);

  /// The kind chosen by `selector` ("kind", "law") among `kinds` and its parameters from the same table.
  template <class Kind>
  const Kind* choose(const std::string& selector, const std::vector<Kind>& kinds, Choice& choice);

  /// Reports keys that nobody asked for. To be called last.
  void reportUnknown();

  std::string pathOf(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }
  const std::string& path() const { return path_; }
  FaultList& faults() { return faults_; }

private:
  const ValueTable& table_;
  std::string path_;
  FaultList& faults_;
  std::vector<std::string> known_;
  bool judgeUnknown_ = true;
};

/// One value by its spec; reports and returns nothing when it is wrong.
std::optional<ParameterValue> readValue(const Value& value, const ParameterSpec& spec, const std::string& key,
                                        FaultList& faults);

template <class Kind>
const Kind* TableReader::choose(const std::string& selector, const std::vector<Kind>& kinds, Choice& choice) {
  std::vector<std::string> names;
  for (const auto& kind : kinds)
    names.push_back(kind.name);
  Parameters chosen;
  read({{.name = selector,
         .type = ParameterType::text,
         .unit = "1",
         .description = "one of " + joined(names),
         .choices = names}},
       chosen);
  if (!chosen.has(selector)) {
    judgeUnknown_ = false; // which keys are right depends on the kind
    return nullptr;
  }
  choice.kind = chosen.text(selector);
  for (const auto& kind : kinds)
    if (kind.name == choice.kind) {
      read(kind.parameters, choice.parameters);
      return &kind;
    }
  return nullptr;
}

} // namespace sandglass
