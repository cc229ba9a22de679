#include "sim/scene/units.h"

#include "sim/base/error.h"

#include <fmt/format.h>
#include <udunits2.h>

#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>

namespace sandglass {

namespace {

struct Dimension {
  const char* unit;
  const char* name;
  const char* example;
};

constexpr std::array<Dimension, 20> dimensions{{
    {"1", "a plain number", "0.5"},
    {"m", "a length", "3 mm"},
    {"kg", "a mass", "50 g"},
    {"s", "a time", "0.5 s"},
    {"rad", "an angle", "45 deg"},
    {"m/s", "a speed", "0.5 m/s"},
    {"m/s^2", "an acceleration", "9.81 m/s^2"},
    {"rad/s", "a rate of turning", "30 rpm"},
    {"1/s", "a number per time", "1000 1/s"},
    {"kg/s", "a mass per time", "20 g/s"},
    {"kg/m^3", "a density", "2500 kg/m^3"},
    {"m^2", "an area", "2 cm^2"},
    {"m^3", "a volume", "5 mm^3"},
    {"N", "a force", "2 mN"},
    {"N m", "a torque", "2 mN m"},
    {"N/m", "a stiffness", "250 N/m"},
    {"N s/m", "a damping constant", "0.01 N s/m"},
    {"Pa", "a pressure", "5 MPa"},
    {"J", "an energy", "0.3 nJ"},
    {"K", "a temperature", "300 K"},
}};

using Unit = std::unique_ptr<ut_unit, decltype(&ut_free)>;

/// udunits2 keeps global state: one caller at a time.
class UnitSystem {
public:
  static UnitSystem& get() {
    static UnitSystem system;
    return system;
  }
  std::mutex mutex;

  Unit parse(std::string_view text) const {
    const std::string copy(text);
    return {ut_parse(system_, copy.c_str(), UT_UTF8), &ut_free};
  }

private:
  UnitSystem() {
    ut_set_error_message_handler(ut_ignore);
    system_ = ut_read_xml(nullptr);
    if (!system_)
      throw RunError("the units library found no unit data; install the package libudunits2-data");
    alias("deg", "arc_degree");
    alias("rpm", "2 pi radian/minute"); // the library's own rpm is a number of turns, not of radians
  }
  void alias(const char* name, const char* definition) {
    const Unit unit = parse(definition);
    ut_unmap_name_to_unit(system_, name, UT_UTF8);
    ut_map_name_to_unit(name, UT_UTF8, unit.get());
  }
  ut_system* system_ = nullptr;
};

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// Name of the dimension of a unit that turned out to be the wrong one.
std::string nameOf(const UnitSystem& system, const ut_unit* unit, std::string_view text) {
  for (const auto& d : dimensions) {
    const Unit known = system.parse(d.unit);
    if (known && ut_are_convertible(known.get(), unit)) return d.name;
  }
  return fmt::format("a quantity in {}", text);
}

double converted(double value, ut_unit* from, ut_unit* to) {
  if (ut_compare(from, to) == 0) return value;
  const std::unique_ptr<cv_converter, decltype(&cv_free)> converter(ut_get_converter(from, to), &cv_free);
  const double factor = cv_convert_double(converter.get(), 1.0);
  const bool proportional =
      cv_convert_double(converter.get(), 0.0) == 0 &&
      std::abs(cv_convert_double(converter.get(), 2.0) - 2 * factor) < 1e-12 * std::abs(factor);
  if (!proportional) return std::numeric_limits<double>::quiet_NaN();
  // 2.24 mm is to be the number nearest to 0.00224: dividing by 1000 rounds once, multiplying by 0.001 twice.
  const double inverse = std::round(1 / factor);
  if (factor < 1 && std::abs(inverse * factor - 1) < 1e-14) return value / inverse;
  return value * factor;
}

} // namespace

std::string dimensionName(const std::string& siUnit) {
  for (const auto& d : dimensions)
    if (siUnit == d.unit) return d.name;
  return fmt::format("a quantity in {}", siUnit);
}

std::string quantityExample(const std::string& siUnit) {
  for (const auto& d : dimensions)
    if (siUnit == d.unit) return siUnit == "1" ? d.example : fmt::format("\"{}\"", d.example);
  return fmt::format("\"1 {}\"", siUnit);
}

std::string quantityText(double value, const std::string& siUnit) {
  if (siUnit != "1") return fmt::format("{} {}", value, siUnit);
  if (value == 0 && std::signbit(value))
    return "-0.0"; // "-0" would be read as a whole number, without its sign
  return fmt::format("{}", value);
}

double parseQuantity(std::string_view text, const std::string& siUnit) {
  const std::string due =
      fmt::format("{} is due, such as {}", dimensionName(siUnit), quantityExample(siUnit));
  text = trimmed(text);
  std::string_view digits = text;
  if (!digits.empty() && digits.front() == '+') digits.remove_prefix(1);
  double value = 0;
  const auto [end, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (problem == std::errc::invalid_argument) throw InputError("but it must begin with a number; " + due);
  if (problem == std::errc::result_out_of_range || !std::isfinite(value))
    throw InputError("but it must be a finite number; " + due);
  const std::string_view unitText = trimmed(digits.substr(static_cast<std::size_t>(end - digits.data())));

  if (unitText.empty()) {
    if (siUnit == "1" || value == 0) return value;
    throw InputError("but the unit is missing; " + due);
  }
  // A second number would be taken as a factor of the unit, "@" as a shift of its origin.
  const bool isNumber = std::string_view("+-.0123456789").find(unitText.front()) != std::string_view::npos;
  if ((isNumber && !unitText.starts_with("1/")) || unitText.find('@') != std::string_view::npos)
    throw InputError(fmt::format("but '{}' is not a unit; {}", unitText, due));

  UnitSystem& system = UnitSystem::get();
  const std::lock_guard lock(system.mutex);
  const Unit given = system.parse(unitText), wanted = system.parse(siUnit);
  if (!wanted)
    throw RunError(fmt::format("the unit '{}' of a parameter is unknown to the units library", siUnit));
  if (!given) throw InputError(fmt::format("but '{}' is not a known unit; {}", unitText, due));
  if (!ut_are_convertible(given.get(), wanted.get()))
    throw InputError(fmt::format("{}, but {}", nameOf(system, given.get(), unitText), due));
  // Whether 1 Hz is one radian or one turn a second is anybody's guess.
  if (siUnit.find("rad") != std::string::npos && unitText.find("Hz") != std::string_view::npos)
    throw InputError("but Hz leaves open whether turns or radians are meant; write \"rad/s\" or \"rpm\"");
  const double result = converted(value, given.get(), wanted.get());
  if (std::isnan(result))
    throw InputError(fmt::format("but '{}' is no multiple of {}; {}", unitText, siUnit, due));
  if (std::isinf(result)) throw InputError("but it must be a finite number; " + due);
  return result;
}

} // namespace sandglass
