#include "tests/peers/lammps.h"

#include "sim/base/error.h"

#include <fmt/format.h>

#include <fstream>
#include <sstream>
#include <unistd.h>

namespace sandglass::peers {

namespace fs = std::filesystem;

namespace {

void write(const fs::path& file, const std::string& text) {
  if (!(std::ofstream(file) << text)) throw RunError(fmt::format("cannot write '{}'", file.string()));
}

std::vector<std::string> words(const std::string& line) {
  std::istringstream in(line);
  std::vector<std::string> found;
  for (std::string w; in >> w;)
    found.push_back(w);
  return found;
}

/// All words as numbers, or nothing when one is none.
std::vector<double> numbers(const std::string& line) {
  std::vector<double> found;
  for (const std::string& w : words(line)) {
    char* end = nullptr;
    found.push_back(std::strtod(w.c_str(), &end));
    if (*end) return {};
  }
  return found;
}

LammpsRun parseLog(const std::string& text) {
  LammpsRun run;
  std::istringstream in(text);
  std::vector<std::string> headings;
  std::vector<std::map<std::string, double>> thermo;
  for (std::string line; std::getline(in, line);) {
    const auto first = line.find_first_not_of(' ');
    if (first != std::string::npos && line.compare(first, 5, "Step ") == 0) {
      headings = words(line);
    } else if (line.starts_with("Loop time of ")) {
      // Loop time of 1.23 on 1 procs for 300 steps with 32000 atoms
      const auto w = words(line);
      run.loops.push_back({std::stod(w.at(3)), std::stoll(w.at(8)), std::move(thermo)});
      thermo.clear();
      headings.clear();
    } else if (!headings.empty()) {
      const auto values = numbers(line);
      if (values.size() != headings.size()) continue; // a warning amid the table
      std::map<std::string, double> row;
      for (std::size_t k = 0; k < values.size(); ++k)
        row[headings[k]] = values[k];
      thermo.push_back(std::move(row));
    }
  }
  return run;
}

} // namespace

std::string lammpsVersion() {
  if (findProgram("lmp").empty()) return {};
  const std::string text = runCommand(fs::temp_directory_path(), "lmp -h").text;
  const auto at = text.find("Simulator - ");
  if (at == std::string::npos) return "LAMMPS of unknown version";
  const auto w = words(text.substr(at + 12, 40));
  return w.size() < 3 ? "LAMMPS of unknown version" : fmt::format("LAMMPS {} {} {}", w[0], w[1], w[2]);
}

std::string liggghtsVersion() {
  if (findProgram("liggghts").empty()) return {};
  const std::string text = runCommand(fs::temp_directory_path(), "liggghts -h").text;
  const auto at = text.find("(Version ");
  const auto w = words(at == std::string::npos ? "" : text.substr(at + 9, 60));
  if (w.size() < 2) return "LIGGGHTS of unknown version";
  return w[0] + " " + w[1].substr(0, w[1].find(','));
}

void writeLammpsData(const fs::path& file, const Scene& scene, const std::vector<GrainSeed>& grains) {
  fmt::memory_buffer out;
  const auto add = [&]<class... A>(fmt::format_string<A...> form, A&&... values) {
    fmt::format_to(std::back_inserter(out), form, std::forward<A>(values)...);
  };
  add("grains of a scene\n\n{} atoms\n{} atom types\n\n", grains.size(), scene.species.size());
  for (int k = 0; k < 3; ++k)
    add("{0:.17g} {1:.17g} {2}lo {2}hi\n", scene.domain.lower[k], scene.domain.upper[k], "xyz"[k]);
  add("\nAtoms # sphere\n\n");
  for (const GrainSeed& g : grains) {
    const double density = scene.material(scene.species.at(g.species).material).density;
    add("{} {} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}\n", g.id + 1, g.species + 1, 2 * g.radius, density,
        g.position.x(), g.position.y(), g.position.z());
  }
  add("\nVelocities\n\n");
  for (const GrainSeed& g : grains)
    add("{} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}\n", g.id + 1, g.velocity.x(), g.velocity.y(),
        g.velocity.z(), g.spin.x(), g.spin.y(), g.spin.z());
  write(file, fmt::to_string(out));
}

std::string lammpsOpening(const Scene& scene, const std::string& dataFile) {
  std::string boundary;
  for (const bool p : scene.domain.periodic)
    boundary += p ? " p" : " f";
  return fmt::format(
      "units lj\natom_style sphere\nboundary{}\nnewton off\nprocessors * * 1\ncomm_modify vel yes\n"
      "read_data {}\n",
      boundary, dataFile);
}

std::string HookeHistory::words() const {
  return fmt::format("gran/hooke/history {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {}{}", normalStiffness,
                     tangentialStiffness, normalDamping, tangentialDamping, friction,
                     tangentialDamping > 0 ? 1 : 0, limitDamping ? " limit_damping" : "");
}

std::string HookeHistory::wallWords() const {
  return fmt::format("hooke/history {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {}{}", normalStiffness,
                     tangentialStiffness, normalDamping, tangentialDamping, friction,
                     tangentialDamping > 0 ? 1 : 0, limitDamping ? " limit_damping" : "");
}

LammpsRun runLammps(const fs::path& folder, const std::string& deck, int ranks, const std::string& program) {
  write(folder / "in.deck", deck);
  const std::string root = ::geteuid() == 0 ? "--allow-run-as-root " : "";
  const std::string launcher = fmt::format("mpirun {}--oversubscribe -np {} ", root, ranks);
  const ProgramOutput output = runCommand(folder, fmt::format("OMP_NUM_THREADS=1 {}{} -in in.deck -log none",
                                                              ranks > 1 ? launcher : "", program));
  LammpsRun run = parseLog(output.text);
  if (output.code != 0 || run.loops.empty()) {
    const auto at = output.text.find("ERROR");
    throw RunError(program +
                   " failed: " + (at == std::string::npos ? output.text : output.text.substr(at, 400)));
  }
  return run;
}

std::string lammpsDumpCommand(const std::string& file, long long every) {
  return fmt::format("dump all all custom {} {} id radius x y z vx vy vz omegax omegay omegaz\n"
                     "dump_modify all sort id format float %.17g\n",
                     every, file);
}

std::vector<std::vector<GrainSeed>> readLammpsDump(const fs::path& file) {
  std::ifstream in(file);
  if (!in) throw RunError(fmt::format("LAMMPS left no dump '{}'", file.string()));
  bool atoms = false;
  std::vector<std::vector<GrainSeed>> snapshots;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("ITEM: ")) {
      atoms = line.starts_with("ITEM: ATOMS ");
      if (atoms) snapshots.emplace_back();
      continue;
    }
    if (!atoms) continue;
    const auto v = numbers(line);
    if (v.size() != 11) throw RunError(fmt::format("'{}' has a line of {} numbers", file.string(), v.size()));
    GrainSeed g;
    g.id = static_cast<std::int64_t>(v[0]) - 1;
    g.radius = v[1];
    g.position = {v[2], v[3], v[4]};
    g.velocity = {v[5], v[6], v[7]};
    g.spin = {v[8], v[9], v[10]};
    snapshots.back().push_back(g);
  }
  return snapshots;
}

} // namespace sandglass::peers
