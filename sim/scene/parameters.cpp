#include "sim/scene/parameters.h"

#include "sim/base/error.h"

#include <fmt/format.h>

namespace sandglass {

namespace {

template <class T> const T& as(const std::map<std::string, ParameterValue>& values, const std::string& name) {
  const auto it = values.find(name);
  if (it == values.end()) throw InputError(fmt::format("the parameter '{}' is missing", name));
  const T* value = std::get_if<T>(&it->second);
  if (!value)
    throw InputError(fmt::format("the parameter '{}' has a value of another type than is due", name));
  return *value;
}

} // namespace

double Parameters::number(const std::string& name) const {
  const auto it = values_.find(name);
  if (it != values_.end())
    if (const auto* whole = std::get_if<std::int64_t>(&it->second)) return static_cast<double>(*whole);
  return as<double>(values_, name);
}

double Parameters::number(const std::string& name, double otherwise) const {
  return has(name) ? number(name) : otherwise;
}

std::int64_t Parameters::integer(const std::string& name) const {
  return as<std::int64_t>(values_, name);
}
bool Parameters::boolean(const std::string& name) const {
  return as<bool>(values_, name);
}
const std::string& Parameters::text(const std::string& name) const {
  return as<std::string>(values_, name);
}
const Vec3& Parameters::vector(const std::string& name) const {
  return as<Vec3>(values_, name);
}

const std::vector<double>& Parameters::numbers(const std::string& name) const {
  return as<std::vector<double>>(values_, name);
}

const std::vector<Vec3>& Parameters::vectors(const std::string& name) const {
  return as<std::vector<Vec3>>(values_, name);
}

const std::vector<std::string>& Parameters::texts(const std::string& name) const {
  return as<std::vector<std::string>>(values_, name);
}

} // namespace sandglass
