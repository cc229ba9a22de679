#include "sim/frame/frame.h"

#include "sim/base/error.h"

#include <fmt/format.h>

namespace sandglass {

namespace {

template <class Map> std::string names(const Map& map) {
  std::string list;
  for (const auto& [name, values] : map) list += (list.empty() ? "" : ", ") + name;
  return list.empty() ? "none" : list;
}

} // namespace

const std::vector<double>& Frame::scalar(const std::string& name) const {
  const auto it = scalars.find(name);
  if (it == scalars.end())
    throw InputError(fmt::format("the frame at {:.6g} s has no scalar '{}'; it has: {}", time, name, names(scalars)));
  return it->second;
}

const std::vector<Vec3>& Frame::vector(const std::string& name) const {
  const auto it = vectors.find(name);
  if (it == vectors.end())
    throw InputError(fmt::format("the frame at {:.6g} s has no vector '{}'; it has: {}", time, name, names(vectors)));
  return it->second;
}

std::vector<double> grainScalar(const Frame& frame, const std::string& expression) {
  std::vector<double> values(frame.size());
  const auto component = [&](const std::vector<Vec3>& v, int axis) {
    for (std::size_t i = 0; i < v.size(); ++i) values[i] = v[i][axis];
    return values;
  };
  const auto magnitude = [&](const std::vector<Vec3>& v) {
    for (std::size_t i = 0; i < v.size(); ++i) values[i] = v[i].norm();
    return values;
  };
  if (frame.scalars.contains(expression)) return frame.scalar(expression);
  if (expression == "x" || expression == "y" || expression == "z") return component(frame.position, expression[0] - 'x');
  if (expression == "id") {
    for (std::size_t i = 0; i < frame.size(); ++i) values[i] = static_cast<double>(frame.id[i]);
    return values;
  }
  if (expression == "speed") return magnitude(frame.vector(quantity::velocity));
  if (expression.size() > 2 && expression.front() == '|' && expression.back() == '|')
    return magnitude(frame.vector(expression.substr(1, expression.size() - 2)));
  if (expression.size() > 2 && expression[expression.size() - 2] == '.') {
    const char axis = expression.back();
    if (axis >= 'x' && axis <= 'z') return component(frame.vector(expression.substr(0, expression.size() - 2)), axis - 'x');
  }
  std::string known;
  for (const auto& name : grainScalarNames(frame)) known += (known.empty() ? "" : ", ") + name;
  throw InputError(fmt::format("there is no quantity '{}' in the frame at {:.6g} s; there are: {}", expression, frame.time, known));
}

std::vector<std::string> grainScalarNames(const Frame& frame) {
  std::vector<std::string> all;
  if (frame.vectors.contains(quantity::velocity)) all.emplace_back("speed");
  for (const auto& [name, values] : frame.scalars) all.push_back(name);
  for (const char* axis : {"x", "y", "z"}) all.emplace_back(axis);
  all.emplace_back("id");
  for (const auto& [name, values] : frame.vectors) {
    all.push_back("|" + name + "|");
    for (const char* axis : {".x", ".y", ".z"}) all.push_back(name + axis);
  }
  return all;
}

std::string unitOf(const std::string& expression) {
  static const std::map<std::string, std::string> units{
      {"x", "m"}, {"y", "m"}, {"z", "m"}, {"speed", "m/s"}, {quantity::radius, "m"}, {quantity::mass, "kg"},
      {quantity::velocity, "m/s"}, {quantity::spin, "rad/s"}, {quantity::force, "N"}, {quantity::residenceTime, "s"}};
  std::string base = expression;
  if (base.size() > 2 && base.front() == '|' && base.back() == '|') base = base.substr(1, base.size() - 2);
  else if (base.size() > 2 && base[base.size() - 2] == '.') base = base.substr(0, base.size() - 2);
  const auto it = units.find(base);
  return it == units.end() ? "" : it->second;
}

} // namespace sandglass
