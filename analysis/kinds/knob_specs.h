#pragma once
// Short ways to write knobs.

#include "sim/scene/parameters.h"

#include <cstdint>
#include <string>
#include <utility>

namespace sandglass::analysis {

inline ParameterSpec numberKnob(std::string name, double fallback, double minimum, double maximum,
                                std::string description, bool openMinimum = false) {
  return {.name = std::move(name),
          .type = ParameterType::number,
          .unit = "1",
          .description = std::move(description),
          .fallback = fallback,
          .minimum = minimum,
          .maximum = maximum,
          .openMinimum = openMinimum};
}

inline ParameterSpec integerKnob(std::string name, std::int64_t fallback, double minimum, double maximum,
                                 std::string description) {
  return {.name = std::move(name),
          .type = ParameterType::integer,
          .unit = "1",
          .description = std::move(description),
          .fallback = fallback,
          .minimum = minimum,
          .maximum = maximum};
}

inline ParameterSpec choiceKnob(std::string name, std::string fallback, std::vector<std::string> choices,
                                std::string description) {
  return {.name = std::move(name),
          .type = ParameterType::text,
          .unit = "1",
          .description = std::move(description),
          .fallback = std::move(fallback),
          .choices = std::move(choices)};
}

inline ParameterSpec textKnob(std::string name, std::string fallback, std::string description) {
  return choiceKnob(std::move(name), std::move(fallback), {}, std::move(description));
}

inline ParameterSpec switchKnob(std::string name, bool fallback, std::string description) {
  return {.name = std::move(name),
          .type = ParameterType::boolean,
          .unit = "1",
          .description = std::move(description),
          .fallback = fallback};
}

} // namespace sandglass::analysis
