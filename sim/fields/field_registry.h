#pragma once
// The fields that a scene can name: what acts on grains beside contacts and gravity. To add one: one file in
// kinds/, one line in field_registry.cpp.

#include "sim/scene/parameters.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace sandglass {

class Field;
struct Domain;

/// In this order fields pass a group of grains.
enum class FieldRole {
  flow,   ///< a velocity of the fluid; flows add up
  shield, ///< lessens drags where other grains are in front
  lift,   ///< a force that is given by place and neighbours
  drag,   ///< a force that draws a grain's velocity to that of the fluid
  spin    ///< a torque that lessens spins
};

struct FieldKind {
  std::string name;
  FieldRole role;
  std::string description; ///< one phrase, for explain and the reference page
  std::string cost;        ///< one phrase, for explain
  std::vector<ParameterSpec> parameters;
  /// Throws InputError (a phrase without file and line) when the values contradict each other.
  std::function<std::unique_ptr<Field>(const Parameters&)> make;
  /// What speaks against it in that domain, a phrase that goes on after its name; nothing when it is fine.
  std::function<std::string(const Parameters&, const Domain&)> objection{};
};

/// All kinds, in the order of the documentation.
const std::vector<FieldKind>& fieldKinds();

/// The kind of that name, or null.
const FieldKind* findField(const std::string& name);

} // namespace sandglass
