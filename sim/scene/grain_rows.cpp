#include "sim/scene/grain_rows.h"

#include "sim/base/error.h"
#include "sim/scene/units.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

namespace sandglass {

namespace {

struct Row {
  std::string species;
  std::optional<double> diameter;
  Vec3 position = Vec3::Zero(), velocity = Vec3::Zero(), spin = Vec3::Zero();
};

constexpr double mostSpeed = 1e6, mostSpin = 1e9; ///< [m/s], [rad/s]; their squares must be numbers

const std::vector<ParameterSpec>& rowKeys() {
  using enum ParameterType;
  static const std::vector<ParameterSpec> keys{
      {.name = "position", .type = vector, .unit = "m", .description = "centre"},
      {.name = "velocity",
       .type = vector,
       .unit = "m/s",
       .description = "velocity",
       .fallback = Vec3(Vec3::Zero()),
       .minimum = -mostSpeed,
       .maximum = mostSpeed},
      {.name = "spin",
       .type = vector,
       .unit = "rad/s",
       .description = "angular velocity",
       .fallback = Vec3(Vec3::Zero()),
       .minimum = -mostSpin,
       .maximum = mostSpin},
      {.name = "species",
       .type = text,
       .unit = "1",
       .description = "name of a [[species]]",
       .optional = true},
      {.name = "diameter",
       .type = number,
       .unit = "m",
       .description = "diameter",
       .optional = true,
       .minimum = 0,
       .openMinimum = true}};
  return keys;
}

/// Fills in species and diameter of a row; throws InputError with a phrase about the row.
void complete(Row& row, const std::vector<Species>& species) {
  std::vector<std::string> names;
  for (const auto& s : species)
    names.push_back(s.name);
  if (row.species.empty()) {
    if (species.size() != 1)
      throw InputError("lacks its species, and the scene has several: " + joined(names));
    row.species = species.front().name;
  }
  const auto it = std::find(names.begin(), names.end(), row.species);
  if (it == names.end())
    throw InputError(fmt::format("names the species '{}', which the scene does not have; {}", row.species,
                                 suggestion(row.species, names, "there are")));
  const Choice& size = species[static_cast<std::size_t>(it - names.begin())].size;
  if (!row.diameter && size.kind == "single" && size.parameters.has("diameter"))
    row.diameter = size.parameters.number("diameter");
  const bool sizeIsFaulty = size.kind.empty() || size.kind == "single"; // reported where it stands
  if (!row.diameter && sizeIsFaulty) row.diameter = 1.0;
  if (!row.diameter)
    throw InputError(fmt::format("lacks its diameter, and species '{}' has more than one size", row.species));
}

std::vector<Row> inlineRows(TableReader& in, const std::vector<Species>& species) {
  std::vector<Row> rows;
  for (const auto& [table, path] : in.subtables("grains", false)) {
    TableReader rowIn(*table, path, in.faults());
    Parameters values;
    rowIn.read(rowKeys(), values);
    rowIn.reportUnknown();
    if (in.faults().has(path)) continue;
    Row row{.species = values.has("species") ? values.text("species") : "",
            .diameter = {},
            .position = values.vector("position"),
            .velocity = values.vector("velocity"),
            .spin = values.vector("spin")};
    if (values.has("diameter")) row.diameter = values.number("diameter");
    try {
      complete(row, species);
      rows.push_back(row);
    } catch (const InputError& problem) {
      in.faults().about(path, problem.what());
    }
  }
  return rows;
}

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> all(1);
  for (const char c : line)
    if (c == ',')
      all.emplace_back();
    else if (c != '\r')
      all.back() += c;
  for (auto& cell : all) {
    const auto first = cell.find_first_not_of(" \t");
    cell = first == std::string::npos ? "" : cell.substr(first, cell.find_last_not_of(" \t") - first + 1);
  }
  return all;
}

/// One column: where its numbers go and the factor to SI.
struct Column {
  std::string name, unit;
};

constexpr std::array<std::pair<const char*, const char*>, 11> columnUnits{{{"x", "m"},
                                                                           {"y", "m"},
                                                                           {"z", "m"},
                                                                           {"vx", "m/s"},
                                                                           {"vy", "m/s"},
                                                                           {"vz", "m/s"},
                                                                           {"wx", "rad/s"},
                                                                           {"wy", "rad/s"},
                                                                           {"wz", "rad/s"},
                                                                           {"diameter", "m"},
                                                                           {"species", ""}}};

/// "x[mm]" -> x, mm; throws InputError with a phrase about the heading.
Column parseHeading(const std::string& heading) {
  const auto open = heading.find('[');
  Column column{heading.substr(0, open), ""};
  std::vector<std::string> names;
  for (const auto& [name, unit] : columnUnits) {
    names.emplace_back(name);
    if (column.name != name) continue;
    if (column.name == "species") return column;
    if (open == std::string::npos || heading.back() != ']')
      throw InputError(
          fmt::format("the heading '{0}' lacks its unit; write for example {0}[{1}]", heading, unit));
    column.unit = heading.substr(open + 1, heading.size() - open - 2);
    try {
      parseQuantity("1 " + column.unit, unit);
    } catch (const InputError& problem) {
      throw InputError(fmt::format("the heading '{}' is {}", heading, problem.what()));
    }
    return column;
  }
  throw InputError(
      fmt::format("there is no column '{}'; {}", column.name, suggestion(column.name, names, "there are")));
}

void assign(Row& row, const Column& column, const std::string& cell) {
  if (column.name == "species") {
    row.species = cell;
    return;
  }
  const auto known = std::find_if(columnUnits.begin(), columnUnits.end(),
                                  [&](const auto& c) { return column.name == c.first; });
  if (column.name == "diameter" && cell.empty()) return; // as the species says
  double value = 0;
  try {
    value = parseQuantity(cell + " " + column.unit, known->second);
  } catch (const InputError& problem) {
    throw InputError(fmt::format("{} is \"{}\", {}", column.name, cell, problem.what()));
  }
  const auto at = known - columnUnits.begin();
  const double most = at < 3 || at >= 9 ? std::numeric_limits<double>::infinity()
                      : at < 6          ? mostSpeed
                                        : mostSpin;
  if (std::abs(value) > most)
    throw InputError(fmt::format("{} is \"{}\", but must lie between -{:g} and {:g} {}", column.name, cell,
                                 most, most, known->second));
  if (at < 3)
    row.position[at] = value;
  else if (at < 6)
    row.velocity[at - 3] = value;
  else if (at < 9)
    row.spin[at - 6] = value;
  else {
    if (value <= 0) throw InputError(fmt::format("diameter is \"{}\", but must be above 0", cell));
    row.diameter = value;
  }
}

std::vector<Row> csvRows(const std::string& file, const std::vector<Species>& species, const std::string& key,
                         FaultList& faults) {
  std::ifstream in(file);
  std::vector<Row> rows;
  std::vector<Column> columns;
  std::string line;
  constexpr int mostFaults = 20; // a file in the wrong form would fill the screen
  int found = 0;
  for (int number = 1; std::getline(in, line) && found < mostFaults; ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos || line.front() == '#') continue;
    try {
      const auto parts = cells(line);
      if (columns.empty()) {
        std::vector<Column> headings;
        for (const auto& heading : parts) {
          Column column = parseHeading(heading);
          if (std::any_of(headings.begin(), headings.end(),
                          [&](const Column& c) { return c.name == column.name; }))
            throw InputError(fmt::format("there are two columns '{}'; remove one", column.name));
          headings.push_back(std::move(column));
        }
        for (const char* axis : {"x", "y", "z"})
          if (std::none_of(headings.begin(), headings.end(), [&](const Column& c) { return c.name == axis; }))
            throw InputError(fmt::format("the column '{}' is missing", axis));
        columns = std::move(headings);
        continue;
      }
      if (parts.size() != columns.size())
        throw InputError(
            fmt::format("there are {} values, but the heading has {} columns", parts.size(), columns.size()));
      Row row;
      for (std::size_t c = 0; c < parts.size(); ++c)
        assign(row, columns[c], parts[c]);
      try {
        complete(row, species);
      } catch (const InputError& problem) {
        throw InputError(std::string("the grain ") + problem.what());
      }
      rows.push_back(row);
    } catch (const InputError& problem) {
      faults.foreign(fmt::format("{}:{}: {}", file, number, problem.what()), key);
      ++found;
      if (columns.empty()) break; // a wrong heading spoils every line
    }
  }
  if (rows.empty() && found == 0) faults.foreign(fmt::format("{}: there is no grain in the file", file), key);
  return rows;
}

} // namespace

