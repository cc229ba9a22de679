#include "app/desktop/import_choices.h"

#include "sim/base/error.h"
#include "sim/io/run_folder.h"
#include "sim/scene/units.h"

#include <fmt/format.h>

#include <algorithm>

namespace sandglass::desktop {

namespace fs = std::filesystem;

namespace {

/// The unit's name where it is a usual one, else a multiple of the SI unit.
QString unitText(double size, const std::string& si, const QStringList& usual) {
  if (size == 1) return {};
  for (const auto& unit : usual)
    if (parseQuantity("1 " + unit.toStdString(), si) == size) return unit;
  return QString("%1 %2").arg(size, 0, 'g', 17).arg(QString::fromStdString(si));
}

QString quantityText(const std::optional<double>& value, const char* si) {
  return value ? QString("%1 %2").arg(*value, 0, 'g', 12).arg(si) : QString();
}

QString cornerText(const std::optional<Vec3>& corner) {
  if (!corner) return {};
  QStringList parts;
  for (int k = 0; k < 3; ++k)
    parts << quantityText((*corner)[k], "m");
  return parts.join(", ");
}

QString periodicText(const std::optional<std::array<bool, 3>>& periodic) {
  if (!periodic) return {};
  QString text;
  for (std::size_t k = 0; k < 3; ++k)
    if ((*periodic)[k]) text += "xyz"[k];
  return text.isEmpty() ? "none" : text;
}

/// Collects the faults of all fields.
class Fields {
public:
  std::optional<double> positive(const char* what, const QString& text, const char* si) {
    if (text.trimmed().isEmpty()) return std::nullopt;
    try {
      const double value = importQuantity(what, text.trimmed().toStdString(), si);
      if (value > 0) return value;
      faults_.push_back(fmt::format("{} is '{}', but must be above 0", what, text.toStdString()));
    } catch (const InputError& e) {
      faults_.emplace_back(e.what());
    }
    return std::nullopt;
  }
  double unit(const char* what, const QString& text, const char* si) {
    const QString plain = text.trimmed();
    const bool counted = !plain.isEmpty() && (plain[0].isDigit() || plain[0] == '.');
    return positive(what, plain.isEmpty() || counted ? plain : "1 " + plain, si).value_or(1);
  }
  std::optional<Vec3> corner(const char* what, const QString& text) {
    if (text.trimmed().isEmpty()) return std::nullopt;
    const QStringList parts = text.split(',');
    if (parts.size() != 3) {
      faults_.push_back(fmt::format("{} is '{}', but must be three lengths with commas between: 0, 0, 2 cm",
                                    what, text.toStdString()));
      return std::nullopt;
    }
    Vec3 corner;
    try {
      for (int k = 0; k < 3; ++k)
        corner[k] = importQuantity(what, parts[k].trimmed().toStdString(), "m");
    } catch (const InputError& e) {
      faults_.emplace_back(e.what());
      return std::nullopt;
    }
    return corner;
  }
  void fault(std::string sentence) { faults_.push_back(std::move(sentence)); }
  void end() const {
    if (!faults_.empty()) throw InputError(faults_);
  }

private:
  std::vector<std::string> faults_;
};

} // namespace

ImportChoices choicesOf(const ImportSettings& s, const ForeignFacts& facts) {
  ImportChoices c;
  for (const auto& column : facts.columns) {
    if (s.ignores(column.name)) c.meanings[column.name] = "";
    for (const auto& [quantity, name] : s.columns)
      if (name == column.name) c.meanings[column.name] = quantity;
  }
  c.length = unitText(s.length, "m", {"mm", "cm", "um", "km"});
  c.time = unitText(s.time, "s", {"ms", "us", "ns"});
  c.mass = unitText(s.mass, "kg", {"g", "mg", "ug"});
  c.radius = quantityText(s.radius, "m");
  QStringList of;
  for (const auto& [species, radius] : s.radiusOf)
    of << QString::fromStdString(species) + " = " + quantityText(radius, "m");
  c.radiusOf = of.join(", ");
  c.lower = cornerText(s.lower);
  c.upper = cornerText(s.upper);
  c.periodic = periodicText(s.periodic);
  c.timeStep = quantityText(s.timeStep, "s");
  c.frameInterval = quantityText(s.frameInterval, "s");
  c.shape = QString::fromStdString(s.shape);
  for (const auto& wall : s.walls)
    c.walls << QString::fromStdString(wall.string());
  return c;
}

ImportSettings settingsOf(const ImportChoices& c, const ImportSettings& base) {
  ImportSettings s = base;
  Fields fields;
  s.columns.clear();
  s.ignored.clear();
  for (const auto& [column, quantity] : c.meanings) {
    if (quantity.empty()) {
      s.ignored.push_back(column);
    } else if (const auto [at, fresh] = s.columns.try_emplace(quantity, column); !fresh) {
      fields.fault(fmt::format("both '{}' and '{}' are to be the {}; choose one of them", at->second, column,
                               quantityInWords(quantity).toStdString()));
    }
  }
  s.length = fields.unit("the unit of length", c.length, "m");
  s.time = fields.unit("the unit of time", c.time, "s");
  s.mass = fields.unit("the unit of mass", c.mass, "kg");
  s.radius = fields.positive("the radius", c.radius, "m");
  s.radiusOf.clear();
  for (const auto& part : c.radiusOf.split(',', Qt::SkipEmptyParts)) {
    const int equals = part.indexOf('=');
    const QString species = part.left(equals).trimmed();
    if (equals < 0 || species.isEmpty()) {
      fields.fault("radii by species are written as 1 = 1 mm, 2 = 2 mm");
      break;
    }
    if (const auto radius = fields.positive("a radius by species", part.mid(equals + 1), "m"))
      s.radiusOf[species.toStdString()] = *radius;
  }
  s.lower = fields.corner("the lower corner of the box", c.lower);
  s.upper = fields.corner("the upper corner of the box", c.upper);
  if (c.lower.trimmed().isEmpty() != c.upper.trimmed().isEmpty())
    fields.fault("a box needs both corners, or neither");
  else if (s.lower && s.upper && !(s.lower->array() < s.upper->array()).all())
    fields.fault("the upper corner of the box must be above the lower one in every direction");
  s.periodic.reset();
  if (!c.periodic.isEmpty())
    s.periodic = periodicDirections("the directions that repeat", c.periodic.toStdString());
  s.timeStep = fields.positive("the time of a step", c.timeStep, "s");
  s.frameInterval = fields.positive("the time between frames", c.frameInterval, "s");
  s.shape = c.shape.toStdString();
  s.walls.clear();
  for (const auto& wall : c.walls)
    if (!wall.trimmed().isEmpty()) s.walls.emplace_back(wall.trimmed().toStdString());
  fields.end();
  return s;
}

QString quantityInWords(const std::string& quantity) {
  static const std::map<std::string, const char*> words{{"id", "id of the grain"},
                                                        {"species", "species"},
                                                        {"mass", "mass"},
                                                        {"radius", "radius"},
                                                        {"diameter", "diameter"},
                                                        {"time", "time of the frame"},
                                                        {"step", "step of the frame"},
                                                        {"e1", "exponent e1"},
                                                        {"e2", "exponent e2"},
                                                        {"blockiness1", "blockiness 1 (2/e1)"},
                                                        {"blockiness2", "blockiness 2 (2/e2)"}};
  static const std::map<std::string, const char*> bases{{"velocity", "velocity"},
                                                        {"spin", "spin"},
                                                        {"force", "force"},
                                                        {"torque", "torque"},
                                                        {"orientation", "orientation"},
                                                        {"shape", "semi-axis"},
                                                        {"shape_diameter", "whole axis"}};
  if (quantity.empty()) return "left out";
  if (const auto at = words.find(quantity); at != words.end()) return at->second;
  if (quantity.size() == 1) return "position along " + QString::fromStdString(quantity);
  if (quantity.size() == 8 && quantity.substr(1) == "_scaled")
    return QString("position along %1, as share of the box").arg(quantity[0]);
  const auto dot = quantity.rfind('.');
  if (dot != std::string::npos)
    if (const auto at = bases.find(quantity.substr(0, dot)); at != bases.end())
      return QString("%1, %2").arg(at->second, QString::fromStdString(quantity.substr(dot + 1)));
  return "quantity " + QString::fromStdString(quantity);
}

ImportTrial tryImport(const ForeignFacts& facts, const ImportSettings& settings) {
  const auto source = openFrames(facts.file, &settings);
  while (source->size() <= facts.frame && !source->complete())
    source->refresh();
  const FramePtr frame = source->load(std::min(facts.frame, source->size() - 1));
  ImportTrial trial;
  const auto range = [](const std::vector<double>& list) {
    const auto [low, high] = std::minmax_element(list.begin(), list.end());
    return *low == *high ? QString("%1 mm").arg(1e3 * *low, 0, 'g', 4)
                         : QString("%1 to %2 mm").arg(1e3 * *low, 0, 'g', 4).arg(1e3 * *high, 0, 'g', 4);
  };
  const Vec3 size = 1e3 * (frame->domain.upper - frame->domain.lower);
  trial.sentence = QString("%L1 grains at t = %2 s in %3 by %4 by %5 mm")
                       .arg(frame->size())
                       .arg(frame->time, 0, 'g', 5)
                       .arg(size.x(), 0, 'g', 4)
                       .arg(size.y(), 0, 'g', 4)
                       .arg(size.z(), 0, 'g', 4);
  if (frame->has(quantity::radius) && frame->size() > 0)
    trial.sentence += ", radius " + range(frame->scalar(quantity::radius));
  else if (frame->size() > 0)
    trial.missing << "radii: choose their column, or give one for all grains";
  QStringList others;
  for (const auto& [name, list] : frame->scalars)
    if (name != quantity::radius) others << QString::fromStdString(name);
  for (const auto& [name, list] : frame->vectors)
    others << QString::fromStdString(name);
  if (!others.isEmpty()) trial.sentence += "; with " + others.join(", ");
  trial.sentence += ".";
  for (const auto& remark : source->remarks())
    trial.granted << QString::fromStdString(remark);
  return trial;
}

fs::path importFileFor(const fs::path& path, const ForeignFacts& facts) {
  if (fs::exists(path)) return path.string() + ".import.toml";
  return fs::path(facts.file).parent_path() / "import.toml";
}

} // namespace sandglass::desktop
