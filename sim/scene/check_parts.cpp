#include "sim/scene/check_parts.h"

#include "sim/base/error.h"
#include "sim/contact/law.h"
#include "sim/scene/suggest.h"
#include "sim/walls/wall_registry.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace sandglass {

namespace {

constexpr const char* axes[] = {"x", "y", "z"};

template <class T> std::vector<std::string> namesOf(const std::vector<T>& all) {
  std::vector<std::string> names;
  for (const auto& t : all)
    names.push_back(t.name);
  return names;
}

/// Reports KEY when it names nothing of that kind.
template <class T>
bool checkReference(const std::string& key, const std::string& name, const std::vector<T>& all,
                    const char* section, FaultList& faults) {
  if (name.empty() || faults.has(key)) return true;
  const auto names = namesOf(all);
  if (std::find(names.begin(), names.end(), "") != names.end())
    return true; // the one with a faulty name may be meant

  if (std::find(names.begin(), names.end(), name) != names.end()) return true;
  faults.wrong(key, fmt::format("but the scene has no [[{}]] '{}'; {}", section, name,
                                suggestion(name, names, "there are")));
  return false;
}

template <class T> void checkNamesOf(const char* section, const std::vector<T>& all, FaultList& faults) {
  std::set<std::string> seen;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string& name = all[i].name;
    const std::string key = partPath(section, name, i) + ".name";
    if (name.empty()) {
      if (!faults.has(partPath(section, name, i))) faults.wrong(key, "but a name must not be empty");
      continue;
    }
    if (name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") !=
        std::string::npos)
      faults.wrong(key, "but names consist of letters, digits, '_' and '-' alone");
    if (!seen.insert(name).second)
      faults.wrong(key, fmt::format("but another [[{}]] has that name already; rename one", section));
  }
}

using Pair = std::pair<std::string, std::string>;
Pair unordered(const std::string& a, const std::string& b) {
  return a < b ? Pair{a, b} : Pair{b, a};
}

std::string contactPath(const ContactSpec& c, std::size_t index) {
  return partPath("contact", c.first.empty() ? "" : c.first + "-" + c.second, index);
}

void checkElasticity(const Scene& scene, const ContactSpec& contact, const std::string& path,
                     FaultList& faults) {
  const LawKind* law = findLaw(LawRole::normal, contact.normal.kind);
  const LawKind* tangential = findLaw(LawRole::tangential, contact.tangential.kind);
  const bool normalNeeds = law && law->needsElasticity,
             tangentialNeeds = tangential && tangential->needsElasticity;
  if (!normalNeeds && !tangentialNeeds) return;
  for (const auto& name : std::set<std::string>{contact.first, contact.second}) {
    const auto m = std::find_if(scene.materials.begin(), scene.materials.end(),
                                [&](const Material& mat) { return mat.name == name; });
    if (m == scene.materials.end() || (m->youngsModulus && m->poissonRatio) || faults.has("material." + name))
      continue;
    faults.about("material." + name,
                 fmt::format("lacks '{}', which the law '{}' of {} needs; add it",
                             m->youngsModulus ? "poisson_ratio" : "youngs_modulus",
                             normalNeeds ? contact.normal.kind : contact.tangential.kind, path));
  }
}

/// Laws say themselves when their parameters contradict each other.
void checkLaw(LawRole role, const Choice& law, const ContactSpec& of, const std::string& path,
              FaultList& faults) {
  const LawKind* kind = findLaw(role, law.kind);
  if (!kind || faults.has(path)) return;
  LawContext context;
  context.types.push_back({.used = true,
                           .parameters = law.parameters,
                           .referenceMass = 1e-6,
                           .largestEffectiveRadius = 1e-3,
                           .materialA = of.first,
                           .materialB = of.second,
                           .effectiveYoungsModulus = 1e9,
                           .effectiveShearModulus = 1e9});
  try {
    kind->make(context);
  } catch (const InputError& problem) {
    faults.about(path, std::string("contradicts itself: ") + problem.what());
  }
}

void checkLawsOf(const ContactSpec& contact, const std::string& path, FaultList& faults) {
  checkLaw(LawRole::normal, contact.normal, contact, path + ".normal", faults);
  checkLaw(LawRole::tangential, contact.tangential, contact, path + ".tangential", faults);
  checkLaw(LawRole::rolling, contact.rolling, contact, path + ".rolling", faults);
  checkLaw(LawRole::torsion, contact.torsion, contact, path + ".torsion", faults);
  for (std::size_t g = 0; g < contact.gap.size(); ++g)
    checkLaw(LawRole::gap, contact.gap[g], contact, fmt::format("{}.gap.{}", path, g + 1), faults);
}

} // namespace

