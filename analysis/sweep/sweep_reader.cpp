// SWEEP.toml, read strictly.

#include "analysis/sweep/sweep_plan.h"
#include "analysis/vortex/vortex_knobs.h"
#include "sim/base/error.h"
#include "sim/scene/table_reader.h"
#include "sim/scene/units.h"

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>

namespace sandglass::analysis {

namespace {

namespace fs = std::filesystem;
using Specs = std::vector<ParameterSpec>;

ParameterSpec text(const char* name, const char* description, std::string fallback,
                   std::vector<std::string> choices = {}) {
  return {.name = name,
          .type = ParameterType::text,
          .unit = "1",
          .description = description,
          .fallback = std::move(fallback),
          .choices = std::move(choices)};
}

ParameterSpec whole(const char* name, const char* description, std::int64_t fallback, double least,
                    double most) {
  return {.name = name,
          .type = ParameterType::integer,
          .unit = "1",
          .description = description,
          .fallback = fallback,
          .minimum = least,
          .maximum = most};
}

const Specs& planSpecs() {
  static const Specs specs{
      text("title", "one line", ""),
      text("scene", "file of the scene that all runs have in common, from the folder of this file", ""),
      {.name = "set",
       .type = ParameterType::texts,
       .unit = "1",
       .description = "changes to it, as --set takes them",
       .fallback = std::vector<std::string>{}},
      text("sampling", "how points are chosen", "grid", {"grid", "random", "latin_hypercube"}),
      whole("points", "of random and latin_hypercube sampling", 0, 0, 1e7),
      whole("sampling_seed", "of their random numbers", 1, 0, 9e15),
      {.name = "sample_interval",
       .type = ParameterType::number,
       .unit = "s",
       .description = "between the frames that states are told from; the scene's frames when left out",
       .optional = true,
       .minimum = 0,
       .openMinimum = true},
      text("states", "which states to tell", "auto", {"auto", "vortex", "none"}),
      {.name = "state_map",
       .type = ParameterType::boolean,
       .unit = "1",
       .description = "also shares of solid, liquid and gas at the end",
       .fallback = false}};
  return specs;
}

bool isName(const std::string& name) {
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name.front()))) return false;
  return std::all_of(name.begin(), name.end(),
                     [](char c) { return c == '_' || std::isalnum(static_cast<unsigned char>(c)); });
}

class SweepReader {
public:
  SweepReader(const Value& root, const std::string& file, FaultList& faults)
      : top_(*root.table(), "", faults), file_(file), faults_(faults) {}

  SweepPlan read() {
    Parameters p;
    top_.read(planSpecs(), p);
    plan_.file = file_;
    if (faults_.empty()) {
      plan_.title = p.text("title");
      plan_.sceneFile = p.text("scene");
      plan_.set = p.texts("set");
      const std::string& how = p.text("sampling");
      plan_.sampling = how == "grid"     ? SweepSampling::grid
                       : how == "random" ? SweepSampling::random
                                         : SweepSampling::latinHypercube;
      plan_.points = static_cast<std::size_t>(p.integer("points"));
      plan_.samplingSeed = static_cast<std::uint64_t>(p.integer("sampling_seed"));
      plan_.sampleInterval = p.number("sample_interval", 0);
      plan_.states = p.text("states");
      plan_.stateMap = p.boolean("state_map");
    }
    readSeeds();
    for (const auto& [table, path] : top_.subtables("axis"))
      readAxis(*table, path);
    for (const auto& [table, path] : top_.subtables("derived"))
      readDerived(*table, path);
    if (const ValueTable* table = top_.subtable("refine")) readRefine(*table);
    static const ValueTable none;
    const ValueTable* thresholds = top_.subtable("thresholds");
    TableReader in(thresholds ? *thresholds : none, "thresholds", faults_);
    in.read(vortexKnobs(), plan_.thresholds);
    in.reportUnknown();
    top_.reportUnknown();
    check();
    return std::move(plan_);
  }

private:
  bool gridded() const { return plan_.sampling == SweepSampling::grid; }

