#pragma once
// Every registered law with parameters that make sense at the size of millimetre grains, in two variants.

#include "tests/sim/physics/bench_scenes.h"

#include <algorithm>

namespace sandglass::testing {

/// Parameters that make sense for any law: what a kind requires or offers, at the size of millimetre grains.
inline Parameters usual(const LawKind& kind, int variant) {
  Parameters p;
  for (const ParameterSpec& spec : kind.parameters)
    if (spec.fallback) p.set(spec.name, *spec.fallback);
  const auto offer = [&](const char* name, double value) {
    for (const ParameterSpec& spec : kind.parameters)
      if (spec.name == name) p.set(name, value);
  };
  const bool other = variant == 1;
  if (other) {
    offer("damping_rate", kind.name == "hertz" ? 1e6 : 300.0);
    offer("unloading_stiffness", 1500.0);
  } else if (kind.role != LawRole::tangential) {
    offer("restitution", 0.8);
  }
  if (kind.name == "hertz" && other) p.set("clamp_attraction", true);
  if (kind.role == LawRole::normal) offer("stiffness", 1000.0);
  if (kind.name == "walton") offer(other ? "stiffness" : "stiffness_ratio", other ? 700.0 : 0.8);
  if (kind.name == "walton" && other) p.set("exponent", 0.7);
  if (kind.name == "viscous" && !other) offer("damping", 1e-2);
  offer("friction", 0.4);
  if (kind.name == "spring" && other) p.set("rotation", std::string("project"));
  offer(other ? "length" : "coefficient", other ? 2e-5 : 0.05);
  offer("surface_energy", 0.1);
  if (kind.name == "jkr" || kind.name == "dmt") p.set("restitution", 0.9);
  offer("lifshitz_constant", 1e-12);
  if (kind.name == "rice" && kind.role == LawRole::normal) {
    offer("dissipation_time", 1e-5);
    if (other) p.set("radius", std::string("doubled"));
    if (other) p.set("overlap_rate", std::string("difference"));
  }
  offer("slip_rate", other ? 3000.0 : 300.0); // slip = "spin" keeps neither energy nor symmetry: fields tests
  if (kind.role == LawRole::gap) {
    offer("smallest_separation", 2e-6);
    offer("cutoff", 1e-4);
  }
  for (const ParameterSpec& spec : kind.parameters)
    if (spec.name == "charges") p.set("charges", std::vector<double>{2e-12, 2e-12});
  return p;
}

inline std::string toml(const LawKind& kind, int variant) {
  std::string text = fmt::format("{{ law = \"{}\"", kind.name);
  const Parameters parameters = usual(kind, variant);
  for (const auto& [name, value] : parameters.all()) {
    const auto spec = std::find_if(kind.parameters.begin(), kind.parameters.end(),
                                   [&, key = name](const ParameterSpec& s) { return s.name == key; });
    const std::string unit = spec->unit == "1" ? "" : spec->unit;
    const auto quantity = [&](double x) {
      return unit.empty() ? fmt::format("{:.17g}", x) : fmt::format("\"{:.17g} {}\"", x, unit);
    };
    if (const auto* x = std::get_if<double>(&value)) text += fmt::format(", {} = {}", name, quantity(*x));
    if (const auto* x = std::get_if<bool>(&value)) text += fmt::format(", {} = {}", name, *x);
    if (const auto* x = std::get_if<std::string>(&value)) text += fmt::format(", {} = \"{}\"", name, *x);
    if (const auto* x = std::get_if<std::vector<double>>(&value))
      text += fmt::format(", {} = [{}, {}]", name, quantity(x->at(0)), quantity(x->at(1)));
  }
  return text + " }";
}

/// A scene with that law in its role and simple ones in the others.
inline SceneText sceneWith(const LawKind& kind, int variant) {
  SceneText t;
  t.elasticity = "youngs_modulus = \"20 MPa\"\npoisson_ratio = 0.25";
  t.tangential = R"({ law = "spring", friction = 0.5 })";
  const std::string law = toml(kind, variant);
  if (kind.role == LawRole::normal) t.normal = law;
  if (kind.role == LawRole::tangential) t.tangential = law;
  if (kind.role == LawRole::rolling) t.rolling = law;
  if (kind.role == LawRole::torsion) t.rolling += "\ntorsion = " + law;
  if (kind.role == LawRole::gap) t.rolling += "\ngap = [" + law + "]";
  return t;
}

} // namespace sandglass::testing
