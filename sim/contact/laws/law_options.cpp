#include "sim/contact/laws/law_options.h"

#include "sim/base/error.h"

#include <fmt/format.h>

namespace sandglass {

namespace {

constexpr double unlimited = 1e30; // finite in single precision too

} // namespace

bool requireOne(const Parameters& p, const std::string& who, const std::string& first,
                const std::string& second) {
  if (p.has(first) == p.has(second))
    throw InputError(fmt::format("{} needs either {} or {}; {} given", who, first, second,
                                 p.has(first) ? "both are" : "neither is"));
  return p.has(first);
}

ParameterSpec clampAttraction() {
  return {"clamp_attraction", ParameterType::boolean, "1",
          "cut the dashpot's attraction while parting; see 'restitution' of explain", ParameterValue(false)};
}

double attractionFloor(const Parameters& p) {
  return p.boolean("clamp_attraction") ? 0.0 : -unlimited;
}

ParameterSpec contactArm() {
  ParameterSpec arm{"arm", ParameterType::text, "1",
                    "lever arm of slip and torque: up to the contact point (keeps angular momentum), or the "
                    "full radius as in other programs",
                    ParameterValue(std::string("contact"))};
  arm.choices = {"contact", "radius"};
  return arm;
}

bool readsFullRadiusArm(const Parameters& p) {
  return p.text("arm") == "radius";
}

ParameterSpec coupleLength() {
  return {"length", ParameterType::number, "m", "largest couple over normal force", {}, true, 0.0, 1e30,
          true};
}

ParameterSpec coupleCoefficient() {
  return {"coefficient",
          ParameterType::number,
          "1",
          "the same as a share of the effective radius",
          {},
          true,
          0.0,
          10.0,
          true};
}

ParameterSpec coupleDamping() {
  return {"damping",
          ParameterType::number,
          "1",
          "share of critical damping below the limit",
          ParameterValue(0.3),
          false,
          0.0,
          1.0};
}

void SharedChoice::take(bool value) {
  if (set_ && value != value_)
    throw InputError(fmt::format("all contacts of a scene need the same choice of '{}'", option_));
  set_ = true;
  value_ = value;
}

} // namespace sandglass
