#pragma once
// Parameters that several laws share, and how they are read.

#include "sim/scene/parameters.h"

#include <string>

namespace sandglass {

/// True when `first` is given, false when `second` is. Throws InputError unless exactly one of them is.
/// `who` begins the sentence ("a linear contact").
bool requireOne(const Parameters& p, const std::string& who, const std::string& first,
                const std::string& second);

/// The option `clamp_attraction` of laws with a dashpot.
ParameterSpec clampAttraction();
/// The most attractive force allowed [N]: 0 with that option, else as good as unlimited.
double attractionFloor(const Parameters& p);

/// The option `arm` of tangential laws: see Law::fullRadiusArm.
ParameterSpec contactArm();
bool readsFullRadiusArm(const Parameters& p);

/// Parameters of the couples of rolling and torsion: largest couple over normal force as a length or as a
/// share of the effective radius, and the share of critical damping.
ParameterSpec coupleLength();
ParameterSpec coupleCoefficient();
ParameterSpec coupleDamping();

/// Sets a choice that all types of a law share, or throws InputError when they differ.
class SharedChoice {
public:
  SharedChoice(std::string option) : option_(std::move(option)) {}
  void take(bool value);
  bool value() const { return value_; }

private:
  std::string option_;
  bool set_ = false, value_ = false;
};

} // namespace sandglass
