#include "analysis/registry.h"
#include "sim/base/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

namespace sandglass::analysis {

namespace {

template <class Number> bool parse(const std::string& text, Number& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

std::string ruleOf(const ParameterSpec& spec) {
  if (!spec.choices.empty()) return fmt::format("one of {}", fmt::join(spec.choices, ", "));
  if (spec.type == ParameterType::boolean) return "true or false";
  std::string rule = spec.type == ParameterType::integer ? "a whole number" : "a number";
  if (spec.type == ParameterType::text) return "a text";
  if (spec.type == ParameterType::numbers) rule = "numbers with commas between";
  if (std::isfinite(spec.minimum))
    rule += fmt::format(" {} {}", spec.openMinimum ? "above" : "from", spec.minimum);
  if (std::isfinite(spec.maximum)) rule += fmt::format(" up to {}", spec.maximum);
  return rule;
}

bool inRange(double x, const ParameterSpec& spec) {
  return x <= spec.maximum && (spec.openMinimum ? x > spec.minimum : x >= spec.minimum);
}

std::optional<ParameterValue> valueOf(const ParameterSpec& spec, const std::string& text) {
  switch (spec.type) {
  case ParameterType::boolean:
    if (text == "true" || text == "false") return text == "true";
    return {};
  case ParameterType::integer: {
    std::int64_t whole = 0;
    if (parse(text, whole) && inRange(static_cast<double>(whole), spec)) return whole;
    // 1e6 is what people write for a million.
    double number = 0;
    if (parse(text, number) && std::abs(number) < 9e15 && number == std::floor(number) &&
        inRange(number, spec))
      return static_cast<std::int64_t>(number);
    return {};
  }
  case ParameterType::number: {
    double number = 0;
    if (parse(text, number) && inRange(number, spec)) return number;
    return {};
  }
  case ParameterType::numbers: {
    std::vector<double> numbers;
    for (std::size_t from = 0; from <= text.size() && !text.empty();) {
      const std::size_t comma = std::min(text.find(',', from), text.size());
      double number = 0;
      if (!parse(text.substr(from, comma - from), number) || !inRange(number, spec)) return {};
      numbers.push_back(number);
      from = comma + 1;
    }
    return numbers;
  }
  case ParameterType::text:
    if (spec.choices.empty() ||
        std::find(spec.choices.begin(), spec.choices.end(), text) != spec.choices.end())
      return text;
    return {};
  default:
    return {};
  }
}

} // namespace

void setKnob(Parameters& knobs, const AnalysisKind& kind, const std::string& knob, const std::string& text) {
  std::vector<std::string> names;
  for (const auto& spec : kind.knobs) {
    names.push_back(spec.name);
    if (spec.name != knob) continue;
    const auto value = valueOf(spec, text);
    if (!value)
      throw InputError(
          fmt::format("the knob {}.{} is '{}', but must be {}", kind.name, knob, text, ruleOf(spec)));
    knobs.set(knob, *value);
    return;
  }
  throw InputError(fmt::format("the analysis {} has no knob '{}'; it has {}", kind.name, knob,
                               names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
}

} // namespace sandglass::analysis
