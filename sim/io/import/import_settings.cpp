#include "sim/io/import/import_settings.h"

#include "sim/base/error.h"
#include "sim/io/import/column_names.h"
#include "sim/io/import/row_parser.h"
#include "sim/scene/suggest.h"
#include "sim/scene/units.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

namespace sandglass {

namespace fs = std::filesystem;

namespace {

/// Reads one document and gathers what is wrong with it.
class Reader {
public:
  Reader(const toml::table& root, std::string name, fs::path folder)
      : root_(root), name_(std::move(name)), folder_(std::move(folder)) {}

  ImportSettings read() {
    known(root_, "", {"columns", "units", "time", "box", "grains", "walls"});
    columns();
    units();
    if (const auto* t = table("time", {"step", "interval"})) {
      settings_.timeStep = positive(*t, "time", "step", "s");
      settings_.frameInterval = positive(*t, "time", "interval", "s");
    }
    box();
    grains();
    walls();
    if (!faults_.empty()) throw InputError(std::move(faults_));
    return settings_;
  }

private:
  void fault(const std::string& sentence) { faults_.push_back(name_ + ": " + sentence); }

  void known(const toml::table& table, const std::string& path, const std::vector<std::string>& keys) {
    for (const auto& [key, value] : table)
      if (std::find(keys.begin(), keys.end(), std::string(key.str())) == keys.end())
        fault(fmt::format("{}{} is unknown; {}", path, std::string(key.str()),
                          suggestion(std::string(key.str()), keys, "known")));
  }
  const toml::table* table(const std::string& name, const std::vector<std::string>& keys) {
    const toml::node* node = root_.get(name);
    if (!node) return nullptr;
    if (!node->is_table()) {
      fault(fmt::format("{} must be a table", name));
      return nullptr;
    }
    if (!keys.empty()) known(*node->as_table(), name + ".", keys);
    return node->as_table();
  }
  /// Text or number in SI units.
  std::optional<double> number(const toml::node& node, const std::string& path, const char* unit) {
    if (const auto value = node.value_exact<double>()) return *value;
    if (const auto value = node.value_exact<std::int64_t>()) return static_cast<double>(*value);
    if (const auto text = node.value_exact<std::string>()) try {
        return importQuantity(path, *text, unit);
      } catch (const InputError& e) {
        fault(e.what());
        return std::nullopt;
      }
    fault(fmt::format("{} must be {}", path, dimensionName(unit)));
    return std::nullopt;
  }
  std::optional<double> positive(const toml::table& t, const std::string& path, const char* key,
                                 const char* unit) {
    const toml::node* node = t.get(key);
    if (!node) return std::nullopt;
    const auto value = number(*node, path + "." + key, unit);
    if (value && !(*value > 0 && std::isfinite(*value))) {
      fault(fmt::format("{}.{} is {}, but must be above 0", path, key, *value));
      return std::nullopt;
    }
    return value;
  }