void readGrainRows(TableReader& in, const std::vector<Species>& species, const std::string& baseFolder,
                   FillSpec& fill) {
  Parameters values;
  in.read(
      {{.name = "csv", .type = ParameterType::text, .unit = "1", .description = "file", .optional = true}},
      values);
  const auto before = in.faults().has(in.path());
  std::vector<Row> rows = inlineRows(in, species);
  if (values.has("csv")) {
    if (!rows.empty()) in.faults().about(in.path(), "has both 'grains' and 'csv'; give one of them");
    const auto file = std::filesystem::path(baseFolder) / values.text("csv");
    if (!std::filesystem::is_regular_file(file))
      in.faults().wrong(in.pathOf("csv"),
                        fmt::format("but there is no file {}", file.lexically_normal().string()));
    else
      rows = csvRows(file.lexically_normal().string(), species, in.pathOf("csv"), in.faults());
  } else if (rows.empty() && !before && !in.faults().has(in.path())) {
    in.faults().about(
        in.path(),
        "lists no grains; give grains = [{ position = [\"0 m\", \"0 m\", \"0 m\"] }, …] or csv = \"FILE\"");
  }

  std::vector<std::string> names;
  std::vector<double> diameters;
  std::vector<Vec3> positions, velocities, spins;
  for (const auto& row : rows) {
    names.push_back(row.species);
    diameters.push_back(*row.diameter);
    positions.push_back(row.position);
    velocities.push_back(row.velocity);
    spins.push_back(row.spin);
  }
  fill.mixture.clear();
  fill.how.parameters.set("species", std::move(names));
  fill.how.parameters.set("diameters", std::move(diameters));
  fill.how.parameters.set("positions", std::move(positions));
  fill.how.parameters.set("velocities", std::move(velocities));
  fill.how.parameters.set("spins", std::move(spins));
}

} // namespace sandglass
