#pragma once
// LAMMPS (Thompson et al., Comput. Phys. Commun. 271, 108171 (2022)) on grains of ours: data files out,
// thermo tables and dumps in. Its units are `si` or `lj`, whichever the deck names; numbers pass unchanged.

#include "sim/frame/frame.h"
#include "sim/grains/seeding.h"
#include "tests/peers/programs.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace sandglass::peers {

/// "LAMMPS 29 Sep 2021", or empty where `lmp` is not installed.
std::string lammpsVersion();

/// "LIGGGHTS-PUBLIC 3.8.0", a relative of LAMMPS, or empty where it is not installed.
std::string liggghtsVersion();

/// Atoms of style sphere with 17 digits: atom id = grain id + 1, type = species + 1, velocities and spins.
/// Densities are those of the species in `scene`.
void writeLammpsData(const std::filesystem::path& file, const Scene& scene,
                     const std::vector<GrainSeed>& grains);

/// The words of the deck that every case shares: style, boundaries of the domain, data file. Directions that
/// are not periodic are fixed ("f"): what passes them is lost.
std::string lammpsOpening(const Scene& scene, const std::string& dataFile);

/// Coefficients of `pair_style` and `fix wall/gran` gran/hooke/history: spring constants per length, damping
/// per effective mass [1/time].
struct HookeHistory {
  double normalStiffness = 0, tangentialStiffness = 0, normalDamping = 0, tangentialDamping = 0, friction = 0;
  bool limitDamping = false; ///< no attraction while parting
  std::string words() const; ///< as pair_style takes them
  std::string wallWords() const;
};

struct LammpsRun {
  /// One entry a `run` command, in order.
  struct Loop {
    double seconds = 0; ///< of the loop alone: set-up is not in it
    long long steps = 0;
    std::vector<std::map<std::string, double>> thermo; ///< by the column headings
  };
  std::vector<Loop> loops;
};

/// Runs the deck in `folder` on so many ranks; `program` may be a relative of LAMMPS. Throws RunError with
/// its own words when it fails.
LammpsRun runLammps(const std::filesystem::path& folder, const std::string& deck, int ranks,
                    const std::string& program = "lmp");

/// The command that dumps every so many steps with all digits, for readLammpsDump.
std::string lammpsDumpCommand(const std::string& file, long long every);
/// All snapshots of such a dump, each in order of ids.
std::vector<std::vector<GrainSeed>> readLammpsDump(const std::filesystem::path& file);

} // namespace sandglass::peers
