// The resolved scene as TOML. Numbers are written as the shortest text that reads back to the same bits.
#include "sim/scene/scene_writer.h"

#include "sim/contact/law_registry.h"
#include "sim/fields/field_registry.h"
#include "sim/grains/fill_registry.h"
#include "sim/grains/size_distribution.h"
#include "sim/scene/probe_registry.h"
#include "sim/scene/scene_sections.h"
#include "sim/scene/units.h"
#include "sim/walls/wall_motion.h"
#include "sim/walls/wall_registry.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>

namespace sandglass {

namespace {

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      out += fmt::format("\\{}", c);
    else if (c == '\n')
      out += "\\n";
    else if (c == '\t')
      out += "\\t";
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      out += fmt::format("\\u{:04X}", static_cast<int>(c));
    else
      out += c;
  }
  return out + "\"";
}

std::string number(double value, const std::string& unit) {
  const std::string text = quantityText(value, unit.empty() ? "1" : unit);
  return unit.empty() || unit == "1" ? text : quoted(text);
}

template <class List, class F> std::string list(const List& values, F element) {
  std::string all;
  for (const auto& v : values)
    all += (all.empty() ? "" : ", ") + element(v);
  return "[" + all + "]";
}

std::string vector(const Vec3& v, const std::string& unit) {
  return list(std::array{v.x(), v.y(), v.z()}, [&](double c) { return number(c, unit); });
}

} // namespace

std::string valueText(const ParameterValue& value, const std::string& unit) {
  struct Printer {
    const std::string& unit;
    std::string operator()(double v) const { return number(v, unit); }
    std::string operator()(std::int64_t v) const { return fmt::format("{}", v); }
    std::string operator()(bool v) const { return v ? "true" : "false"; }
    std::string operator()(const std::string& v) const { return quoted(v); }
    std::string operator()(const Vec3& v) const { return vector(v, unit); }
    std::string operator()(const std::vector<double>& v) const {
      return list(v, [&](double c) { return number(c, unit); });
    }
    std::string operator()(const std::vector<Vec3>& v) const {
      return list(v, [&](const Vec3& c) { return vector(c, unit); });
    }
    std::string operator()(const std::vector<std::string>& v) const { return list(v, quoted); }
  };
  return std::visit(Printer{unit}, value);
}