std::string partPath(const char* section, const std::string& name, std::size_t index) {
  return fmt::format("{}.{}", section, name.empty() ? std::to_string(index + 1) : name);
}

void checkDirection(const std::string& key, const Vec3& value, FaultList& faults) {
  if (!faults.has(key) && !(value.norm() > 0))
    faults.wrong(key, "but a direction must not be zero; write for example [0, 0, 1]");
}

void checkBox(const std::string& base, const Vec3& lower, const Vec3& upper, FaultList& faults) {
  if (faults.has(base)) return;
  for (int k = 0; k < 3; ++k)
    if (!(lower[k] < upper[k]))
      faults.wrong(base + ".upper",
                   fmt::format("but it must lie above lower along {} ({} m); exchange or widen them", axes[k],
                               lower[k]));
}

void checkNames(const Scene& scene, FaultList& faults) {
  checkNamesOf("material", scene.materials, faults);
  checkNamesOf("species", scene.species, faults);
  checkNamesOf("wall", scene.walls, faults);
  checkNamesOf("field", scene.fields, faults);
  checkNamesOf("outlet", scene.outlets, faults);
  checkNamesOf("stage", scene.stages, faults);
  checkNamesOf("probe", scene.probes, faults);
}

void checkDomain(const Scene& scene, FaultList& faults) {
  checkBox("domain", scene.domain.lower, scene.domain.upper, faults);
}

void checkMaterials(const Scene& scene, FaultList& faults) {
  for (std::size_t i = 0; i < scene.species.size(); ++i) {
    const Species& s = scene.species[i];
    const std::string key = partPath("species", s.name, i) + ".material";
    if (!checkReference(key, s.material, scene.materials, "material", faults)) continue;
    for (const auto& m : scene.materials)
      if (m.name == s.material && !(m.density > 0) && !faults.has("material." + m.name))
        faults.about("material." + m.name,
                     fmt::format("lacks 'density', which grains of species '{}' need; add for example "
                                 "density = \"2500 kg/m^3\"",
                                 s.name));
  }
  for (std::size_t i = 0; i < scene.walls.size(); ++i)
    checkReference(partPath("wall", scene.walls[i].name, i) + ".material", scene.walls[i].material,
                   scene.materials, "material", faults);
}

void checkContacts(const Scene& scene, FaultList& faults) {
  std::set<Pair> described;
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    const ContactSpec& c = scene.contacts[i];
    const std::string path = contactPath(c, i);
    if (c.first.empty()) continue;
    for (const auto& name : std::set<std::string>{c.first, c.second})
      checkReference(path + ".between", name, scene.materials, "material", faults);
    if (!described.insert(unordered(c.first, c.second)).second)
      faults.about(path,
                   "describes a pair of materials that another [[contact]] describes already; remove one");
    checkElasticity(scene, c, path, faults);
    checkLawsOf(c, path, faults);
  }

  std::set<std::string> grains, walls;
  const auto known = [&](const std::string& name) {
    return std::any_of(scene.materials.begin(), scene.materials.end(),
                       [&](const Material& m) { return m.name == name; });
  };
  for (const auto& s : scene.species)
    if (known(s.material)) grains.insert(s.material);
  for (const auto& w : scene.walls)
    if (known(w.material)) walls.insert(w.material);
  std::set<Pair> wanted;
  for (const auto& a : grains) {
    for (const auto& b : grains)
      wanted.insert(unordered(a, b));
    for (const auto& b : walls)
      wanted.insert(unordered(a, b));
  }
  for (const auto& [a, b] : wanted)
    if (!described.contains({a, b}) && !faults.has("contact"))
      faults.general(fmt::format(
          "the materials '{0}' and '{1}' can meet, but there is no contact between them; add a [[contact]] "
          "with between = [\"{0}\", \"{1}\"]",
          a, b));
}