  /// A number of seeds, or a list of them. An empty list stands for as many of the scene's: filled in later.
  void readSeeds() {
    const Value* value = top_.take("seeds");
    seedCount = 1;
    if (!value) return;
    if (const auto* count = std::get_if<std::int64_t>(&value->data);
        count && *count >= 1 && *count <= 100000) {
      seedCount = static_cast<std::size_t>(*count);
      return;
    }
    const auto* list = value->list();
    bool sound = list && !list->empty();
    for (std::size_t k = 0; sound && k < list->size(); ++k) {
      const auto* seed = std::get_if<std::int64_t>(&(*list)[k].data);
      sound = seed && *seed >= 0;
      if (sound) plan_.seeds.push_back(static_cast<std::uint64_t>(*seed));
    }
    if (sound) sound = std::set(plan_.seeds.begin(), plan_.seeds.end()).size() == plan_.seeds.size();
    if (!sound)
      faults_.wrong("seeds", "but a number of seeds from 1 to 100000 is due, or a list of different whole "
                             "numbers from 0");
  }

  std::vector<std::string> readKeys(TableReader& in) {
    std::vector<std::string> keys;
    const Value *one = in.take("key"), *many = in.take("keys");
    const auto add = [&](const Value& value, const char* name) {
      if (value.text() && !value.text()->empty() && value.text()->find('=') == std::string::npos)
        keys.push_back(*value.text());
      else
        faults_.wrong(in.pathOf(name),
                      "but a key of the scene is due, such as \"species.bead.size.diameter\"");
    };
    if (one) add(*one, "key");
    if (many && !many->list()) faults_.wrong(in.pathOf("keys"), "but a list of keys of the scene is due");
    if (many && many->list())
      for (const auto& value : *many->list())
        add(value, "keys");
    return keys;
  }

  std::string readName(TableReader& in) {
    Parameters p;
    in.read(
        {{.name = "name", .type = ParameterType::text, .unit = "1", .description = "column of the table"}},
        p);
    if (!p.has("name")) return "";
    const std::string name = p.text("name");
    if (!isName(name))
      faults_.wrong(in.pathOf("name"), "but must be letters, digits and _, and not begin with a digit");
    else if (name == "pi" || !names_.insert(name).second)
      faults_.wrong(in.pathOf("name"), "which is taken already");
    return name;
  }

  std::string readUnit(const std::string& unit, TableReader& in) {
    try {
      if (unit != "1") parseQuantity("1 " + unit, unit);
      return unit;
    } catch (const Error&) {
      faults_.wrong(in.pathOf("unit"), "which is not a known unit; write one such as \"mm\", or \"1\"");
      return "1";
    }
  }

  /// A number in the axis's unit, bare or with a unit of its own.
  std::optional<double> number(const Value& value, const std::string& unit, const std::string& key) {
    if (const auto* n = std::get_if<std::int64_t>(&value.data)) return static_cast<double>(*n);
    if (const auto* x = std::get_if<double>(&value.data); x && std::isfinite(*x)) return *x;
    if (const auto* quantity = value.text()) {
      try {
        return parseQuantity(*quantity, unit);
      } catch (const InputError& e) {
        faults_.wrong(key, e.what());
        return std::nullopt;
      }
    }
    faults_.wrong(key, fmt::format("but a number is due, in {} or with a unit", unit));
    return std::nullopt;
  }

