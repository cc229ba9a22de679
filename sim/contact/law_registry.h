#pragma once
// The contact laws that a scene can name. To add one: one file in laws/, one line in law_registry.cpp.

#include "sim/scene/parameters.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace sandglass {

class Law;
struct LawContext;

/// Where in `[[contact]]` a law stands.
enum class LawRole { normal, tangential, rolling, torsion, gap };

struct LawKind {
  std::string name;
  LawRole role;
  std::string description;      ///< one phrase, for explain and the reference page
  bool needsElasticity = false; ///< Young's modulus and Poisson ratio of both materials
  std::vector<ParameterSpec> parameters;
  std::function<std::unique_ptr<Law>(const LawContext&)> make;
};

/// All kinds, in the order of the documentation. "none" is a kind of the tangential and rolling roles.
const std::vector<LawKind>& lawKinds();

/// The kind of that name in that role, or null.
const LawKind* findLaw(LawRole role, const std::string& name);

} // namespace sandglass