  /// Names stand in sentences and in files that are written.
  bool printable(const std::string& table, const std::string& name) {
    const auto odd =
        std::find_if(name.begin(), name.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; });
    if (odd == name.end()) return true;
    fault(fmt::format("{} has a name with the control character 0x{:02x} after '{}'; names are without",
                      table, static_cast<unsigned char>(*odd), std::string(name.begin(), odd)));
    return false;
  }
  void flatten(const toml::table& t, const std::string& prefix) {
    for (const auto& [key, value] : t) {
      const std::string name = prefix + std::string(key.str());
      if (name == "ignore" || !printable("columns", name)) continue;
      if (value.is_table())
        flatten(*value.as_table(), name + ".");
      else if (const auto text = value.value_exact<std::string>())
        settings_.columns[name] = *text;
      else
        fault(fmt::format("columns.{} must be the name of a column, or \"\" to leave it out", name));
    }
  }
  void columns() {
    const auto* t = table("columns", {});
    if (!t) return;
    flatten(*t, "");
    if (const toml::node* ignore = t->get("ignore")) {
      const auto* list = ignore->as_array();
      for (std::size_t k = 0; list && k < list->size(); ++k)
        if (const auto text = list->get(k)->value_exact<std::string>())
          settings_.ignored.push_back(*text);
        else
          list = nullptr;
      if (!list) fault("columns.ignore must be a list of names of columns");
    }
  }
  void units() {
    const auto* t = table("units", {"length", "time", "mass"});
    if (!t) return;
    const auto one = [&](const char* key, const char* si, double& into) {
      const toml::node* node = t->get(key);
      if (!node) return;
      const auto text = node->value_exact<std::string>();
      try {
        into = unitSize(std::string("units.") + key, text.value_or(""), si);
      } catch (const InputError& e) {
        fault(e.what());
      }
    };
    one("length", "m", settings_.length);
    one("time", "s", settings_.time);
    one("mass", "kg", settings_.mass);
  }
  static double unitSize(const std::string& path, const std::string& text, const std::string& si) {
    const bool counted = !text.empty() && (text[0] == '.' || (text[0] >= '0' && text[0] <= '9'));
    return importQuantity(path, counted ? text : "1 " + text, si); // "mm", or "2.5 mm" a unit
  }
  std::optional<Vec3> corner(const toml::table& t, const char* key) {
    const toml::node* node = t.get(key);
    if (!node) return std::nullopt;
    const auto* list = node->as_array();
    if (!list || list->size() != 3) {
      fault(fmt::format("box.{} must be a list of three lengths", key));
      return std::nullopt;
    }
    Vec3 corner;
    for (int k = 0; k < 3; ++k) {
      const auto value = number(*list->get(static_cast<std::size_t>(k)), fmt::format("box.{}", key), "m");
      if (!value) return std::nullopt;
      corner[k] = *value;
    }
    return corner;
  }
  void box() {
    const auto* t = table("box", {"lower", "upper", "periodic"});
    if (!t) return;
    settings_.lower = corner(*t, "lower");
    settings_.upper = corner(*t, "upper");
    if (settings_.lower.has_value() != settings_.upper.has_value())
      fault("box needs both lower and upper, or neither");
    else if (settings_.lower && !(settings_.lower->array() < settings_.upper->array()).all())
      fault("box.upper must be above box.lower in every direction");
    if (const toml::node* node = t->get("periodic")) try {
        settings_.periodic =
            periodicDirections("box.periodic", node->value_exact<std::string>().value_or("?"));
      } catch (const InputError& e) {
        fault(e.what());
      }
  }
  void grains() {
    const auto* t = table("grains", {"radius", "radius_of", "shape"});
    if (!t) return;
    settings_.radius = positive(*t, "grains", "radius", "m");
    if (const toml::node* of = t->get("radius_of")) {
      if (!of->is_table())
        fault("grains.radius_of must be a table of a radius by species");
      else
        for (const auto& [key, value] : *of->as_table()) {
          const std::string species(key.str());
          if (!printable("grains.radius_of", species)) continue;
          if (const auto radius = positive(*of->as_table(), "grains.radius_of", species.c_str(), "m"))
            settings_.radiusOf[species] = *radius;
        }
    }
    if (const toml::node* shape = t->get("shape")) {
      settings_.shape = shape->value_exact<std::string>().value_or("?");
      if (settings_.shape != "diameters" && settings_.shape != "semi-axes")
        fault(
            fmt::format("grains.shape is '{}', but must be \"diameters\" or \"semi-axes\"", settings_.shape));
    }
  }
  void walls() {
    const auto* t = table("walls", {"files", "unit"});
    if (!t) return;
    if (const toml::node* node = t->get("files")) {
      const auto* list = node->as_array();
      for (std::size_t k = 0; list && k < list->size(); ++k)
        if (const auto text = list->get(k)->value_exact<std::string>())
          settings_.walls.push_back(fs::path(*text).is_absolute() ? fs::path(*text) : folder_ / *text);
        else
          list = nullptr;
      if (!list) fault("walls.files must be a list of file names");
    }
    if (const toml::node* unit = t->get("unit")) try {
        settings_.wallUnit = unitSize("walls.unit", unit->value_exact<std::string>().value_or(""), "m");
      } catch (const InputError& e) {
        fault(e.what());
      }
  }

  const toml::table& root_;
  std::string name_;
  fs::path folder_;
  ImportSettings settings_;
  std::vector<std::string> faults_;
};

} // namespace

bool ImportSettings::ignores(const std::string& column) const {
  return std::find(ignored.begin(), ignored.end(), column) != ignored.end();
}

ImportSettings parseImportSettings(const std::string& text, const std::string& nameForMessages,
                                   const fs::path& folder) {
  try {
    const toml::table root = toml::parse(text, nameForMessages);
    return Reader(root, nameForMessages, folder).read();
  } catch (const toml::parse_error& e) {
    throw InputError(
        fmt::format("{}:{}: {}", nameForMessages, e.source().begin.line, std::string(e.description())));
  }
}

