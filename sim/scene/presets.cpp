#include "sim/scene/presets.h"

namespace sandglass {

namespace {

using Data = decltype(Value::data);

/// `key = value` for each table of a section whose `selector` has the value `kind`.
struct Rule {
  const char *section, *below; ///< table, and the table inside it if any
  const char *selector, *kind; ///< null: every table
  const char* key;
  Data value;
  const char* instead = nullptr; ///< replaces this text too
};

const std::vector<Rule>& rice2012() {
  const auto text = [](const char* t) { return Data(std::string(t)); };
  static const std::vector<Rule> rules{
      {"material", nullptr, nullptr, nullptr, "mass_share", Data(0.75)}, // 4/3 was an integer division
      {"contact", "normal", "law", "rice", "radius", text("doubled")},
      {"contact", "normal", "law", "rice", "overlap_rate", text("difference")},
      {"contact", "tangential", "law", "rice", "slip", text("spin")},
      {"wall", nullptr, "kind", "cylinder", "normal", text("over_distance")},
      {"field", nullptr, "kind", "drag", "speed", text("componentwise")},
      {"field", nullptr, "kind", "drag", "acts", text("all"), "across"}, // the stirring drag slows z as well
      {"field", nullptr, "kind", "spin_drag", "update", text("explicit")},
      {"field", nullptr, "kind", "overlap_lift", "coefficient", text("10 N/m")},
  };
  return rules;
}

void apply(const Rule& rule, Value& entry) {
  Value* table = rule.below ? entry.find(rule.below) : &entry;
  if (!table || !table->table()) return;
  if (rule.selector) {
    const Value* kind = table->find(rule.selector);
    if (!kind || !kind->text() || *kind->text() != rule.kind) return;
  }
  if (Value* there = table->find(rule.key)) {
    if (rule.instead && there->text() && *there->text() == rule.instead) there->data = rule.value;
    return;
  }
  table->table()->push_back({rule.key, Value{table->place, rule.value}});
}

} // namespace

void applyPreset(Value& root) {
  const Value* preset = root.find("preset");
  if (!preset || !preset->text() || *preset->text() != "rice2012" || !root.table()) return;
  for (const Rule& rule : rice2012())
    if (Value* section = root.find(rule.section))
      if (auto* list = std::get_if<ValueList>(&section->data))
        for (Value& entry : *list)
          apply(rule, entry);
  if (!root.find("accuracy")) root.table()->push_back({"accuracy", Value{{}, ValueTable{}}});
  if (Value* accuracy = root.find("accuracy"); accuracy->table() && !accuracy->find("integrator"))
    accuracy->table()->push_back({"integrator", Value{accuracy->place, std::string("semi_implicit")}});
}

} // namespace sandglass
