#include "sim/contact/law_stack.h"

#include "sim/base/error.h"
#include "sim/grains/seeding.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sandglass {

namespace {

constexpr const char* addedName = "added"; ///< of laws that no scene names

/// Mean grain mass of a material over the species made of it; 0 for a wall's material.
double meanMass(const Scene& scene, const std::string& material) {
  double sum = 0.0;
  int count = 0;
  for (const Species& s : scene.species)
    if (s.material == material) {
      sum += sizeRange(scene, s).meanMass;
      ++count;
    }
  return count == 0 ? 0.0 : sum / count;
}

const ContactSpec* findContact(const Scene& scene, const std::string& a, const std::string& b) {
  for (const ContactSpec& c : scene.contacts)
    if ((c.first == a && c.second == b) || (c.first == b && c.second == a)) return &c;
  return nullptr;
}

/// Of the grains of a material; 0 for a wall's material.
double largestRadius(const Scene& scene, const std::string& material) {
  double largest = 0.0;
  for (const Species& s : scene.species)
    if (s.material == material) largest = std::max(largest, 0.5 * sizeRange(scene, s).largest);
  if (largest > 0.0)
    for (const FillSpec& fill : scene.fills) // lists may give grains a size of their own
      if (fill.how.parameters.has("diameters"))
        for (const double d : fill.how.parameters.numbers("diameters"))
          largest = std::max(largest, 0.5 * d);
  return largest;
}

/// Mass that every grain of a material has, computed as the solver does; 0 when they differ or are none.
double oneMass(const Scene& scene, const Material& material) {
  double mass = 0.0;
  for (const Species& s : scene.species) {
    if (s.material != material.name) continue;
    const SizeRange range = sizeRange(scene, s);
    const double r = 0.5 * range.smallest;
    const double m = 4.0 / 3.0 * std::numbers::pi * r * r * r * material.density;
    if (range.smallest != range.largest || (mass > 0.0 && m != mass)) return 0.0;
    mass = m;
  }
  return mass;
}

/// Reduced mass of all contacts between a and b, 0 when they differ. A wall of a grain's material meets
/// grains as another mass does.
double uniformMass(const Scene& scene, const Material& a, const Material& b) {
  const auto isWall = [&](const Material& m) {
    return std::any_of(scene.walls.begin(), scene.walls.end(),
                       [&](const WallSpec& w) { return w.material == m.name; });
  };
  const bool grainsA = meanMass(scene, a.name) > 0.0, grainsB = meanMass(scene, b.name) > 0.0;
  const double ma = oneMass(scene, a), mb = oneMass(scene, b);
  if (grainsA && grainsB)
    return ma > 0.0 && mb > 0.0 && !isWall(a) && !isWall(b) ? 1.0 / (1.0 / ma + 1.0 / mb) : 0.0;
  const double m = grainsA ? ma : mb;
  return m > 0.0 ? 1.0 / (1.0 / m) : 0.0;
}

/// Everything about the pair but the parameters of a law.
PairType pairType(const Scene& scene, const Material& a, const Material& b) {
  PairType t;
  t.materialA = a.name, t.materialB = b.name;
  const double ma = meanMass(scene, a.name), mb = meanMass(scene, b.name);
  const double ra = largestRadius(scene, a.name), rb = largestRadius(scene, b.name);
  t.used = ra > 0.0 || rb > 0.0;
  t.largestEffectiveRadius = ra > 0.0 && rb > 0.0 ? ra * rb / (ra + rb) : std::max(ra, rb);
  t.referenceMass = ma > 0.0 && mb > 0.0 ? ma * mb / (ma + mb) : std::max(ma, mb);
  if (a.youngsModulus && b.youngsModulus && a.poissonRatio && b.poissonRatio) {
    const auto inverse = [](const Material& m) {
      return (1.0 - *m.poissonRatio * *m.poissonRatio) / *m.youngsModulus;
    };
    const auto inverseShear = [](const Material& m) {
      return 2.0 * (2.0 - *m.poissonRatio) * (1.0 + *m.poissonRatio) / *m.youngsModulus; // (2 - nu) / G
    };
    t.effectiveYoungsModulus = scene.accuracy.stiffnessScale / (inverse(a) + inverse(b));
    t.effectiveShearModulus = scene.accuracy.stiffnessScale / (inverseShear(a) + inverseShear(b));
  }
  return t;
}

/// A law's parameters for contacts `scale` times as stiff: springs by their unit, collision times and rates
/// of dashpots so that restitution stays (Hertz's dissipation_time has no such rule and stays as it is).
Parameters scaled(const LawKind& kind, Parameters values, double scale) {
  for (const ParameterSpec& spec : kind.parameters) {
    if (spec.type != ParameterType::number || !values.has(spec.name)) continue;
    const double factor = spec.unit == "N/m"                                      ? scale
                          : spec.name == "damping_rate" && kind.name != "viscous" ? std::sqrt(scale)
                          : spec.name == "collision_time"                         ? 1.0 / std::sqrt(scale)
                                                                                  : 1.0;
    values.set(spec.name, factor * values.number(spec.name));
  }
  return values;
}

const Choice& choice(const ContactSpec& contact, LawRole role) {
  switch (role) {
  case LawRole::normal:
    return contact.normal;
  case LawRole::tangential:
    return contact.tangential;
  case LawRole::rolling:
    return contact.rolling;
  default:
    return contact.torsion;
  }
}

const char* roleName(LawRole role) {
  static constexpr const char* names[] = {"normal", "tangential", "rolling", "torsion", "gap"};
  return names[static_cast<int>(role)];
}

} // namespace

