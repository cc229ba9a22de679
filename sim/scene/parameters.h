#pragma once
// Checked parameters of anything that a scene names by kind: walls, laws, fillings, probes, fields.
// A kind describes its parameters once (ParameterSpec); reading, checking, `explain` and the reference page
// all follow from that description.

#include "sim/base/vec.h"

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace sandglass {

/// A value in SI units. Lists of points come as vector<Vec3>.
using ParameterValue = std::variant<double, std::int64_t, bool, std::string, Vec3, std::vector<double>,
                                    std::vector<Vec3>, std::vector<std::string>>;

enum class ParameterType { number, integer, boolean, text, vector, numbers, vectors, texts };

/// What a scene may write for one parameter.
struct ParameterSpec {
  std::string name; ///< key in the scene, snake_case
  ParameterType type = ParameterType::number;
  std::string unit;        ///< SI unit that fixes the dimension ("m", "N/m", "1" for a plain number)
  std::string description; ///< one phrase, for explain and the reference page
  std::optional<ParameterValue> fallback{}; ///< absent: the scene must give it (unless `optional`)
  bool optional = false;                    ///< may be left out without a fallback
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
  bool openMinimum = false;           ///< minimum itself is not allowed ("must be above 0")
  std::vector<std::string> choices{}; ///< for text: the only values allowed
};

/// Values after checking; getters assume the spec was obeyed.
class Parameters {
public:
  bool has(const std::string& name) const { return values_.contains(name); }
  double number(const std::string& name) const; ///< integer or number
  double number(const std::string& name, double otherwise) const;
  std::int64_t integer(const std::string& name) const;
  bool boolean(const std::string& name) const;
  const std::string& text(const std::string& name) const;
  const Vec3& vector(const std::string& name) const;
  const std::vector<double>& numbers(const std::string& name) const;
  const std::vector<Vec3>& vectors(const std::string& name) const;
  const std::vector<std::string>& texts(const std::string& name) const;
  void set(const std::string& name, ParameterValue value) { values_[name] = std::move(value); }
  const std::map<std::string, ParameterValue>& all() const { return values_; }
  bool operator==(const Parameters&) const = default;

private:
  std::map<std::string, ParameterValue> values_;
};

} // namespace sandglass
