#include "sim/io/import/column_names.h"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <utility>

namespace sandglass {

namespace {

using Pair = std::pair<std::string_view, std::string_view>;

/// Whole names, in lower case.
constexpr Pair wholeNames[] = {
    // everybody
    {"id", "id"},
    {"particleid", "id"},
    {"particle_id", "id"},
    {"particle id", "id"},
    {"grain_id", "id"},
    {"particle identifier", "id"},
    {"tag", "id"},
    {"idx", "id"},
    {"type", "species"},
    {"species", "species"},
    {"element", "species"},
    {"particle type", "species"},
    {"atom_type", "species"},
    {"material", "species"},
    {"matid", "species"},
    {"material_id", "species"},
    {"materialid", "species"},
    {"speciesindex", "species"},
    {"mass", "mass"},
    {"radius", "radius"},
    {"r", "radius"},
    {"radii", "radius"},
    {"rad", "radius"},
    {"diameter", "diameter"},
    {"d", "diameter"},
    {"diam", "diameter"},
    {"time", "time"},
    {"step", "step"},
    {"timestep", "step"},
    {"frame", "step"},
    {"x", "x"},
    {"y", "y"},
    {"z", "z"},
    // LAMMPS and LIGGGHTS dumps
    {"xu", "x"},
    {"yu", "y"},
    {"zu", "z"},
    {"xs", "x_scaled"},
    {"ys", "y_scaled"},
    {"zs", "z_scaled"},
    {"xsu", "x_scaled"},
    {"ysu", "y_scaled"},
    {"zsu", "z_scaled"},
    {"vx", "velocity.x"},
    {"vy", "velocity.y"},
    {"vz", "velocity.z"},
    {"fx", "force.x"},
    {"fy", "force.y"},
    {"fz", "force.z"},
    {"tqx", "torque.x"},
    {"tqy", "torque.y"},
    {"tqz", "torque.z"},
    {"omegax", "spin.x"},
    {"omegay", "spin.y"},
    {"omegaz", "spin.z"},
    {"wx", "spin.x"},
    {"wy", "spin.y"},
    {"wz", "spin.z"},
    {"ix", ""},
    {"iy", ""},
    {"iz", ""},
    {"proc", ""}, // images and processors are no property of a grain
    {"quatw", "orientation.w"},
    {"quati", "orientation.x"},
    {"quatj", "orientation.y"},
    {"quatk", "orientation.z"},
    // LIGGGHTS writes the quaternion's real part first
    {"quat1", "orientation.w"},
    {"quat2", "orientation.x"},
    {"quat3", "orientation.y"},
    {"quat4", "orientation.z"},
    // What OVITO recognises of computes. Not c_orient: the names do not tell whether the real part is first.
    {"c_shape[1]", "shape.x"},
    {"c_shape[2]", "shape.y"},
    {"c_shape[3]", "shape.z"},
    {"c_diameter[1]", "shape_diameter.x"},
    {"c_diameter[2]", "shape_diameter.y"},
    {"c_diameter[3]", "shape_diameter.z"},
    {"shapex", "shape_unknown.x"},
    {"shapey", "shape_unknown.y"},
    {"shapez", "shape_unknown.z"},
    // roundness1, roundness2 are LIGGGHTS' old names of blockiness
    {"blockiness1", "blockiness1"},
    {"blockiness2", "blockiness2"},
    {"roundness1", "blockiness1"},
    {"roundness2", "blockiness2"},
    {"block1", "blockiness1"},
    {"block2", "blockiness2"},
};

/// Names of vectors, in lower case.
constexpr Pair vectorNames[] = {
    {"position", ""},
    {"pos", ""},
    {"positions", ""},
    {"coordinates", ""},
    {"points", ""},
    {"coord", ""},
    {"velocity", "velocity"},
    {"v", "velocity"},
    {"vel", "velocity"},
    {"velo", "velocity"},
    {"velocities", "velocity"},
    {"linear velocity", "velocity"},
    {"linvel", "velocity"},
    {"linvelvec", "velocity"},
    {"angvelvec", "spin"},
    {"forcevec", "force"},
    {"torquevec", "torque"},
    {"spin", "spin"},
    {"omega", "spin"},
    {"angular velocity", "spin"},
    {"angular_velocity", "spin"},
    {"angularvelocity", "spin"},
    {"angvel", "spin"},
    {"force", "force"},
    {"f", "force"},
    {"forces", "force"},
    {"torque", "torque"},
    {"torques", "torque"},
    {"orientation", "orientation"}, // with letters alone: numbers do not tell which part is the real one
    {"shape", "shape"},
    {"aspherical_shape", "shape"},
    {"aspherical shape", "shape"},
    {"shape_diameter", "shape_diameter"},
    {"superquadric_roundness", "e"},
    {"superquadric roundness", "e"},
};

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

template <class Table> const std::string_view* lookUp(const Table& table, std::string_view name) {
  for (const auto& [from, to] : table)
    if (from == name) return &to;
  return nullptr;
}

/// "velocity:0", "Velocity.X", "pos_x", "pos [2]" into the name and 0, 1, 2, 3; ParaView counts from 0, OVITO
/// names the fourth part W, LAMMPS counts from 1.
std::pair<std::string, int> split(const std::string& name) {
  const std::size_t n = name.size();
  const auto letter = [](char c) { // lower case: the name has been lowered
    const std::size_t at = std::string_view("xyzw").find(c);
    return at == std::string_view::npos ? -1 : static_cast<int>(at);
  };
  if (n > 2 && (name[n - 2] == ':' || name[n - 2] == '_' || name[n - 2] == '.' || name[n - 2] == ' ')) {
    const char last = name[n - 1];
    if (letter(last) >= 0) return {name.substr(0, n - 2), letter(last)};
    if (last >= '0' && last <= '3' && name[n - 2] != '.') return {name.substr(0, n - 2), last - '0'};
  }
  if (n > 3 && name[n - 1] == ']' && name[n - 3] == '[' && name[n - 2] >= '1' && name[n - 2] <= '4')
    return {name.substr(0, n - 3), name[n - 2] - '1'};
  return {name, -1};
}

} // namespace

std::string quantityOfColumn(const std::string& column, const ImportSettings& settings) {
  if (settings.ignores(column)) return "";
  for (const auto& [quantity, name] : settings.columns)
    if (name == column) return quantity;
  // A quantity that the settings take from another column is not taken from here as well.
  const auto free = [&](std::string quantity) {
    const auto given = settings.columns.find(quantity);
    return given != settings.columns.end() ? std::string() : quantity;
  };
  const std::string name = lower(column);
  if (const auto* found = lookUp(wholeNames, name)) return free(std::string(*found));
  const auto [base, part] = split(name);
  if (part >= 0)
    if (const auto* found = lookUp(vectorNames, base)) {
      if (*found == "e") return free(part == 0 ? "e1" : "e2");
      const bool lettered = std::string_view("xyzwXYZW").find(column.back()) != std::string_view::npos;
      if (*found == "orientation" ? !lettered : part == 3) return free(column);
      const std::string axis(1, "xyzw"[part]);
      return free(found->empty() ? axis : std::string(*found) + "." + axis);
    }
  // Any other triple: components under the name of the file, so that they become a vector.
  if (part >= 0 && part < 3) return free(column.substr(0, base.size()) + "." + "xyz"[part]);
  return free(column);
}

const std::vector<std::string>& importQuantities() {
  static const std::vector<std::string> all{"id",
                                            "species",
                                            "mass",
                                            "radius",
                                            "diameter",
                                            "time",
                                            "step",
                                            "x",
                                            "y",
                                            "z",
                                            "x_scaled",
                                            "y_scaled",
                                            "z_scaled",
                                            "velocity.x",
                                            "velocity.y",
                                            "velocity.z",
                                            "spin.x",
                                            "spin.y",
                                            "spin.z",
                                            "force.x",
                                            "force.y",
                                            "force.z",
                                            "torque.x",
                                            "torque.y",
                                            "torque.z",
                                            "orientation.w",
                                            "orientation.x",
                                            "orientation.y",
                                            "orientation.z",
                                            "shape.x",
                                            "shape.y",
                                            "shape.z",
                                            "shape_diameter.x",
                                            "shape_diameter.y",
                                            "shape_diameter.z",
                                            "e1",
                                            "e2",
                                            "blockiness1",
                                            "blockiness2"};
  return all;
}

} // namespace sandglass
