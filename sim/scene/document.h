#pragma once
// A TOML file as a tree in which every value knows where it was written. The reader of scenes works on this
// tree, so that overrides from the command line and the file itself pass the same checks.

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace sandglass {

/// Where a value was written.
struct Place {
  int line = 0;           ///< 1-based; 0: unknown
  bool override_ = false; ///< given on the command line by --set
};

struct Entry;
struct Value;
using ValueList = std::vector<Value>;
using ValueTable = std::vector<Entry>; ///< in the order of the file

/// Something TOML knows and scenes never use (dates and times), as text.
struct ForeignValue {
  std::string text;
};

struct Value {
  Place place;
  std::variant<bool, std::int64_t, double, std::string, ValueList, ValueTable, ForeignValue> data;

  const ValueTable* table() const { return std::get_if<ValueTable>(&data); }
  ValueTable* table() { return std::get_if<ValueTable>(&data); }
  const ValueList* list() const { return std::get_if<ValueList>(&data); }
  ValueList* list() { return std::get_if<ValueList>(&data); }
  const std::string* text() const { return std::get_if<std::string>(&data); }
  /// The entry of a table, or null.
  const Value* find(std::string_view key) const;
  Value* find(std::string_view key);
};

struct Entry {
  std::string key;
  Value value;
};

/// Throws InputError ("FILE:LINE: ...") on a fault of syntax.
Value parseDocument(const std::string& text, const std::string& nameForMessages);

/// Applies one "key.path=value" of --set: tables are opened as needed; entries of lists of tables go by their
/// name, a contact by "first-second", any by its position from 1. Throws InputError with a sentence.
void applyOverride(Value& root, const std::string& assignment);

/// How the entry of a list of tables is called in messages and overrides: its name, else its position from 1.
std::string entryName(const Value& entry, std::size_t index);

/// The value as a scene would write it, cut to a readable length.
std::string describe(const Value& value);

/// "text", "a whole number", "a list", ...
std::string typeName(const Value& value);

} // namespace sandglass