void checkWallsAndOutlets(const Scene& scene, FaultList& faults) {
  const Eigen::AlignedBox3d space(scene.domain.lower, scene.domain.upper);
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    const WallSpec& wall = scene.walls[i];
    const std::string path = partPath("wall", wall.name, i);
    for (const char* key : {"stage", "until_stage"})
      if (wall.motion.parameters.has(key))
        checkReference(path + ".motion." + key, wall.motion.parameters.text(key), scene.stages, "stage",
                       faults);
    if (faults.has(path) || faults.has("domain")) continue;
    for (const auto& kind : wallKinds())
      if (kind.name == wall.shape.kind && !kind.make(wall.shape.parameters)->bounds().intersects(space) &&
          wall.motion.kind.empty())
        faults.about(path,
                     "lies outside the domain, where no grain can touch it; move it or enlarge the domain");
  }
  for (std::size_t i = 0; i < scene.outlets.size(); ++i)
    checkDirection(partPath("outlet", scene.outlets[i].name, i) + ".normal", scene.outlets[i].normal, faults);
}

void checkStages(const Scene& scene, FaultList& faults) {
  if (scene.stages.empty() && !faults.has("stage"))
    faults.general(
        "there is no [[stage]]; add at least one, such as name = \"run\", until = { duration = \"1 s\" }");
  std::set<std::string> removed;
  for (std::size_t i = 0; i < scene.stages.size(); ++i) {
    const StageSpec& stage = scene.stages[i];
    const std::string path = partPath("stage", stage.name, i);
    for (const auto& wall : stage.removeWalls) {
      if (!checkReference(path + ".remove_walls", wall, scene.walls, "wall", faults)) continue;
      if (!removed.insert(wall).second)
        faults.wrong(path + ".remove_walls",
                     fmt::format("but the wall '{}' is removed already; leave it out here", wall));
    }
    if (faults.has(path)) continue;
    const bool needsOutlet =
        stage.untilEmpty || stage.massDischarged || stage.quietTime || stage.recirculations;
    if (!stage.duration && !stage.settledKineticEnergy && !stage.settledSpeed && !needsOutlet)
      faults.about(path, "never ends; add an end condition, such as until = { duration = \"1 s\" }");
    if (needsOutlet && scene.outlets.empty() && !stage.duration && !faults.has("outlet"))
      faults.about(path + ".until",
                   "waits for grains to leave, but the scene has no [[outlet]]; add one or a duration");
    if (stage.duration && stage.settledAfter > *stage.duration)
      faults.wrong(path + ".until.settled_after",
                   fmt::format("but the stage ends after {} s; shorten it", *stage.duration));
  }
}

void checkProbes(const Scene& scene, FaultList& faults) {
  for (std::size_t i = 0; i < scene.probes.size(); ++i) {
    const ProbeSpec& probe = scene.probes[i];
    const std::string path = partPath("probe", probe.name, i);
    if (faults.has(path)) continue;
    const Parameters& p = probe.what.parameters;
    if (probe.what.kind == "mass_in_region") checkBox(path, p.vector("lower"), p.vector("upper"), faults);
    if (probe.what.kind == "flow_rate") checkDirection(path + ".normal", p.vector("normal"), faults);
    if (probe.what.kind == "wall_force")
      checkReference(path + ".wall", p.text("wall"), scene.walls, "wall", faults);
  }
}

void checkTimes(const Scene& scene, FaultList& faults) {
  if (!scene.accuracy.timeStep || faults.has("accuracy.time_step")) return;
  const double step = *scene.accuracy.timeStep;
  const auto report = [&](const std::string& rule) { faults.wrong("accuracy.time_step", rule); };
  for (const auto& c : scene.contacts) {
    const double contact = c.normal.parameters.number("collision_time", 0);
    if (contact > 0 && step > contact / 5)
      return report(fmt::format(
          "but must not be above {:.4g} s, a fifth of the collision time between '{}' and '{}'; lower it",
          contact / 5, c.first, c.second));
  }
  for (const auto& s : scene.stages)
    if (s.duration && step > *s.duration)
      return report(fmt::format("but stage '{}' lasts only {} s; lower it", s.name, *s.duration));
  if (scene.output.frameInterval > 0 && step > scene.output.frameInterval)
    return report(fmt::format("but frames are due every {} s; lower it", scene.output.frameInterval));
  for (const auto& p : scene.probes)
    if (p.interval > 0 && step > p.interval)
      return report(fmt::format("but the probe '{}' is due every {} s; lower it", p.name, p.interval));
}

} // namespace sandglass
