#include "sim/io/foreign_export.h"

#include "sim/base/error.h"
#include "sim/io/text_frames.h"

#include <fmt/format.h>

#include <functional>
#include <iterator>

namespace sandglass {

namespace {

/// One property of the grains: its name, how many columns, and what writes its cells.
struct Property {
  std::string name;
  int count = 1;
  char type = 'R'; ///< of extended XYZ: R, I, S
  std::function<void(std::size_t, std::string&)> write;
};

void put(double value, std::string& text) {
  fmt::format_to(std::back_inserter(text), " {}", value);
}
void put(const Vec3& v, std::string& text) {
  fmt::format_to(std::back_inserter(text), " {} {} {}", v[0], v[1], v[2]);
}

std::string oneWord(std::string name) {
  for (char& c : name)
    if (c == ' ' || c == '\t' || c == ':' || c == '"' || c == '=') c = '_';
  return name.empty() ? "none" : name;
}

/// Names of the standard vectors in each form.
struct Names {
  const char *velocity, *spin, *force, *torque;
};

class Columns {
public:
  Columns(const Frame& frame, const Names& names) : frame_(frame) {
    for (const auto& [name, values] : frame.scalars)
      if (name != quantity::species && name != quantity::shape && name != quantity::radius)
        add(oneWord(name), 1, 'R', [&v = values](std::size_t k, std::string& t) { put(v[k], t); });
    for (const auto& [name, values] : frame.vectors) {
      const std::string known = name == quantity::velocity ? names.velocity
                                : name == quantity::spin   ? names.spin
                                : name == quantity::force  ? names.force
                                : name == "torque"         ? names.torque
                                                           : oneWord(name);
      add(known, 3, 'R', [&v = values](std::size_t k, std::string& t) { put(v[k], t); });
    }
  }
  void add(const std::string& name, int count, char type,
           std::function<void(std::size_t, std::string&)> write) {
    all_.push_back({name, count, type, std::move(write)});
  }
  /// In front of what the frame has besides.
  void radius() {
    if (const auto it = frame_.scalars.find(quantity::radius); it != frame_.scalars.end())
      add("radius", 1, 'R', [&v = it->second](std::size_t k, std::string& t) { put(v[k], t); });
  }
  /// Semi-axes of every grain, those of a sphere its radius.
  GrainShape shapeOf(std::size_t k) const {
    const double s = frame_.scalar(quantity::shape)[k];
    if (s >= 0) return frame_.shapes[static_cast<std::size_t>(s)];
    return {Vec3::Constant(frame_.scalar(quantity::radius)[k]), 1, 1};
  }
  bool shaped() const { return frame_.has(quantity::shape) && frame_.has(quantity::radius); }
  const std::vector<Property>& all() const { return all_; }

private:
  const Frame& frame_;
  std::vector<Property> all_;
};

std::size_t speciesOf(const Frame& frame, std::size_t k) {
  const auto it = frame.scalars.find(quantity::species);
  return it == frame.scalars.end() ? 0 : static_cast<std::size_t>(it->second[k]);
}
std::string speciesName(const Frame& frame, std::size_t species) {
  return species < frame.speciesNames.size() ? oneWord(frame.speciesNames[species])
                                             : std::to_string(species + 1);
}

/// Writes frame by frame, so that a long run needs the memory of one.
void writeDump(const Frame& frame, std::size_t, std::string& text) {
  auto to = std::back_inserter(text);
  const Domain& d = frame.domain;
  const auto flag = [&](std::size_t k) { return d.periodic[k] ? "pp" : "ff"; };
  fmt::format_to(to,
                 "ITEM: TIME\n{}\nITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS {} {} {}\n",
                 frame.time, frame.step, frame.size(), flag(0), flag(1), flag(2));
  for (int k = 0; k < 3; ++k)
    fmt::format_to(to, "{} {}\n", d.lower[k], d.upper[k]);
  Columns columns(frame, {"v", "omega", "f", "tq"});
  columns.radius();
  if (columns.shaped()) {
    columns.add("shape", 3, 'R', [&](std::size_t k, std::string& t) { put(columns.shapeOf(k).semiAxes, t); });
    columns.add("blockiness", 2, 'R', [&](std::size_t k, std::string& t) {
      put(2 / columns.shapeOf(k).e1, t);
      put(2 / columns.shapeOf(k).e2, t);
    });
  }
  if (!frame.orientation.empty())
    columns.add("quat", 4, 'R', [&](std::size_t k, std::string& t) {
      put(frame.orientation[k].w(), t);
      put(Vec3(frame.orientation[k].vec()), t);
    });
  text += "ITEM: ATOMS id type element x y z";
  for (const auto& p : columns.all())
    for (int c = 0; c < p.count; ++c) {
      const bool standard =
          p.name == "v" || p.name == "omega" || p.name == "f" || p.name == "tq" || p.name == "shape";
      if (p.count == 1)
        text += " " + p.name;
      else if (p.name == "blockiness" || p.name == "quat")
        text += fmt::format(" {}{}", p.name, c + 1);
      else
        text += fmt::format(" {}{}{}", p.name, standard ? "" : ".", "xyz"[c]);
    }
  text += "\n";
  for (std::size_t k = 0; k < frame.size(); ++k) {
    const std::size_t species = speciesOf(frame, k);
    fmt::format_to(to, "{} {} {}", frame.id[k], species + 1, speciesName(frame, species));
    put(frame.position[k], text);
    for (const auto& p : columns.all())
      p.write(k, text);
    text += "\n";
  }
}

void writeXyz(const Frame& frame, std::size_t, std::string& text) {
  auto to = std::back_inserter(text);
  const Domain& d = frame.domain;
  const Vec3 edge = d.upper - d.lower;
  const auto flag = [&](std::size_t k) { return d.periodic[k] ? 'T' : 'F'; };
  fmt::format_to(to,
                 "{}\nLattice=\"{} 0 0 0 {} 0 0 0 {}\" Origin=\"{} {} {}\" pbc=\"{} {} {}\" Time={} Step={} "
                 "Properties=species:S:1:pos:R:3:id:I:1",
                 frame.size(), edge[0], edge[1], edge[2], d.lower[0], d.lower[1], d.lower[2], flag(0),
                 flag(1), flag(2), frame.time, frame.step);
  Columns columns(frame, {"velo", "spin", "force", "torque"});
  columns.radius();
  if (columns.shaped()) {
    columns.add("aspherical_shape", 3, 'R',
                [&](std::size_t k, std::string& t) { put(columns.shapeOf(k).semiAxes, t); });
    columns.add("e1", 1, 'R', [&](std::size_t k, std::string& t) { put(columns.shapeOf(k).e1, t); });
    columns.add("e2", 1, 'R', [&](std::size_t k, std::string& t) { put(columns.shapeOf(k).e2, t); });
  }
  if (!frame.orientation.empty())
    columns.add("orientation", 4, 'R', [&](std::size_t k, std::string& t) {
      put(Vec3(frame.orientation[k].vec()), t);
      put(frame.orientation[k].w(), t);
    });
  for (const auto& p : columns.all())
    fmt::format_to(to, ":{}:{}:{}", p.name, p.type, p.count);
  text += "\n";
  for (std::size_t k = 0; k < frame.size(); ++k) {
    text += speciesName(frame, speciesOf(frame, k));
    put(frame.position[k], text);
    fmt::format_to(to, " {}", frame.id[k]);
    for (const auto& p : columns.all())
      p.write(k, text);
    text += "\n";
  }
}

} // namespace

void exportLammpsDump(FrameSource& frames, std::size_t first, std::size_t last,
                      const std::filesystem::path& file) {
  writeTextFrames(frames, first, last, file, writeDump);
}

void exportExtendedXyz(FrameSource& frames, std::size_t first, std::size_t last,
                       const std::filesystem::path& file) {
  writeTextFrames(frames, first, last, file, writeXyz);
}

} // namespace sandglass
