// Speed of the contact core on one machine, beside other programs where they are installed. All programs take
// turns in rounds, since a machine's speed drifts by tens of per cent within seconds; every round is kept,
// and ratios are medians of ratios within a round. A row of another
// program counts only when the kinetic energies of both at step 300 agree to 1e-3.

#include "sim/base/error.h"
#include "sim/solvers/dem/dem_solver.h"
#include "tests/bench/core_cases.h"
#include "tests/bench/core_rows.h"
#include "tests/peers/circumstances.h"
#include "tests/peers/lammps.h"
#include "tests/peers/yade.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#define XXH_INLINE_ALL // header only
#include <xxhash.h>

#include <x86intrin.h>

#include <chrono>
#include <cmath>
#include <ctime>
#include <fstream>
#include <iostream>
#include <optional>
#include <string>
#include <thread>

using namespace sandglass;
using namespace sandglass::bench;

namespace {

constexpr double energyTolerance = 1e-3; ///< relative; beyond it the two did not run the same case

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double cpuSeconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Ticks of the time stamp counter in a second.
double ticksPerSecond() {
  static const double rate = [] {
    const auto start = Clock::now();
    const auto ticks = __rdtsc();
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    return static_cast<double>(__rdtsc() - ticks) / secondsSince(start);
  }();
  return rate;
}

std::string hashOf(const Solver& solver) {
  std::vector<double> all;
  for (const GrainSeed& s : solver.present())
    for (const Vec3* v : {&s.position, &s.velocity, &s.spin})
      all.insert(all.end(), v->data(), v->data() + 3);
  return fmt::format("{:016x}", XXH3_64bits(all.data(), all.size() * sizeof(double)));
}

std::unique_ptr<DemSolver> solverAt(const CoreCase& c, const Scene& scene, int threads) {
  auto solver = std::make_unique<DemSolver>(scene, SolverOptions{threads});
  if (c.grains.empty())
    solver->load(c.state);
  else
    solver->add(c.grains);
  return solver;
}

/// Touching contacts of the starting state, walls among them.
double contactsOf(const CoreCase& c) {
  Scene scene = c.scene;
  scene.output.contacts = true;
  const auto solver = solverAt(c, scene, 0);
  solver->advance(1);
  return static_cast<double>(solver->frame()->contacts.size());
}

/// Another setting of ours that takes its turn too: a label for the column `precision`, and a key of the
/// scene.
struct Variant {
  std::string label, override;
};

/// "mixed:accuracy.precision=mixed"
Variant parseVariant(const std::string& text) {
  const auto colon = text.find(':');
  if (colon == std::string::npos || text.find('=', colon) == std::string::npos)
    throw InputError(fmt::format("--variant is LABEL:KEY=VALUE, not '{}'", text));
  return {text.substr(0, colon), text.substr(colon + 1)};
}

CoreCase withVariant(const CoreCase& c, const Variant& variant) {
  CoreCase changed = c;
  changed.scene = parseScene(writeScene(c.scene), "bench", {variant.override});
  return changed;
}

/// Set-up (list, first forces) is not timed, as it is not in the loop time of LAMMPS.
Timing runOurs(const CoreCase& c, const std::string& label, int threads, double contacts, int round) {
  const auto solver = solverAt(c, c.scene, threads);
  solver->advance(0);
  Timing t;
  t.benchCase = c.name;
  t.program = "sandglass";
  t.threads = threads;
  t.precision = label;
  t.round = round;
  t.steps = c.steps;
  t.grains = static_cast<std::int64_t>(solver->grains());
  t.kineticEnergy = -1;
  for (std::int64_t done = 0; done < c.steps;) {
    const std::int64_t steps = done < lookStep ? std::min(lookStep, c.steps) : c.steps - done;
    const auto start = Clock::now();
    const double cpu = cpuSeconds();
    solver->advance(steps);
    t.cpuSeconds += cpuSeconds() - cpu;
    t.wallSeconds += secondsSince(start);
    done += steps;
    if (done == lookStep && !c.lammpsDeck.empty()) t.kineticEnergy = solver->energies().translational;
  }
  t.bytesPerGrain = solver->bytesPerGrain();
  t.check = hashOf(*solver);
  if (contacts > 0)
    t.cyclesPerContact = t.cpuSeconds * ticksPerSecond() / (contacts * static_cast<double>(c.steps));
  return t;
}

/// A program beside ours.
struct Peer {
  const char *name, *command;
  const std::string CoreCase::*deck;
  bool yade;      ///< not of LAMMPS's family: runs lookStep steps, and gives the energy at their end
  int mostRounds; ///< a slow one takes fewer turns
};
constexpr Peer allPeers[] = {{"lammps", "lmp", &CoreCase::lammpsDeck, false, 100},
                             {"liggghts", "liggghts", &CoreCase::liggghtsDeck, false, 100},
                             {"yade", "yade", &CoreCase::yadeScript, true, 2}};

Timing runPeer(const CoreCase& c, const Peer& peer, const std::filesystem::path& folder, int ranks,
               int round) {
  Timing t;
  t.benchCase = c.name;
  t.program = peer.name;
  t.threads = ranks;
  t.precision = "double";
  t.round = round;
  t.grains = static_cast<std::int64_t>(c.grains.size());
  if (peer.yade) {
    const peers::YadeRun run = peers::runYade(folder, c.*peer.deck, ranks);
    t.steps = lookStep;
    t.wallSeconds = run.seconds;
    t.kineticEnergy = run.kineticEnergy;
  } else {
    const std::string deck = c.*peer.deck + fmt::format("run {}\n", c.steps);
    const peers::LammpsRun run = peers::runLammps(folder, deck, ranks, peer.command);
    const auto& loop = run.loops.front();
    t.steps = loop.steps;
    t.wallSeconds = loop.seconds;
    for (const auto& row : loop.thermo)
      if (row.at("Step") == lookStep)
        t.kineticEnergy = row.contains("kinetic") ? row.at("kinetic") : row.at("c_kinetic");
  }
  t.cpuSeconds = t.wallSeconds * ranks; // those that wait do it by spinning
  return t;
}

/// A row that says why there is none.
Timing noRow(const std::string& name, const std::string& program, const std::string& why) {
  Timing t;
  t.benchCase = name;
  t.program = program;
  t.check = "void: " + why;
  return t;
}

/// Our energy at lookStep under the law that Yade has: without attraction at the end of a contact.
double clampedEnergy(const CoreCase& c) {
  const auto solver = solverAt(c, c.clamped, 0);
  solver->advance(lookStep);
  return solver->energies().translational;
}

/// Rows of another program or setting whose energy differs from ours in double ran another case.
void compareEnergies(std::vector<Timing>& timings, const CoreCase& c) {
  const auto reference = [](const Timing& t) { return t.program == "sandglass" && t.precision == "double"; };
  double ours = 0;
  for (const Timing& t : timings)
    if (t.benchCase == c.name && reference(t)) ours = t.kineticEnergy;
  std::optional<double> clamped;
  for (Timing& t : timings)
    if (t.benchCase == c.name && !reference(t) && t.wallSeconds > 0) {
      if (t.program == "yade" && !clamped) clamped = clampedEnergy(c);
      const double off = std::abs(t.kineticEnergy / (t.program == "yade" ? *clamped : ours) - 1);
      if (!(off <= energyTolerance)) t.check = fmt::format("void: kinetic energy off by {:.2g}", off);
    }
}

void measure(const CoreCase& c, int rounds, const std::vector<Peer>& others,
             const std::vector<Variant>& variants, std::vector<Timing>& timings) {
  const double contacts = contactsOf(c);
  std::vector<Peer> taking;
  for (const Peer& p : others)
    if (!(c.*p.deck).empty()) taking.push_back(p);
  std::optional<peers::ScratchFolder> scratch;
  if (!taking.empty()) {
    scratch.emplace();
    peers::writeLammpsData(scratch->path() / "grains.data", c.scene, c.grains);
  }
  std::vector<CoreCase> ours{c};
  std::vector<std::string> labels{"double"};
  if (!c.lammpsDeck.empty()) // where there is an energy to compare
    for (const Variant& v : variants) {
      ours.push_back(withVariant(c, v));
      labels.push_back(v.label);
    }
  const int own = static_cast<int>(ours.size()), runners = own + static_cast<int>(taking.size());
  for (int round = 1; round <= rounds; ++round)
    for (const int threads : {1, 2})
      for (int k = 0; k < runners; ++k) {
        // The order turns round from round to round, so that a drift of the machine favours nobody.
        const int who = round % 2 ? k : runners - 1 - k;
        if (who >= own && round > taking[who - own].mostRounds) continue;
        timings.push_back(who < own ? runOurs(ours[who], labels[who], threads, contacts, round)
                                    : runPeer(c, taking[who - own], scratch->path(), threads, round));
        const Timing& last = timings.back();
        std::cerr << fmt::format("{} round {}/{}, {} x {} {}: {:.2f} million grain-steps/s\n", c.name, round,
                                 rounds, threads, last.program, last.precision, last.rate() / 1e6);
      }
  if (runners > 1) compareEnergies(timings, c);
}

void write(const std::string& file, const std::string& text) {
  if (!file.empty() && !(std::ofstream(file) << text)) throw RunError("cannot write " + file);
}

} // namespace