  void readAxis(const ValueTable& table, const std::string& path) {
    TableReader in(table, path, faults_);
    SweepAxis axis;
    axis.name = readName(in);
    axis.keys = readKeys(in);
    Parameters p;
    in.read({text("unit", "of its numbers, here and in the table", "1"),
             text("scale", "of from, to, count", "linear", {"linear", "log"})},
            p);
    if (p.has("unit")) axis.unit = readUnit(p.text("unit"), in);
    axis.logarithmic = p.has("scale") && p.text("scale") == "log";
    const Value *values = in.take("values"), *from = in.take("from"), *to = in.take("to"),
                *count = in.take("count");
    in.reportUnknown();
    if (values && (from || to || count))
      faults_.about(path, "has both values and from, to or count; one of them is due");
    else if (values)
      readValues(*values, axis, in);
    else
      readSpan(from, to, count, axis, in);
    if (axis.logarithmic)
      for (const double x : axis.numbers)
        if (x <= 0) {
          faults_.about(path,
                        fmt::format("has the value {} on a logarithmic scale, which has none but positive "
                                    "numbers",
                                    x));
          break;
        }
    plan_.axes.push_back(std::move(axis));
  }

  void readValues(const Value& values, SweepAxis& axis, TableReader& in) {
    const std::string key = in.pathOf("values");
    const auto* list = values.list();
    if (!list || list->empty()) return faults_.wrong(key, "but a list of numbers or texts is due");
    bool texts = axis.unit == "1";
    for (const auto& v : *list)
      texts = texts && v.text();
    for (const auto& v : *list)
      if (texts)
        axis.texts.push_back(*v.text());
      else if (const auto x = number(v, axis.unit, key))
        axis.numbers.push_back(*x);
    const bool twice = texts
                           ? std::set(axis.texts.begin(), axis.texts.end()).size() != axis.texts.size()
                           : std::set(axis.numbers.begin(), axis.numbers.end()).size() != axis.numbers.size();
    if (twice) faults_.wrong(key, "in which a value stands twice");
    if (!gridded() && !texts && list->size() != 2)
      faults_.wrong(key, "but without a grid an axis has two limits, from and to");
  }

  void readSpan(const Value* from, const Value* to, const Value* count, SweepAxis& axis, TableReader& in) {
    if (!from || !to || (gridded() && !count))
      return faults_.about(in.path(), gridded() ? "lacks values, or from, to and count"
                                                : "lacks from and to, the limits of the samples");
    const auto low = number(*from, axis.unit, in.pathOf("from")),
               high = number(*to, axis.unit, in.pathOf("to"));
    if (!low || !high) return;
    if (*low == *high) return faults_.about(in.path(), "has equal from and to");
    if (!gridded()) {
      axis.numbers = {*low, *high};
      if (count) faults_.wrong(in.pathOf("count"), "which only a grid has; the samples are the key 'points'");
      return;
    }
    const auto* n = std::get_if<std::int64_t>(&count->data);
    if (!n || *n < 2 || *n > 100000)
      return faults_.wrong(in.pathOf("count"), "but a whole number from 2 to 100000 is due");
    for (std::int64_t i = 0; i < *n; ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(*n - 1);
      axis.numbers.push_back(i == 0        ? *low
                             : i == *n - 1 ? *high
                             : axis.logarithmic
                                 ? std::exp(std::log(*low) + share * (std::log(*high) - std::log(*low)))
                                 : *low + share * (*high - *low));
    }
  }

  void readDerived(const ValueTable& table, const std::string& path) {
    TableReader in(table, path, faults_);
    SweepDerived d;
    d.name = readName(in);
    d.keys = readKeys(in);
    Parameters p;
    in.read({text("unit", "of the value", "1"),
             {.name = "value", .type = ParameterType::text, .unit = "1", .description = "an expression"},
             {.name = "whole",
              .type = ParameterType::boolean,
              .unit = "1",
              .description = "round to the nearest whole number",
              .fallback = false}},
            p);
    in.reportUnknown();
    if (p.has("unit")) d.unit = readUnit(p.text("unit"), in);
    if (p.has("value")) d.expression = p.text("value");
    if (p.has("whole")) d.whole = p.boolean("whole");
    plan_.derived.push_back(std::move(d));
  }

