#include "sim/scene/scene_reader.h"

#include "sim/base/error.h"
#include "sim/contact/law_registry.h"
#include "sim/fields/field.h" // for the result of FieldKind::make
#include "sim/fields/field_registry.h"
#include "sim/fields/flow_file.h"
#include "sim/grains/fill_registry.h"
#include "sim/grains/size_distribution.h"
#include "sim/scene/grain_rows.h"
#include "sim/scene/probe_registry.h"
#include "sim/scene/scene_sections.h"
#include "sim/scene/table_reader.h"
#include "sim/walls/mesh_file.h"
#include "sim/walls/wall_motion.h"
#include "sim/walls/wall_registry.h"

namespace sandglass {

namespace {

std::vector<LawKind> lawsOf(LawRole role) {
  std::vector<LawKind> all;
  for (const auto& kind : lawKinds())
    if (kind.role == role) all.push_back(kind);
  return all;
}

template <class Spec> void readKeys(TableReader& in, const Keys& keys, Spec& spec) {
  Parameters values;
  in.read(keys, values);
  load(values, spec);
}

class SceneReader {
public:
  SceneReader(const Value& root, std::string baseFolder, FaultList& faults)
      : top_(*root.table(), "", faults), baseFolder_(std::move(baseFolder)), faults_(faults) {}

  Scene read() {
    readKeys(top_, sceneKeys(), scene_);
    readTable("domain", domainKeys(), scene_.domain, true);
    if (top_.subtable("wedge")) readTable("wedge", wedgeKeys(), scene_.wedge.emplace(), false);
    for (const auto& [table, path] : top_.subtables("material"))
      readMaterial(*table, path);
    for (const auto& [table, path] : top_.subtables("contact"))
      readContact(*table, path);
    for (const auto& [table, path] : top_.subtables("species"))
      readSpecies(*table, path);
    for (const auto& [table, path] : top_.subtables("wall"))
      readWall(*table, path);
    for (const auto& [table, path] : top_.subtables("field"))
      readField(*table, path);
    for (const auto& [table, path] : top_.subtables("outlet"))
      readOutlet(*table, path);
    for (const auto& [table, path] : top_.subtables("stage"))
      readStage(*table, path);
    for (const auto& [table, path] : top_.subtables("event", false))
      readEvent(*table, path);
    for (const auto& [table, path] : top_.subtables("fill", false))
      readFill(*table, path);
    for (const auto& [table, path] : top_.subtables("probe"))
      readProbe(*table, path);
    readTable("output", outputKeys(), scene_.output, false);
    readTable("accuracy", accuracyKeys(), scene_.accuracy, false);
    top_.reportUnknown();
    return std::move(scene_);
  }

private:
  template <class Spec> void readTable(const char* key, const Keys& keys, Spec& spec, bool required) {
    static const ValueTable none;
    const ValueTable* table = top_.subtable(key);
    if (!table && required) {
      if (!faults_.has(key))
        faults_.general(fmt::format("the table [{}] is missing; add it with its keys lower and upper", key),
                        key);
      return;
    }
    TableReader in(table ? *table : none, key, faults_);
    readKeys(in, keys, spec);
    in.reportUnknown();
  }

  void readMaterial(const ValueTable& table, const std::string& path) {
    TableReader in(table, path, faults_);
    readKeys(in, materialKeys(), scene_.materials.emplace_back());
    in.reportUnknown();
  }

  /// A law in a table of its own; "none" when the scene leaves out one that has such a kind.
  void readLaw(TableReader& parent, const char* key, LawRole role, Choice& law) {
    const ValueTable* table = parent.subtable(key);
    if (!table) {
      if (findLaw(role, "none"))
        law.kind = "none";
      else if (!faults_.has(parent.pathOf(key)))
        faults_.about(parent.path(),
                      fmt::format("lacks the key '{}'; a law is due, such as {} = {{ law = \"{}\", … }}", key,
                                  key, lawsOf(role).front().name));
      return;
    }
    TableReader in(*table, parent.pathOf(key), faults_);
    in.choose("law", lawsOf(role), law);
    in.reportUnknown();
  }

  void readContact(const ValueTable& table, const std::string& path) {
    ContactSpec& contact = scene_.contacts.emplace_back();
    TableReader in(table, path, faults_);
    readKeys(in, contactKeys(), contact);
    if (contact.first.empty() && !faults_.has(path + ".between") && in.take("between"))
      faults_.wrong(path + ".between", "but must name two materials, such as [\"glass\", \"glass\"]");
    readLaw(in, "normal", LawRole::normal, contact.normal);
    readLaw(in, "tangential", LawRole::tangential, contact.tangential);
    readLaw(in, "rolling", LawRole::rolling, contact.rolling);
    readLaw(in, "torsion", LawRole::torsion, contact.torsion);
    for (const auto& [lawTable, lawPath] : in.subtables("gap", false)) {
      TableReader law(*lawTable, lawPath, faults_);
      law.choose("law", lawsOf(LawRole::gap), contact.gap.emplace_back());
      law.reportUnknown();
    }
    in.reportUnknown();
  }

  void readSpecies(const ValueTable& table, const std::string& path) {
    Species& species = scene_.species.emplace_back();
    TableReader in(table, path, faults_);
    readKeys(in, speciesKeys(), species);
    if (const ValueTable* size = in.subtable("size")) {
      TableReader sizeIn(*size, path + ".size", faults_);
      const SizeKind* kind = sizeIn.choose("distribution", sizeKinds(), species.size);
      sizeIn.reportUnknown();
      if (kind && !faults_.has(path + ".size")) tryToMake(*kind, species.size, path + ".size");
    } else if (!faults_.has(path + ".size")) {
      faults_.about(path, "lacks the key 'size'; write for example size = { distribution = \"single\", "
                          "diameter = \"3 mm\" }");
    }
    in.reportUnknown();
  }

