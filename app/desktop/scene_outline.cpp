#include "app/desktop/scene_outline.h"

#include "sim/base/error.h"
#include "sim/contact/law_registry.h"
#include "sim/fields/field_registry.h"
#include "sim/grains/fill_registry.h"
#include "sim/grains/size_distribution.h"
#include "sim/scene/probe_registry.h"
#include "sim/scene/scene_sections.h"
#include "sim/walls/wall_motion.h"
#include "sim/walls/wall_registry.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <optional>
#include <sstream>

namespace sandglass::desktop {

namespace {

/// Byte offsets of lines and columns; columns count code points.
class Places {
public:
  explicit Places(const std::string& text) : text_(text) {
    lines_.push_back(0);
    for (std::size_t k = 0; k < text.size(); ++k)
      if (text[k] == '\n') lines_.push_back(k + 1);
  }
  std::size_t offset(const toml::source_position& p) const {
    std::size_t at = p.line <= lines_.size() ? lines_[p.line - 1] : text_.size();
    for (std::uint32_t column = 1; column < p.column && at < text_.size(); ++column)
      do
        ++at;
      while (at < text_.size() && (static_cast<unsigned char>(text_[at]) & 0xC0) == 0x80);
    return at;
  }
  std::size_t endOfLine(std::size_t at) const {
    const auto end = text_.find('\n', at);
    return end == std::string::npos ? text_.size() : end + 1;
  }
  const std::string& text() const { return text_; }

private:
  const std::string& text_;
  std::vector<std::size_t> lines_;
};

struct Kinds {
  std::string name, description;
  std::vector<ParameterSpec> parameters;
};

template <class List> std::vector<Kinds> kindsOf(const List& list) {
  std::vector<Kinds> all;
  for (const auto& kind : list)
    all.push_back({kind.name, kind.description, kind.parameters});
  return all;
}

std::vector<Kinds> lawsOf(LawRole role) {
  std::vector<Kinds> all;
  for (const auto& kind : lawKinds())
    if (kind.role == role) all.push_back({kind.name, kind.description, kind.parameters});
  return all;
}

class Outliner {
public:
  explicit Outliner(const std::string& text) : places_(text), root_(toml::parse(text)) {}

  std::vector<SceneTable> outline() {
    add(root_, "", "scene", sceneKeys(), "", {});
    single("domain", "space", domainKeys());
    each("material", true, [&](const toml::table& t, const std::string& path, const std::string& title) {
      add(t, path, title, materialKeys(), "", {});
    });
    each("species", true, [&](const toml::table& t, const std::string& path, const std::string& title) {
      add(t, path, title, speciesKeys(), "", {});
      below(t, "size", path, title, {}, "distribution", kindsOf(sizeKinds()));
    });
    each("contact", true, [&](const toml::table& t, const std::string& path, const std::string& title) {
      add(t, path, title, contactKeys(), "", {});
      below(t, "normal", path, title, {}, "law", lawsOf(LawRole::normal));
      below(t, "tangential", path, title, {}, "law", lawsOf(LawRole::tangential));
      below(t, "rolling", path, title, {}, "law", lawsOf(LawRole::rolling));
      below(t, "torsion", path, title, {}, "law", lawsOf(LawRole::torsion));
    });
    each("wall", true, [&](const toml::table& t, const std::string& path, const std::string& title) {
      add(t, path, title, wallKeys(), "kind", kindsOf(wallKinds()));
      below(t, "motion", path, title, {}, "kind", kindsOf(motionKinds()));
    });
    each("field", true, [&](const toml::table& t, const std::string& path, const std::string& title) {
      add(t, path, title, fieldKeys(), "kind", kindsOf(fieldKinds()));
    });
    each("outlet", true, [&](const toml::table& t, const std::string& path, const std::string& title) {
      add(t, path, title, outletKeys(), "", {});
      below(t, "recycle", path, title, recycleKeys(), "", {});
    });
    each("fill", false, [&](const toml::table& t, const std::string& path, const std::string& title) {
      add(t, path, title, fillKeys(), "kind", kindsOf(fillKinds()));
    });
    each("stage", true, [&](const toml::table& t, const std::string& path, const std::string& title) {
      add(t, path, title, stageKeys(), "", {});
      below(t, "until", path, title, untilKeys(), "", {});
    });
    each("event", false, [&](const toml::table& t, const std::string& path, const std::string& title) {
      add(t, path, title, eventKeys(), "", {});
    });
    each("probe", true, [&](const toml::table& t, const std::string& path, const std::string& title) {
      add(t, path, title, probeKeys(), "kind", kindsOf(probeKinds()));
    });
    single("output", "output", outputKeys());
    single("accuracy", "accuracy", accuracyKeys());
    return std::move(tables_);
  }

private:
  void single(const char* key, const std::string& title, const Keys& keys) {
    if (const auto* table = root_[key].as_table()) add(*table, key, title, keys, "", {});
  }

