#include "sim/scene/table_reader.h"

#include "sim/base/error.h"
#include "sim/scene/units.h"

#include <algorithm>
#include <cmath>

namespace sandglass {

namespace {

/// "an" file:line sentence part about what is due: "a length", "a whole number", "a list of lengths".
std::string due(const ParameterSpec& spec) {
  switch (spec.type) {
  case ParameterType::number:
    return dimensionName(spec.unit);
  case ParameterType::integer:
    return "a whole number";
  case ParameterType::boolean:
    return "true or false";
  case ParameterType::text:
    return "text in quotes";
  case ParameterType::vector:
    return fmt::format("a list of three ({} each)", dimensionName(spec.unit));
  case ParameterType::numbers:
    return fmt::format("a list ({} each)", dimensionName(spec.unit));
  case ParameterType::vectors:
    return fmt::format("a list of lists of three ({} each)", dimensionName(spec.unit));
  case ParameterType::texts:
    return "a list of texts in quotes";
  }
  return "";
}

std::string example(const ParameterSpec& spec) {
  const std::string one = quantityExample(spec.unit.empty() ? "1" : spec.unit);
  switch (spec.type) {
  case ParameterType::number:
    return one;
  case ParameterType::integer:
    return "100";
  case ParameterType::boolean:
    return "true";
  case ParameterType::text:
    return spec.choices.empty() ? "\"…\"" : "\"" + spec.choices.front() + "\"";
  case ParameterType::vector:
    return fmt::format("[{0}, {0}, {0}]", one);
  case ParameterType::numbers:
    return fmt::format("[{}, …]", one);
  case ParameterType::vectors:
    return fmt::format("[[{0}, {0}, {0}], …]", one);
  case ParameterType::texts:
    return spec.choices.empty() ? "[\"…\"]" : "[\"" + spec.choices.front() + "\"]";
  }
  return "";
}

/// Reads one value; throws InputError with a phrase that continues "KEY is VALUE, ...".
class Converter {
public:
  explicit Converter(const ParameterSpec& spec) : spec_(spec), unit_(spec.unit.empty() ? "1" : spec.unit) {}

  double number(const Value& value) const {
    double result = 0;
    if (const auto* text = value.text())
      result = parseQuantity(*text, unit_);
    else if (const auto* whole = std::get_if<std::int64_t>(&value.data))
      result = bare(static_cast<double>(*whole));
    else if (const auto* real = std::get_if<double>(&value.data))
      result = bare(*real);
    else
      mismatch(value);
    checkRange(result);
    return result;
  }

  std::int64_t integer(const Value& value) const {
    std::int64_t result = 0;
    if (const auto* whole = std::get_if<std::int64_t>(&value.data)) {
      result = *whole;
    } else if (const auto* real =
                   std::get_if<double>(&value.data)) { // 1e5 is a whole number to everybody but TOML
      if (!std::isfinite(*real) || *real != std::floor(*real) || std::abs(*real) > 9e15) mismatch(value);
      result = static_cast<std::int64_t>(*real);
    } else {
      mismatch(value);
    }
    checkRange(static_cast<double>(result));
    return result;
  }

  bool boolean(const Value& value) const {
    if (const auto* flag = std::get_if<bool>(&value.data)) return *flag;
    mismatch(value);
  }

  std::string text(const Value& value) const {
    const auto* text = value.text();
    if (!text) mismatch(value);
    if (!spec_.choices.empty() &&
        std::find(spec_.choices.begin(), spec_.choices.end(), *text) == spec_.choices.end())
      throw InputError("which is not among the values allowed; " +
                       suggestion(*text, spec_.choices, "allowed are"));
    return *text;
  }

  Vec3 vector(const Value& value) const {
    const auto* list = value.list();
    if (!list) mismatch(value);
    if (list->size() != 3)
      throw InputError(
          fmt::format("a list of {}, but {} is due, such as {}", list->size(), due(spec_), example(spec_)));
    return {number((*list)[0]), number((*list)[1]), number((*list)[2])};
  }

  template <class T, class F> std::vector<T> list(const Value& value, F element) const {
    const auto* list = value.list();
    if (!list) mismatch(value);
    std::vector<T> all;
    for (const auto& v : *list)
      all.push_back(element(v));
    return all;
  }

  [[noreturn]] void mismatch(const Value& value) const {
    const bool anyText = spec_.type == ParameterType::text && spec_.choices.empty();
    throw InputError(fmt::format("{}, but {} is due{}", typeName(value), due(spec_),
                                 anyText ? "" : ", such as " + example(spec_)));
  }

private:
  double bare(double value) const {
    if (!std::isfinite(value)) throw InputError("but it must be a finite number");
    if (unit_ != "1" && value != 0)
      throw InputError(fmt::format("but the unit is missing; {} is due, such as {}", dimensionName(unit_),
                                   quantityExample(unit_)));
    return value;
  }