  void readWall(const ValueTable& table, const std::string& path) {
    WallSpec& wall = scene_.walls.emplace_back();
    TableReader in(table, path, faults_);
    readKeys(in, wallKeys(), wall);
    const WallKind* kind = in.choose("kind", wallKinds(), wall.shape);
    if (const ValueTable* motion = in.subtable("motion")) {
      TableReader motionIn(*motion, path + ".motion", faults_);
      const MotionKind* how = motionIn.choose("kind", motionKinds(), wall.motion);
      motionIn.reportUnknown();
      if (how && !faults_.has(path + ".motion")) tryToMake(*how, wall.motion, path + ".motion");
    }
    in.reportUnknown();
    if (kind && wall.shape.parameters.has("file") && !faults_.has(path)) {
      try {
        wall.shape.parameters = meshFromFile(wall.shape.parameters, baseFolder_);
      } catch (const InputError& problem) {
        faults_.about(path, std::string("has no mesh: ") + problem.what());
      }
    }
    if (kind && !faults_.has(path)) tryToMake(*kind, wall.shape, path);
  }

  template <class Kind> void tryToMake(const Kind& kind, const Choice& choice, const std::string& path) {
    try {
      kind.make(choice.parameters);
    } catch (const InputError& problem) {
      faults_.about(path, std::string("contradicts itself: ") + problem.what());
    }
  }

  void readField(const ValueTable& table, const std::string& path) {
    FieldSpec& field = scene_.fields.emplace_back();
    TableReader in(table, path, faults_);
    readKeys(in, fieldKeys(), field);
    const FieldKind* kind = in.choose("kind", fieldKinds(), field.what);
    in.reportUnknown();
    if (kind && field.what.parameters.has("file") && !faults_.has(path)) {
      try {
        field.what.parameters = flowFromFile(field.what.parameters, baseFolder_);
      } catch (const InputError& problem) {
        faults_.about(path, std::string("has no wind: ") + problem.what());
      }
    }
    if (kind && !faults_.has(path)) tryToMake(*kind, field.what, path);
  }

  void readOutlet(const ValueTable& table, const std::string& path) {
    OutletSpec& outlet = scene_.outlets.emplace_back();
    TableReader in(table, path, faults_);
    readKeys(in, outletKeys(), outlet);
    if (const ValueTable* recycle = in.subtable("recycle")) {
      TableReader recycleIn(*recycle, path + ".recycle", faults_);
      readKeys(recycleIn, recycleKeys(), outlet.recycle.emplace());
      recycleIn.reportUnknown();
    }
    in.reportUnknown();
  }

  void readStage(const ValueTable& table, const std::string& path) {
    StageSpec& stage = scene_.stages.emplace_back();
    TableReader in(table, path, faults_);
    readKeys(in, stageKeys(), stage);
    if (const ValueTable* until = in.subtable("until")) {
      TableReader untilIn(*until, path + ".until", faults_);
      readKeys(untilIn, untilKeys(), stage);
      untilIn.reportUnknown();
    }
    in.reportUnknown();
  }

  void readEvent(const ValueTable& table, const std::string& path) {
    TableReader in(table, path, faults_);
    readKeys(in, eventKeys(), scene_.events.emplace_back());
    in.reportUnknown();
  }

  void readFill(const ValueTable& table, const std::string& path) {
    FillSpec& fill = scene_.fills.emplace_back();
    TableReader in(table, path, faults_);
    readKeys(in, fillKeys(), fill);
    if (fill.stage.empty() && !scene_.stages.empty()) fill.stage = scene_.stages.front().name;
    const FillKind* kind = in.choose("kind", fillKinds(), fill.how);
    if (kind && kind->name == "list")
      readGrainRows(in, scene_.species, baseFolder_, fill);
    else if (kind)
      readMixture(in, fill);
    in.reportUnknown();
  }

  void readMixture(TableReader& in, FillSpec& fill) {
    const bool oneSpecies = !fill.mixture.empty();
    const auto shares = in.subtables("mixture", false);
    for (const auto& [table, path] : shares) {
      TableReader shareIn(*table, path, faults_);
      readKeys(shareIn, shareKeys(), fill.mixture.emplace_back());
      shareIn.reportUnknown();
    }
    if (oneSpecies && !shares.empty())
      faults_.about(in.path(), "has both 'species' and 'mixture'; give one of them");
    if (fill.mixture.empty() && !faults_.has(in.path()))
      faults_.about(
          in.path(),
          "names no grains; give species = \"…\" or mixture = [{ species = \"…\", fraction = 0.5 }, …]");
  }

  void readProbe(const ValueTable& table, const std::string& path) {
    ProbeSpec& probe = scene_.probes.emplace_back();
    TableReader in(table, path, faults_);
    readKeys(in, probeKeys(), probe);
    in.choose("kind", probeKinds(), probe.what);
    in.reportUnknown();
  }

  TableReader top_;
  std::string baseFolder_;
  FaultList& faults_;
  Scene scene_;
};

} // namespace

Scene readSceneDocument(const Value& root, const std::string& baseFolder, FaultList& faults) {
  return SceneReader(root, baseFolder, faults).read();
}

} // namespace sandglass