  static std::string nameOf(const toml::table& table, std::size_t index) {
    if (const auto name = table["name"].value<std::string>(); name && !name->empty()) return *name;
    const auto a = table["between"][0].value<std::string>(), b = table["between"][1].value<std::string>();
    return a && b ? *a + "-" + *b : std::to_string(index + 1);
  }

  template <class Use> void each(const std::string& key, bool named, Use use) {
    const auto* list = root_[key].as_array();
    if (!list) return;
    for (std::size_t k = 0; k < list->size(); ++k)
      if (const auto* table = list->get(k)->as_table()) {
        const std::string name = named ? nameOf(*table, k) : std::to_string(k + 1);
        use(*table, key + "." + name, key + " " + name);
      }
  }

  void below(const toml::table& table, const char* key, const std::string& path, const std::string& title,
             const Keys& keys, const std::string& selector, const std::vector<Kinds>& kinds) {
    if (const auto* inner = table[key].as_table())
      add(*inner, path + "." + key, title + ": " + key, keys, selector, kinds);
  }

  void add(const toml::table& table, const std::string& path, const std::string& title, const Keys& keys,
           const std::string& selector, const std::vector<Kinds>& kinds) {
    SceneTable out{path, title, "", {}};
    for (const auto& spec : keys)
      out.fields.push_back(field(table, path, spec));
    if (!selector.empty()) {
      ParameterSpec which{.name = selector, .type = ParameterType::text, .unit = "1", .description = "kind"};
      for (const auto& kind : kinds)
        which.choices.push_back(kind.name);
      SceneField chosen = field(table, path, which);
      chosen.selects = true;
      const auto place = std::find_if(out.fields.begin(), out.fields.end(),
                                      [](const SceneField& f) { return f.spec.name != "name"; });
      out.fields.insert(place, chosen);
      const auto now = table[selector].value<std::string>();
      for (const auto& kind : kinds)
        if (now == kind.name) {
          out.description = kind.description;
          for (const auto& spec : kind.parameters)
            out.fields.push_back(field(table, path, spec));
        }
    }
    tables_.push_back(std::move(out));
  }

  SceneField field(const toml::table& table, const std::string& path, const ParameterSpec& spec) const {
    SceneField f;
    f.path = path.empty() ? spec.name : path + "." + spec.name;
    f.spec = spec;
    f.inlineTable = table.is_inline();
    for (const auto& [key, node] : table) {
      if (key.str() != spec.name) continue;
      f.given = true;
      f.begin = places_.offset(node.source().begin);
      f.end = places_.offset(node.source().end);
      f.lineBegin = places_.offset(key.source().begin);
      f.text = places_.text().substr(f.begin, f.end - f.begin);
      return f;
    }
    f.begin = f.end = f.lineBegin = placeForNew(table);
    f.aloneThere = table.empty();
    return f;
  }

  /// After the last value that is no table of its own; else after the header.
  std::size_t placeForNew(const toml::table& table) const {
    std::optional<std::size_t> last;
    for (const auto& [key, node] : table) {
      const auto* inner = node.as_table();
      const auto* list = node.as_array();
      if ((inner && !inner->is_inline()) ||
          (list && !list->empty() && list->get(0)->as_table() && !list->get(0)->as_table()->is_inline()))
        continue;
      last = std::max(last.value_or(0), places_.offset(node.source().end));
    }
    if (table.is_inline()) return last.value_or(places_.offset(table.source().begin) + 1);
    if (last) return places_.endOfLine(*last);
    return &table == &root_ ? 0 : places_.endOfLine(places_.offset(table.source().begin));
  }

  Places places_;
  toml::table root_;
  std::vector<SceneTable> tables_;
};

std::string trimmed(const std::string& text) {
  const auto from = text.find_first_not_of(" \t\n"), to = text.find_last_not_of(" \t\n");
  return from == std::string::npos ? "" : text.substr(from, to - from + 1);
}

bool isList(const ParameterSpec& spec) {
  return spec.type == ParameterType::vector || spec.type == ParameterType::numbers ||
         spec.type == ParameterType::texts;
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text)
    out += c == '"' || c == '\\' ? std::string("\\") + c : c == '\n' ? "\\n" : std::string(1, c);
  return out + "\"";
}

bool isBareNumber(const std::string& text) {
  try {
    const auto table = toml::parse("v = " + text);
    return table["v"].is_number();
  } catch (const toml::parse_error&) {
    return false;
  }
}

std::string oneValue(const std::string& shown, const ParameterSpec& spec) {
  if (spec.type == ParameterType::text || spec.type == ParameterType::texts) return quoted(shown);
  return isBareNumber(shown) ? shown : quoted(shown);
}

} // namespace