ImportSettings readImportSettings(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in || fs::is_directory(file))
    throw InputError(fmt::format("{}: the file cannot be opened; check its name", file.string()));
  std::ostringstream text;
  text << in.rdbuf();
  return parseImportSettings(text.str(), file.string(), file.parent_path());
}

std::string writeImportSettings(const ImportSettings& s) {
  toml::table root;
  toml::table columns;
  for (const auto& [quantity, column] : s.columns)
    columns.insert_or_assign(quantity, column);
  if (!s.ignored.empty()) {
    toml::array list;
    for (const auto& name : s.ignored)
      list.push_back(name);
    columns.insert_or_assign("ignore", std::move(list));
  }
  if (!columns.empty()) root.insert_or_assign("columns", std::move(columns));
  // Units keep their bits as a multiple of the SI unit.
  const auto unit = [](double size, const char* si) { return fmt::format("{} {}", size, si); };
  toml::table units;
  if (s.length != 1) units.insert_or_assign("length", unit(s.length, "m"));
  if (s.time != 1) units.insert_or_assign("time", unit(s.time, "s"));
  if (s.mass != 1) units.insert_or_assign("mass", unit(s.mass, "kg"));
  if (!units.empty()) root.insert_or_assign("units", std::move(units));
  toml::table time;
  if (s.timeStep) time.insert_or_assign("step", *s.timeStep);
  if (s.frameInterval) time.insert_or_assign("interval", *s.frameInterval);
  if (!time.empty()) root.insert_or_assign("time", std::move(time));
  toml::table box;
  const auto corner = [](const Vec3& v) { return toml::array{v.x(), v.y(), v.z()}; };
  if (s.lower) box.insert_or_assign("lower", corner(*s.lower));
  if (s.upper) box.insert_or_assign("upper", corner(*s.upper));
  if (s.periodic) {
    std::string text;
    for (int k = 0; k < 3; ++k)
      if ((*s.periodic)[static_cast<std::size_t>(k)]) text += "xyz"[k];
    box.insert_or_assign("periodic", text.empty() ? "none" : text);
  }
  if (!box.empty()) root.insert_or_assign("box", std::move(box));
  toml::table grains;
  if (s.radius) grains.insert_or_assign("radius", *s.radius);
  if (!s.radiusOf.empty()) {
    toml::table of;
    for (const auto& [species, radius] : s.radiusOf)
      of.insert_or_assign(species, radius);
    grains.insert_or_assign("radius_of", std::move(of));
  }
  if (!s.shape.empty()) grains.insert_or_assign("shape", s.shape);
  if (!grains.empty()) root.insert_or_assign("grains", std::move(grains));
  toml::table walls;
  if (!s.walls.empty()) {
    toml::array files;
    for (const auto& file : s.walls)
      files.push_back(fs::absolute(file).lexically_normal().string());
    walls.insert_or_assign("files", std::move(files));
  }
  if (s.wallUnit != 1) walls.insert_or_assign("unit", unit(s.wallUnit, "m"));
  if (!walls.empty()) root.insert_or_assign("walls", std::move(walls));
  std::ostringstream out;
  out << root << "\n";
  return out.str();
}

double importQuantity(const std::string& what, const std::string& text, const std::string& siUnit) {
  if (const auto value = numberIn(text)) return *value;
  try {
    return parseQuantity(text, siUnit);
  } catch (const InputError&) {
    throw InputError(fmt::format("{} is '{}', but must be {} {}, or a number in {}", what, text,
                                 dimensionName(siUnit), quantityExample(siUnit), siUnit));
  }
}

std::array<bool, 3> periodicDirections(const std::string& what, const std::string& text) {
  std::array<bool, 3> periodic{};
  if (text == "none") return periodic;
  for (const char c : text)
    if (c >= 'x' && c <= 'z' && !periodic[static_cast<std::size_t>(c - 'x')])
      periodic[static_cast<std::size_t>(c - 'x')] = true;
    else
      throw InputError(
          fmt::format("{} is '{}', but must name the directions that repeat, such as \"xy\", or be \"none\"",
                      what, text));
  return periodic;
}

std::optional<fs::path> importSettingsBeside(const fs::path& file) {
  for (const fs::path& candidate :
       {fs::path(file.string() + ".import.toml"), file.parent_path() / "import.toml"})
    if (fs::is_regular_file(candidate)) return candidate;
  return std::nullopt;
}

ImportSettings settingsBeside(const fs::path& file) {
  const auto found = importSettingsBeside(file);
  return found ? readImportSettings(*found) : ImportSettings{};
}

} // namespace sandglass