  void readRefine(const ValueTable& table) {
    TableReader in(table, "refine", faults_);
    Parameters p;
    in.read({whole("levels", "how often to halve the distance of neighbours that disagree", 1, 1, 12),
             text("by", "column that neighbours are compared by", "state"),
             {.name = "difference",
              .type = ParameterType::number,
              .unit = "1",
              .description = "of a column of numbers: what is still alike",
              .fallback = 0.0,
              .minimum = 0}},
            p);
    in.reportUnknown();
    if (p.has("levels")) plan_.refineLevels = static_cast<int>(p.integer("levels"));
    if (p.has("by")) plan_.refineBy = p.text("by");
    if (p.has("difference")) plan_.refineDifference = p.number("difference");
    if (!gridded()) faults_.about("refine", "needs a grid, whose points have neighbours");
  }

  void check() {
    if (faults_.empty() && plan_.sceneFile.empty())
      faults_.general("the key 'scene' is missing; it names the scene that all runs have in common");
    if (plan_.axes.empty() && !faults_.has("axis"))
      faults_.general("there is no [[axis]]; a sweep needs at least one");
    if (!gridded() && plan_.points == 0)
      faults_.general("random and latin_hypercube sampling need the key 'points'");
    if (gridded() && plan_.points > 0)
      faults_.wrong("points", "which a grid does not have: its axes say how many points there are");
    double size = 1;
    for (const auto& axis : plan_.axes)
      size *= static_cast<double>(axis.size());
    if (gridded() && size > 1e7)
      faults_.general(fmt::format("the grid has {:.3g} points; at most ten million are allowed", size));
  }

  TableReader top_;
  std::string file_;
  FaultList& faults_;
  SweepPlan plan_;
  std::set<std::string> names_{"id",   "point", "level",  "lattice", "scene",
                               "seed", "run",   "status", "fault",   "replicate"};

public:
  std::size_t seedCount = 1;
};

std::string contentOf(const fs::path& file, const char* what) {
  std::ifstream in(file, std::ios::binary);
  if (!in || fs::is_directory(file))
    throw InputError(fmt::format("{}: {} cannot be opened; check the path", file.string(), what));
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

} // namespace

SweepPlan parseSweep(const std::string& text, const std::string& nameForMessages, const fs::path& folder,
                     const std::optional<std::string>& sceneText) {
  const Value root = parseDocument(text, nameForMessages);
  FaultList faults(nameForMessages);
  SweepReader reader(root, nameForMessages, faults);
  SweepPlan plan = reader.read();
  faults.throwIfAny();
  plan.text = text;
  fs::path scene = folder / plan.sceneFile;
  if (!sceneText && fs::is_directory(scene)) scene /= "scene.toml";
  plan.sceneFile = scene.lexically_normal().string();
  plan.sceneText = sceneText ? *sceneText : contentOf(scene, "the scene of the sweep");
  if (plan.seeds.empty()) {
    // Values of axes may be what makes the scene sound, so its seed is looked up in the document.
    const Value document = parseDocument(plan.sceneText, plan.sceneFile);
    const Value* seed = document.find("seed");
    const auto* first = seed ? std::get_if<std::int64_t>(&seed->data) : nullptr;
    for (std::size_t k = 0; k < reader.seedCount; ++k)
      plan.seeds.push_back(static_cast<std::uint64_t>(first && *first >= 0 ? *first : 1) + k);
  }
  if (plan.sampling == SweepSampling::grid) { // expressions are tried on the first values
    std::vector<SweepValue> first;
    for (const auto& axis : plan.axes)
      first.push_back(axis.isText() ? SweepValue(axis.texts.front()) : SweepValue(axis.numbers.front()));
    deriveValues(plan, first);
  }
  return plan;
}

SweepPlan readSweep(const fs::path& file) {
  const fs::path path = fs::is_directory(file) ? file / "SWEEP.toml" : file;
  const auto folder = path.parent_path();
  return parseSweep(contentOf(path, "the sweep's file"), path.string(), folder.empty() ? "." : folder);
}

} // namespace sandglass::analysis
