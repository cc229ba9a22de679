#pragma once
// Strict reading of one TOML table: every fault becomes a sentence with file, line, key, value and rule, and
// the field keeps its default, so that all faults of a file are found in one go.

#include "sim/base/vec.h"

#include <toml++/toml.h>

#include <array>
#include <limits>
#include <set>
#include <string>
#include <vector>

namespace sandglass::vis {

class TomlFields {
public:
  /// `prefix` stands before keys in messages ("camera."); `faults` grows.
  TomlFields(const toml::table& table, std::string file, std::string prefix, std::vector<std::string>& faults)
      : table_(table), file_(std::move(file)), prefix_(std::move(prefix)), faults_(faults) {}

  void boolean(const std::string& key, bool& value);
  void integer(const std::string& key, int& value, int low, int high);
  void number(const std::string& key, double& value, double low = -std::numeric_limits<double>::max(),
              double high = std::numeric_limits<double>::max());
  void wholeNumbers(const std::string& key, std::vector<std::int64_t>& value);       ///< [3, 17, 29]
  void counts(const std::string& key, std::array<int, 3>& value, int low, int high); ///< [1, 0, 2]
  void text(const std::string& key, std::string& value);
  void choice(const std::string& key, std::string& value, const std::vector<std::string>& choices);
  void length(const std::string& key, double& value); ///< above 0; metres, or a text such as "2 cm"
  void point(const std::string& key, Vec3& value);    ///< [x, y, z] of such lengths
  void vector(const std::string& key, Vec3& value);   ///< [x, y, z] of plain numbers
  void colour(const std::string& key, std::array<double, 3>& value); ///< [red, green, blue], 0 to 1 each

  const toml::table* table(const std::string& key);               ///< null when absent
  std::vector<const toml::table*> tables(const std::string& key); ///< [[key]]

  /// "file:line: prefix.key <complaint>."
  void fault(const std::string& key, const std::string& complaint);

  /// Every key that was not asked for is a fault. Call last.
  void refuseOthers();

private:
  const toml::node* find(const std::string& key);
  bool three(const std::string& key, std::array<double, 3>& value, const char* meaning, bool lengths = false);

  const toml::table& table_;
  std::string file_, prefix_;
  std::vector<std::string>& faults_;
  std::set<std::string> known_;
};

} // namespace sandglass::vis