std::vector<SceneTable> outlineScene(const std::string& text) {
  try {
    return Outliner(text).outline();
  } catch (const toml::parse_error& e) {
    throw InputError(fmt::format("line {}: {}", e.source().begin.line, std::string(e.description())));
  }
}

std::string withValue(const std::string& text, const SceneField& field, const std::string& toml) {
  std::string out = text;
  if (field.given && !toml.empty()) return out.replace(field.begin, field.end - field.begin, toml);
  if (!field.given && toml.empty()) return out;
  if (!field.given) {
    const std::string entry = field.spec.name + " = " + toml;
    if (!field.inlineTable) return out.insert(field.begin, entry + "\n");
    return out.insert(field.begin, field.aloneThere ? " " + entry + " " : ", " + entry);
  }
  std::size_t from = field.lineBegin, to = field.end;
  if (field.inlineTable) { // with one of the commas beside it
    const auto after = out.find_first_not_of(" ", to), before = out.find_last_not_of(" ", from - 1);
    if (after != std::string::npos && out[after] == ',')
      to = out.find_first_not_of(" ", after + 1);
    else if (before != std::string::npos && out[before] == ',')
      from = before;
  } else {
    to = std::min(out.size(), out.find('\n', to) == std::string::npos ? out.size() : out.find('\n', to) + 1);
  }
  return out.erase(from, to - from);
}

std::string withKind(const std::string& text, const std::string& path, const std::string& kind) {
  const auto find = [](const std::vector<SceneTable>& tables,
                       const std::string& wanted) -> const SceneField* {
    for (const auto& table : tables)
      for (const auto& field : table.fields)
        if (field.path == wanted) return &field;
    return nullptr;
  };
  const auto choose = [&](const std::string& in) {
    const auto tables = outlineScene(in);
    const SceneField* selector = find(tables, path);
    return selector ? withValue(in, *selector, quoted(kind)) : in;
  };
  const std::string parent = path.substr(0, path.rfind('.') + 1);
  const auto before = outlineScene(text), after = outlineScene(choose(text));
  std::string out = text;
  for (const auto& table : before)
    for (const auto& field : table.fields)
      if (field.given && table.path + "." == parent && !find(after, field.path)) {
        const auto now = outlineScene(out); // places move with every key that goes
        out = withValue(out, *find(now, field.path), "");
      }
  return choose(out);
}

std::string shownValue(const std::string& text, const ParameterSpec& spec) {
  try {
    const auto parsed = toml::parse("v = " + text);
    const auto& node = *parsed.get("v");
    const auto one = [](const toml::node& n) -> std::string {
      if (const auto s = n.value<std::string>()) return *s;
      std::ostringstream out;
      n.visit([&](const auto& value) { out << value; });
      return out.str();
    };
    if (const auto* list = node.as_array(); list && isList(spec)) {
      std::string all;
      for (const auto& element : *list)
        all += (all.empty() ? "" : ", ") + one(element);
      return all;
    }
    if (node.is_value()) return node.is_string() ? *node.value<std::string>() : trimmed(text);
  } catch (const toml::parse_error&) {
    // Shown as it stands.
  }
  return text;
}

std::string tomlValue(const std::string& shown, const ParameterSpec& spec) {
  const std::string text = trimmed(shown);
  if (text.empty()) return "";
  if (spec.type == ParameterType::boolean) return text;
  if (spec.type == ParameterType::vectors || text.front() == '[' || text.front() == '{') return text;
  if (!isList(spec)) return oneValue(text, spec);
  std::string all;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');)
    all += (all.empty() ? "" : ", ") + oneValue(trimmed(part), spec);
  return "[" + all + "]";
}

std::string pathOfFault(const std::string& sentence, const std::vector<SceneTable>& tables) {
  std::string best;
  const auto consider = [&](const std::string& path) {
    if (path.size() <= best.size()) return;
    const auto at = sentence.find(": " + path);
    if (at == std::string::npos) return;
    const char after = at + 2 + path.size() < sentence.size() ? sentence[at + 2 + path.size()] : ' ';
    if (after == ' ' || after == '.' || after == ',') best = path;
  };
  for (const auto& table : tables) {
    if (!table.path.empty()) consider(table.path);
    for (const auto& field : table.fields)
      consider(field.path);
  }
  return best;
}

} // namespace sandglass::desktop