LawStack::LawStack(const Scene& scene, bool anySize)
    : materials_(static_cast<int>(scene.materials.size())), stiffnessScale_(scene.accuracy.stiffnessScale),
      fastArithmetic_(scene.accuracy.fastArithmetic), mixed_(scene.accuracy.mixedPrecision) {
  for (const Material& m : scene.materials) {
    const double mass = anySize ? 0.0 : oneMass(scene, m);
    promisedInverseMass_.push_back(mass > 0.0 ? 1.0 / mass : 0.0);
  }
  std::vector<const ContactSpec*> specs;
  for (const Material& a : scene.materials)
    for (const Material& b : scene.materials) {
      specs.push_back(findContact(scene, a.name, b.name));
      context_.types.push_back(pairType(scene, a, b));
      if (!anySize) context_.types.back().uniformMass = uniformMass(scene, a, b);
      context_.types.back().used = context_.types.back().used && specs.back();
      context_.types.back().swapped = specs.back() && specs.back()->first != a.name;
    }
  for (const LawRole role : {LawRole::normal, LawRole::tangential, LawRole::rolling, LawRole::torsion})
    appendRole(role, specs);
  // A gap law acts between the pairs of materials that name it.
  std::vector<std::string> gaps;
  for (const ContactSpec* spec : specs)
    if (spec)
      for (const Choice& g : spec->gap)
        if (std::find(gaps.begin(), gaps.end(), g.kind) == gaps.end()) gaps.push_back(g.kind);
  for (const std::string& name : gaps) {
    const LawKind* kind = findLaw(LawRole::gap, name);
    if (!kind) throw InputError(fmt::format("there is no gap law '{}'", name));
    LawContext context = context_;
    for (std::size_t k = 0; k < specs.size(); ++k) {
      bool named = false;
      if (specs[k])
        for (const Choice& g : specs[k]->gap)
          if (g.kind == name) {
            context.types[k].parameters = g.parameters;
            named = true;
          }
      context.types[k].used = context.types[k].used && named;
    }
    append(kind->make(context), name, LawRole::gap);
  }
  if (!ownTorque_ || anySize) return;
  double mass = 0.0;
  for (const Material& m : scene.materials) {
    if (meanMass(scene, m.name) == 0.0) continue;
    const double here = oneMass(scene, m);
    if (here == 0.0 || (mass > 0.0 && here != mass))
      throw InputError("friction of spins alone is for grains of one size and density");
    mass = here;
  }
}

