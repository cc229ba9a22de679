#include "vis/toml_fields.h"

#include "sim/base/error.h"
#include "sim/scene/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

namespace sandglass::vis {

namespace {

std::string shown(const toml::node& node) {
  std::ostringstream text;
  node.visit([&](const auto& value) { text << value; });
  return text.str();
}

/// A finite number, or where `lengths` are due also a text with a unit.
std::optional<double> finite(const toml::node& node, bool lengths) {
  std::optional<double> v = node.is_number() ? node.value<double>() : std::nullopt;
  if (const auto text = node.value_exact<std::string>(); lengths && text) try {
      v = parseQuantity(*text, "m");
    } catch (const InputError&) {
      return std::nullopt; // the caller's sentence tells the rule
    }
  if (v && !std::isfinite(*v)) return std::nullopt;
  return v;
}

} // namespace

const toml::node* TomlFields::find(const std::string& key) {
  known_.insert(key);
  return table_.get(key);
}

void TomlFields::fault(const std::string& key, const std::string& complaint) {
  const toml::node* node = table_.get(key);
  const auto line = node ? node->source().begin.line : table_.source().begin.line;
  faults_.push_back(fmt::format("{}:{}: {}{} {}.", file_, line, prefix_, key, complaint));
}

void TomlFields::boolean(const std::string& key, bool& value) {
  const toml::node* node = find(key);
  if (!node) return;
  if (const auto v = node->value_exact<bool>())
    value = *v;
  else
    fault(key, fmt::format("is {}; it must be true or false", shown(*node)));
}

void TomlFields::integer(const std::string& key, int& value, int low, int high) {
  const toml::node* node = find(key);
  if (!node) return;
  const auto v = node->value_exact<std::int64_t>();
  if (v && *v >= low && *v <= high)
    value = static_cast<int>(*v);
  else
    fault(key, fmt::format("is {}; it must be a whole number from {} to {}", shown(*node), low, high));
}

void TomlFields::wholeNumbers(const std::string& key, std::vector<std::int64_t>& value) {
  const toml::node* node = find(key);
  if (!node) return;
  const toml::array* list = node->as_array();
  std::vector<std::int64_t> read;
  bool good = list != nullptr;
  for (std::size_t k = 0; good && k < list->size(); ++k) {
    const auto v = list->get(k)->value_exact<std::int64_t>();
    good = v.has_value();
    if (good) read.push_back(*v);
  }
  if (good)
    value = std::move(read);
  else
    fault(key, fmt::format("is {}; it must be a list of whole numbers, such as [3, 17]", shown(*node)));
}

void TomlFields::counts(const std::string& key, std::array<int, 3>& value, int low, int high) {
  const toml::node* node = find(key);
  if (!node) return;
  const toml::array* list = node->as_array();
  std::array<int, 3> read{};
  bool good = list && list->size() == 3;
  for (std::size_t k = 0; good && k < 3; ++k) {
    const auto v = list->get(k)->value_exact<std::int64_t>();
    good = v && *v >= low && *v <= high;
    if (good) read[k] = static_cast<int>(*v);
  }
  if (good)
    value = read;
  else
    fault(key, fmt::format("is {}; it must be three whole numbers from {} to {}, [x, y, z]", shown(*node),
                           low, high));
}

void TomlFields::number(const std::string& key, double& value, double low, double high) {
  const toml::node* node = find(key);
  if (!node) return;
  const auto v = node->is_number() ? node->value<double>() : std::nullopt;
  if (v && std::isfinite(*v) && *v >= low && *v <= high)
    value = *v;
  else if (high < std::numeric_limits<double>::max())
    fault(key, fmt::format("is {}; it must be a number from {:g} to {:g}", shown(*node), low, high));
  else if (low > -std::numeric_limits<double>::max())
    fault(key, fmt::format("is {}; it must be a number of at least {:g}", shown(*node), low));
  else
    fault(key, fmt::format("is {}; it must be a finite number", shown(*node)));
}

void TomlFields::text(const std::string& key, std::string& value) {
  const toml::node* node = find(key);
  if (!node) return;
  if (const auto v = node->value_exact<std::string>())
    value = *v;
  else
    fault(key, fmt::format("is {}; it must be a text in quotes", shown(*node)));
}

void TomlFields::choice(const std::string& key, std::string& value, const std::vector<std::string>& choices) {
  const toml::node* node = find(key);
  if (!node) return;
  const auto v = node->value_exact<std::string>();
  if (v && std::find(choices.begin(), choices.end(), *v) != choices.end())
    value = *v;
  else
    fault(key, fmt::format("is {}; it must be one of: \"{}\"", shown(*node), fmt::join(choices, "\", \"")));
}

bool TomlFields::three(const std::string& key, std::array<double, 3>& value, const char* meaning,
                       bool lengths) {
  const toml::node* node = find(key);
  if (!node) return false;
  const toml::array* list = node->as_array();
  std::array<double, 3> read{};
  bool good = list && list->size() == 3;
  for (std::size_t k = 0; good && k < 3; ++k) {
    const auto v = finite(*list->get(k), lengths);
    good = v.has_value();
    if (good) read[k] = *v;
  }
  if (!good)
    fault(key, fmt::format("is {}; it must be {}", shown(*node), meaning));
  else
    value = read;
  return good;
}

void TomlFields::length(const std::string& key, double& value) {
  const toml::node* node = find(key);
  if (!node) return;
  const auto v = finite(*node, true);
  if (v && *v > 0)
    value = *v;
  else
    fault(key,
          fmt::format("is {}; it must be a length above 0, in metres or such as \"2 cm\"", shown(*node)));
}

void TomlFields::point(const std::string& key, Vec3& value) {
  std::array<double, 3> read{};
  if (three(key, read, "three lengths, [x, y, z], in metres or such as \"2 cm\"", true))
    value = Vec3(read[0], read[1], read[2]);
}

void TomlFields::vector(const std::string& key, Vec3& value) {
  std::array<double, 3> read{};
  if (three(key, read, "three finite numbers, [x, y, z]")) value = Vec3(read[0], read[1], read[2]);
}

void TomlFields::colour(const std::string& key, std::array<double, 3>& value) {
  std::array<double, 3> read{};
  const char* meaning = "three numbers from 0 to 1, [red, green, blue]";
  if (!three(key, read, meaning)) return;
  if (std::all_of(read.begin(), read.end(), [](double c) { return c >= 0 && c <= 1; }))
    value = read;
  else
    fault(key, fmt::format("is {}; it must be {}", shown(*table_.get(key)), meaning));
}

const toml::table* TomlFields::table(const std::string& key) {
  const toml::node* node = find(key);
  if (!node) return nullptr;
  if (!node->is_table())
    fault(key, fmt::format("is {}; it must be a table, [{}{}]", shown(*node), prefix_, key));
  return node->as_table();
}

std::vector<const toml::table*> TomlFields::tables(const std::string& key) {
  std::vector<const toml::table*> result;
  const toml::node* node = find(key);
  if (!node) return result;
  const toml::array* list = node->as_array();
  bool good = list != nullptr;
  for (std::size_t k = 0; good && k < list->size(); ++k) {
    good = list->get(k)->is_table();
    if (good) result.push_back(list->get(k)->as_table());
  }
  if (!good)
    fault(key, fmt::format("is {}; it must be a list of tables, [[{}{}]]", shown(*node), prefix_, key));
  return result;
}

void TomlFields::refuseOthers() {
  for (const auto& [key, node] : table_)
    if (!known_.contains(std::string(key.str())))
      fault(std::string(key.str()),
            fmt::format("is not a known key; known are: {}", fmt::join(known_, ", ")));
}

} // namespace sandglass::vis
