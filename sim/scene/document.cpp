#include "sim/scene/document.h"

#include "sim/base/error.h"
#include "sim/scene/suggest.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <charconv>
#include <sstream>

namespace sandglass {

namespace {

Value convert(const toml::node& node) {
  Value value;
  value.place.line = static_cast<int>(node.source().begin.line);
  if (const auto* table = node.as_table()) {
    ValueTable entries;
    for (const auto& [key, child] : *table) {
      entries.push_back({std::string(key.str()), convert(child)});
      // A dotted or header table has no place of its own in every case; its key has.
      if (entries.back().value.place.line == 0)
        entries.back().value.place.line = static_cast<int>(key.source().begin.line);
    }
    std::stable_sort(entries.begin(), entries.end(),
                     [](const Entry& a, const Entry& b) { return a.value.place.line < b.value.place.line; });
    value.data = std::move(entries);
  } else if (const auto* array = node.as_array()) {
    ValueList list;
    for (const auto& child : *array)
      list.push_back(convert(child));
    value.data = std::move(list);
  } else if (const auto* text = node.as_string()) {
    value.data = text->get();
  } else if (const auto* whole = node.as_integer()) {
    value.data = whole->get();
  } else if (const auto* number = node.as_floating_point()) {
    value.data = number->get();
  } else if (const auto* flag = node.as_boolean()) {
    value.data = flag->get();
  } else {
    std::ostringstream out;
    node.visit([&out](const auto& n) { out << n; });
    value.data = ForeignValue{out.str()};
  }
  return value;
}

void markOverride(Value& value) {
  value.place = {0, true};
  if (auto* table = value.table())
    for (auto& entry : *table)
      markOverride(entry.value);
  if (auto* list = value.list())
    for (auto& element : *list)
      markOverride(element);
}

/// What stands right of "=": TOML where it is TOML, else plain text (so that --set a.b=3\ mm needs no
/// quotes).
Value overrideValue(const std::string& text) {
  Value value;
  try {
    const toml::table parsed = toml::parse("value = " + text);
    if (parsed.size() == 1)
      value = convert(*parsed.get("value"));
    else
      value.data = text;
  } catch (const toml::parse_error&) {
    value.data = text;
  }
  markOverride(value);
  return value;
}

std::vector<std::string> split(const std::string& path) {
  std::vector<std::string> keys(1);
  for (const char c : path)
    if (c == '.')
      keys.emplace_back();
    else
      keys.back() += c;
  return keys;
}

/// True when `name` calls this entry of a list of tables.
bool isCalled(const Value& entry, std::size_t index, const std::string& name) {
  if (name == entryName(entry, index) || name == std::to_string(index + 1)) return true;
  const Value* between = entry.find("between");
  if (!between || !between->list() || between->list()->size() != 2) return false;
  const auto* a = (*between->list())[0].text();
  const auto* b = (*between->list())[1].text();
  return a && b && name == *b + "-" + *a;
}

} // namespace

const Value* Value::find(std::string_view key) const {
  if (const auto* entries = table())
    for (const auto& entry : *entries)
      if (entry.key == key) return &entry.value;
  return nullptr;
}

Value* Value::find(std::string_view key) {
  return const_cast<Value*>(std::as_const(*this).find(key));
}

Value parseDocument(const std::string& text, const std::string& nameForMessages) {
  try {
    return convert(toml::parse(text, nameForMessages));
  } catch (const toml::parse_error& e) {
    throw InputError(fmt::format("{}:{}: the TOML is not well formed: {}", nameForMessages,
                                 e.source().begin.line, e.description()));
  }
}

std::string entryName(const Value& entry, std::size_t index) {
  if (const Value* name = entry.find("name"); name && name->text() && !name->text()->empty())
    return *name->text();
  if (const Value* between = entry.find("between");
      between && between->list() && between->list()->size() == 2) {
    const auto* a = (*between->list())[0].text();
    const auto* b = (*between->list())[1].text();
    if (a && b) return *a + "-" + *b;
  }
  return std::to_string(index + 1);
}

void applyOverride(Value& root, const std::string& assignment) {
  const auto equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0)
    throw InputError(fmt::format("--set {}: it must read key.path=value, for example seed=3", assignment));
  const auto keys = split(assignment.substr(0, equals));
  Value* at = &root;
  std::string walked;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    if (keys[k].empty()) throw InputError(fmt::format("--set {}: a key in the path is empty", assignment));
    Value* next = nullptr;
    if (auto* list = at->list()) {
      std::vector<std::string> names;
      for (std::size_t i = 0; i < list->size() && !next; ++i) {
        if (isCalled((*list)[i], i, keys[k])) next = &(*list)[i];
        names.push_back(entryName((*list)[i], i));
      }
      if (!next)
        throw InputError(fmt::format("--set {}: '{}' has no entry '{}'; {}", assignment, walked, keys[k],
                                     suggestion(keys[k], names, "there are")));
      if (k + 1 == keys.size()) *next = overrideValue(assignment.substr(equals + 1));
    } else if (at->table()) {
      next = at->find(keys[k]);
      if (!next) {
        Value fresh{{0, true}, ValueTable{}};
        at->table()->push_back({keys[k], std::move(fresh)});
        next = &at->table()->back().value;
      }
      if (k + 1 == keys.size()) *next = overrideValue(assignment.substr(equals + 1));
    } else {
      throw InputError(fmt::format("--set {}: '{}' is {}, not a table, so it has no key '{}'", assignment,
                                   walked, describe(*at), keys[k]));
    }
    at = next;
    walked += (walked.empty() ? "" : ".") + keys[k];
  }
}

std::string typeName(const Value& value) {
  static constexpr const char* names[] = {"true or false", "a whole number", "a number",      "text",
                                          "a list",        "a table",        "a date or time"};
  return names[value.data.index()];
}

std::string describe(const Value& value) {
  struct Printer {
    std::string operator()(bool b) const { return b ? "true" : "false"; }
    std::string operator()(std::int64_t i) const { return fmt::format("{}", i); }
    std::string operator()(double d) const { return fmt::format("{}", d); }
    std::string operator()(const std::string& s) const { return fmt::format("\"{}\"", s); }
    std::string operator()(const ForeignValue& f) const { return f.text; }
    std::string operator()(const ValueList& list) const {
      std::string all;
      for (const auto& v : list)
        all += (all.empty() ? "" : ", ") + describe(v);
      return "[" + all + "]";
    }
    std::string operator()(const ValueTable& table) const {
      std::string all;
      for (const auto& e : table)
        all += (all.empty() ? " " : ", ") + e.key + " = " + describe(e.value);
      return "{" + all + " }";
    }
  };
  std::string text = std::visit(Printer{}, value.data);
  std::size_t length = 60;
  if (text.size() <= length) return text;
  while ((static_cast<unsigned char>(text[length]) & 0xC0) == 0x80)
    --length; // do not cut a UTF-8 character
  return text.substr(0, length) + "…";
}

} // namespace sandglass