void LawStack::appendRole(LawRole role, const std::vector<const ContactSpec*>& specs) {
  // Each kind runs over all contacts, with constants of zero, and so without effect, for the pairs of
  // materials that use another.
  std::vector<const LawKind*> kinds, ofPair(specs.size(), nullptr);
  for (std::size_t k = 0; k < specs.size(); ++k) {
    if (!context_.types[k].used) continue;
    const Choice& picked = choice(*specs[k], role);
    const std::string name = picked.kind.empty() ? "none" : picked.kind;
    const LawKind* found = findLaw(role, name);
    if (!found) throw InputError(fmt::format("there is no {} law '{}'", roleName(role), name));
    if (found->needsElasticity && context_.types[k].effectiveYoungsModulus <= 0.0)
      throw InputError(
          fmt::format("the {} law '{}' needs youngs_modulus and poisson_ratio of both '{}' and '{}'",
                      roleName(role), name, specs[k]->first, specs[k]->second));
    if (found->name == "none") continue;
    ofPair[k] = found;
    if (std::find(kinds.begin(), kinds.end(), found) == kinds.end()) kinds.push_back(found);
  }
  for (const LawKind* kind : kinds) {
    LawContext context = context_;
    for (std::size_t k = 0; k < specs.size(); ++k) {
      context.types[k].used = ofPair[k] == kind;
      if (context.types[k].used)
        context.types[k].parameters = scaled(*kind, choice(*specs[k], role).parameters, stiffnessScale_);
    }
    append(kind->make(context), kind->name, role);
    if (ownTorque_ && readsSpin_ && !entries_.back().law->ownTorque() && role != LawRole::normal)
      throw InputError(
          fmt::format("the {} law '{}' cannot go with friction of spins alone", roleName(role), kind->name));
    if (role == LawRole::tangential && entries_.back().law->fullRadiusArm() != fullRadiusArm_)
      throw InputError("all tangential laws of a scene need the same choice of 'arm'");
  }
}

void LawStack::apply(ContactBlock& block, bool couples) const {
  clearForces(block, couples);
  addForces(block);
}

void LawStack::addForces(ContactBlock& block) const {
  if (events_) std::fill_n(block.event, block.size, noEvent);
  for (const Entry& entry : entries_)
    entry.law->apply(block, entry.firstHistory, width_);
}

FusedLaws LawStack::fused(int material) const {
  FusedLaws laws;
  laws.type = typeOf(material, material);
  for (const Entry& entry : entries_)
    entry.law->fuse(laws);
  constexpr LawRole roles[] = {LawRole::normal, LawRole::tangential, LawRole::rolling};
  const bool inTurn = entries_.size() <= 3 &&
                      std::equal(entries_.begin(), entries_.end(), roles,
                                 [](const Entry& entry, LawRole role) { return entry.role == role; });
  if (!inTurn) return {};
  if (entries_.size() < 2) laws.tangential = FusedLaws::Tangential::none;
  if (entries_.size() < 3) laws.rolling = FusedLaws::Rolling::none;
  return laws;
}

void LawStack::add(std::shared_ptr<const Law> law) {
  append(std::move(law), addedName, LawRole::gap);
}

void LawStack::allowAnySize(const Scene& scene) {
  LawStack plain(scene, true);
  for (const Entry& entry : entries_)
    if (entry.name == addedName) plain.add(entry.law);
  plain.width_ = width_;
  plain.sumsOverlaps_ = sumsOverlaps_;
  *this = std::move(plain);
}

void LawStack::append(std::shared_ptr<const Law> law, std::string name, LawRole role) {
  Entry entry{law, std::move(name), role, history_, {}};
  history_ += law->historySize();
  if (history_ > ContactBlock::maxHistory)
    throw InputError(fmt::format("the laws of a scene may keep {} numbers of history per pair; these need {}",
                                 ContactBlock::maxHistory, history_));
  range_ = std::max(range_, law->range());
  reads_ |= law->reads();
  turning_ = turning_ || law->turnsGrains();
  fullRadiusArm_ = fullRadiusArm_ || law->fullRadiusArm();
  readsSpin_ = readsSpin_ || law->readsSpin();
  ownTorque_ = ownTorque_ || law->ownTorque();
  events_ = events_ || (role == LawRole::gap && law->historySize() > 0);
  for (const std::string& quantity : law->grainQuantities()) {
    auto at = std::find(quantityNames_.begin(), quantityNames_.end(), quantity);
    if (at == quantityNames_.end()) at = quantityNames_.insert(quantityNames_.end(), quantity);
    entry.quantities.push_back(static_cast<int>(at - quantityNames_.begin()));
  }
  entries_.push_back(std::move(entry));
}

} // namespace sandglass