int main(int argc, char** argv) {
  CLI::App app{"speed of the contact core"};
  std::string csvFile, tableFile;
  std::vector<std::string> cases, variantTexts;
  bool quick = false, alone = false;
  int rounds = 5;
  app.add_option("--csv", csvFile, "every round of every case");
  app.add_option("--table", tableFile, "medians, as Markdown");
  app.add_option("--case", cases, "only these cases");
  app.add_option("--variant", variantTexts, "LABEL:KEY=VALUE, a setting of ours that takes its turn too");
  app.add_option("--rounds", rounds, "how often everybody takes a turn")->check(CLI::Range(1, 100));
  app.add_flag("--quick", quick, "small beds, one round: shows that the bench works");
  app.add_flag("--alone", alone, "without other programs");
  CLI11_PARSE(app, argc, argv);
  if (quick) rounds = 1;
  if (cases.empty()) cases = coreCaseNames();
  try {
    std::vector<Variant> variants;
    for (const std::string& text : variantTexts)
      variants.push_back(parseVariant(text));
    std::vector<Peer> present, missing;
    if (!alone)
      for (const Peer& p : allPeers)
        (peers::findProgram(p.command).empty() ? missing : present).push_back(p);
    std::string versions;
    for (const std::string& version :
         {peers::lammpsVersion(), peers::liggghtsVersion(), peers::yadeVersion()})
      if (!alone && !version.empty()) versions += (versions.empty() ? "beside " : ", ") + version;
    std::vector<Timing> timings;
    for (const std::string& name : cases) {
      std::cerr << name << ": making its grains\n";
      const CoreCase c = makeCoreCase(name, quick);
      measure(c, rounds, present, variants, timings);
      for (const Peer& p : missing)
        if (!(c.*p.deck).empty()) timings.push_back(noRow(name, p.name, "not installed"));
      if (!alone && !c.whyNoPeers.empty()) timings.push_back(noRow(name, "others", c.whyNoPeers));
      write(csvFile, csv(timings)); // as it grows: a long bench may be stopped
      write(tableFile,
            fmt::format("Made by `./bootstrap bench core` on {}; {}; {} rounds.\n\n", peers::circumstances(),
                        versions.empty() ? "no other program" : versions, rounds) +
                summary(timings));
    }
    std::cout << csv(timings);
    std::cerr << "\n" << summary(timings);
  } catch (const std::exception& e) {
    std::cerr << "bench: " << e.what() << "\n";
    return 1;
  }
}