  void checkRange(double value) const {
    const auto text = [&](double limit) { return quantityText(limit, unit_); };
    if (spec_.openMinimum && value <= spec_.minimum)
      throw InputError(fmt::format("but must be above {}", text(spec_.minimum)));
    if (value < spec_.minimum) throw InputError(fmt::format("but must not be below {}", text(spec_.minimum)));
    if (value > spec_.maximum) throw InputError(fmt::format("but must not be above {}", text(spec_.maximum)));
  }

  const ParameterSpec& spec_;
  std::string unit_;
};

ParameterValue convert(const Value& value, const ParameterSpec& spec) {
  const Converter c(spec);
  switch (spec.type) {
  case ParameterType::number:
    return c.number(value);
  case ParameterType::integer:
    return c.integer(value);
  case ParameterType::boolean:
    return c.boolean(value);
  case ParameterType::text:
    return c.text(value);
  case ParameterType::vector:
    return c.vector(value);
  case ParameterType::numbers:
    return c.list<double>(value, [&](const Value& v) { return c.number(v); });
  case ParameterType::vectors:
    return c.list<Vec3>(value, [&](const Value& v) { return c.vector(v); });
  case ParameterType::texts:
    return c.list<std::string>(value, [&](const Value& v) { return c.text(v); });
  }
  c.mismatch(value);
}

} // namespace

std::optional<ParameterValue> readValue(const Value& value, const ParameterSpec& spec, const std::string& key,
                                        FaultList& faults) {
  faults.note(key, value);
  try {
    return convert(value, spec);
  } catch (const InputError& problem) {
    faults.wrong(key, problem.what());
    return std::nullopt;
  }
}

const Value* TableReader::take(const std::string& key) {
  known_.push_back(key);
  for (const auto& entry : table_)
    if (entry.key == key) {
      faults_.note(pathOf(key), entry.value);
      return &entry.value;
    }
  return nullptr;
}

void TableReader::read(const std::vector<ParameterSpec>& specs, Parameters& values) {
  for (const auto& spec : specs) {
    if (const Value* value = take(spec.name)) {
      if (auto result = readValue(*value, spec, pathOf(spec.name), faults_))
        values.set(spec.name, std::move(*result));
    } else if (spec.fallback) {
      values.set(spec.name, *spec.fallback);
    } else if (!spec.optional) {
      faults_.about(path_.empty() ? spec.name : path_,
                    fmt::format("{} ({}); {} is due, such as {} = {}",
                                path_.empty() ? "is missing" : fmt::format("lacks the key '{}'", spec.name),
                                spec.description, due(spec), spec.name, example(spec)));
    }
  }
}

const ValueTable* TableReader::subtable(const std::string& key) {
  const Value* value = take(key);
  if (!value) return nullptr;
  if (!value->table())
    faults_.wrong(pathOf(key),
                  fmt::format("{}, but a table is due, written [{}]", typeName(*value), pathOf(key)));
  return value->table();
}

std::vector<std::pair<const ValueTable*, std::string>> TableReader::subtables(const std::string& key,
                                                                              bool named) {
  std::vector<std::pair<const ValueTable*, std::string>> all;
  const Value* value = take(key);
  if (!value) return all;
  const auto* list = value->list();
  if (!list) {
    faults_.wrong(pathOf(key), fmt::format("{}, but a list of tables is due, each written [[{}]]",
                                           typeName(*value), pathOf(key)));
    return all;
  }
  for (std::size_t i = 0; i < list->size(); ++i) {
    const Value& entry = (*list)[i];
    const std::string path = pathOf(key) + "." + (named ? entryName(entry, i) : std::to_string(i + 1));
    faults_.note(path, entry);
    if (entry.table())
      all.emplace_back(entry.table(), path);
    else
      faults_.wrong(path, fmt::format("{}, but a table is due", typeName(entry)));
  }
  return all;
}

void TableReader::reportUnknown() {
  if (!judgeUnknown_) return;
  for (const auto& entry : table_) {
    if (std::find(known_.begin(), known_.end(), entry.key) != known_.end()) continue;
    faults_.note(pathOf(entry.key), entry.value);
    faults_.about(pathOf(entry.key),
                  "is not a known key here; " + suggestion(entry.key, known_, "known are"));
  }
}

} // namespace sandglass