namespace {

using Lines = std::vector<std::string>; ///< "key = value"

Lines lines(const Keys& keys, const Parameters& values) {
  Lines all;
  for (const auto& key : keys)
    if (values.has(key.name))
      all.push_back(key.name + " = " + valueText(values.all().at(key.name), key.unit));
  return all;
}

/// The selector and the parameters of a chosen kind.
template <class Kind>
Lines lines(const std::string& selector, const std::vector<Kind>& kinds, const Choice& choice) {
  Lines all{selector + " = " + quoted(choice.kind)};
  for (const auto& kind : kinds)
    if (kind.name == choice.kind) {
      const Lines more = lines(kind.parameters, choice.parameters);
      all.insert(all.end(), more.begin(), more.end());
      break;
    }
  return all;
}

Lines& append(Lines& all, const Lines& more) {
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

std::string inlineTable(const Lines& all) {
  return "{ " + fmt::format("{}", fmt::join(all, ", ")) + " }";
}

std::string lawTable(LawRole role, const Choice& choice) {
  const LawKind* kind = findLaw(role, choice.kind);
  return inlineTable(lines("law", kind ? std::vector<LawKind>{*kind} : std::vector<LawKind>{}, choice));
}

std::string grainRows(const Parameters& p) {
  std::string rows = "[\n";
  const auto& names = p.texts("species");
  for (std::size_t i = 0; i < names.size(); ++i)
    rows += fmt::format("  {{ species = {}, diameter = {}, position = {}, velocity = {}, spin = {} }},\n",
                        quoted(names[i]), number(p.numbers("diameters")[i], "m"),
                        vector(p.vectors("positions")[i], "m"), vector(p.vectors("velocities")[i], "m/s"),
                        vector(p.vectors("spins")[i], "rad/s"));
  return rows + "]";
}

class Writer {
public:
  explicit Writer(const Scene& scene) : scene_(scene) {}

  std::string write(bool withTexts) {
    Parameters root = store(scene_);
    if (!withTexts) {
      root.set("title", std::string());
      root.set("description", std::string());
    }
    emit("", lines(sceneKeys(), root));
    emit("[domain]", lines(domainKeys(), store(scene_.domain)));
    if (scene_.wedge) emit("[wedge]", lines(wedgeKeys(), store(*scene_.wedge)));
    for (const auto& m : scene_.materials)
      emit("[[material]]", lines(materialKeys(), store(m)));
    for (const auto& c : scene_.contacts)
      emit("[[contact]]", contact(c));
    for (const auto& s : scene_.species) {
      Lines all = lines(speciesKeys(), store(s));
      all.push_back("size = " + inlineTable(lines("distribution", sizeKinds(), s.size)));
      emit("[[species]]", all);
    }
    for (const auto& w : scene_.walls) {
      Lines all = lines(wallKeys(), store(w));
      append(all, lines("kind", wallKinds(), w.shape));
      if (!w.motion.kind.empty())
        all.push_back("motion = " + inlineTable(lines("kind", motionKinds(), w.motion)));
      emit("[[wall]]", all);
    }
    for (const auto& f : scene_.fields) {
      Lines all = lines(fieldKeys(), store(f));
      emit("[[field]]", append(all, lines("kind", fieldKinds(), f.what)));
    }
    for (const auto& o : scene_.outlets) {
      Lines all = lines(outletKeys(), store(o));
      if (o.recycle) all.push_back("recycle = " + inlineTable(lines(recycleKeys(), store(*o.recycle))));
      emit("[[outlet]]", all);
    }
    for (const auto& f : scene_.fills)
      emit("[[fill]]", fill(f));
    for (const auto& s : scene_.stages) {
      Lines all = lines(stageKeys(), store(s));
      all.push_back("until = " + inlineTable(lines(untilKeys(), storeUntil(s))));
      emit("[[stage]]", all);
    }
    for (const auto& e : scene_.events)
      emit("[[event]]", lines(eventKeys(), store(e)));
    for (const auto& p : scene_.probes) {
      Lines all = lines(probeKeys(), store(p));
      emit("[[probe]]", append(all, lines("kind", probeKinds(), p.what)));
    }
    emit("[output]", lines(outputKeys(), store(scene_.output)));
    emit("[accuracy]", lines(accuracyKeys(), store(scene_.accuracy)));
    return text_;
  }

private:
  static Lines contact(const ContactSpec& c) {
    Lines all = lines(contactKeys(), store(c));
    all.push_back("normal = " + lawTable(LawRole::normal, c.normal));
    all.push_back("tangential = " + lawTable(LawRole::tangential, c.tangential));
    all.push_back("rolling = " + lawTable(LawRole::rolling, c.rolling));
    if (!c.torsion.kind.empty()) all.push_back("torsion = " + lawTable(LawRole::torsion, c.torsion));
    if (!c.gap.empty())
      all.push_back("gap = " + list(c.gap, [](const Choice& law) { return lawTable(LawRole::gap, law); }));
    return all;
  }

  static Lines fill(const FillSpec& f) {
    Lines all = lines("kind", fillKinds(), f.how);
    append(all, lines(fillKeys(), store(f)));
    if (f.how.kind == "list")
      all.push_back("grains = " + grainRows(f.how.parameters));
    else
      all.push_back("mixture = " + list(f.mixture, [](const Share& s) {
                      return inlineTable(lines(shareKeys(), store(s)));
                    }));
    return all;
  }

  void emit(const std::string& header, const Lines& all) {
    if (!header.empty()) text_ += "\n" + header + "\n";
    for (const auto& line : all)
      text_ += line + "\n";
  }

  const Scene& scene_;
  std::string text_;
};

} // namespace

std::string sceneText(const Scene& scene, bool withTexts) {
  return Writer(scene).write(withTexts);
}

} // namespace sandglass
