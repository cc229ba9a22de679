#include "tests/validate/analysis/lammps_frames.h"

#include "analysis/neighbour_list.h"
#include "analysis/pair_correlation.h"
#include "analysis/steinhardt.h"
#include "analysis/voronoi.h"
#include "sim/base/random.h"
#include "sim/io/import/import_settings.h"
#include "sim/io/run_folder.h"
#include "tests/analysis/lattices.h"
#include "tests/peers/lammps.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <sstream>

namespace sandglass::validate {

using namespace analysis;

namespace {

constexpr double shellReach = 1.25, farthest = 3; ///< in diameters
constexpr int bins = 150;

/// fcc of touching spheres, opened by a tenth and each centre displaced by up to 0.08 in each direction.
Frame sample() {
  Frame frame = test::crystal(Vec3::Constant(1.1 * std::sqrt(2.0)), test::faceCentred, {6, 6, 6});
  RandomStream random(11, RandomPurpose::test, 0);
  for (auto& x : frame.position)
    for (int k = 0; k < 3; ++k) {
      x[k] += random.uniform(-0.08, 0.08);
      const double size = frame.domain.upper[k];
      x[k] -= size * std::floor(x[k] / size);
    }
  for (std::size_t i = 0; i < frame.size(); ++i)
    frame.id[i] = static_cast<std::int64_t>(i) + 1;
  return frame;
}

void writeData(const Frame& frame, const std::filesystem::path& file) {
  std::ofstream out(file);
  out << fmt::format("points\n\n{} atoms\n1 atom types\n", frame.size());
  for (int k = 0; k < 3; ++k)
    out << fmt::format("0 {0} {1}lo {1}hi\n", frame.domain.upper[k], "xyz"[k]);
  out << "\nMasses\n\n1 1\n\nAtoms\n\n";
  for (std::size_t i = 0; i < frame.size(); ++i)
    out << fmt::format("{} 1 {} {} {}\n", frame.id[i], frame.position[i].x(), frame.position[i].y(),
                       frame.position[i].z());
}

const char* const deck = R"(units lj
atom_style atomic
boundary p p p
read_data points.data
pair_style zero 3.0
pair_coeff * *
neighbor 0.3 bin
compute r all rdf 150
compute q all orientorder/atom degrees 2 4 6 nnn NULL cutoff 1.25
compute v all voronoi/atom
fix r all ave/time 1 1 1 c_r[*] file rdf.txt mode vector format " %.15g"
dump d all custom 1 atoms.dump id x y z c_q[1] c_q[2] c_v[1]
dump_modify d format float %.15g
run 0
)";

/// Largest difference of two columns.
double apart(const std::vector<double>& a, const std::vector<double>& b) {
  double worst = a.size() == b.size() && !a.empty() ? 0 : INFINITY;
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k)
    worst = std::max(worst, std::abs(a[k] - b[k]));
  return worst;
}

std::vector<double> rdfOf(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::vector<double> g;
  for (std::string line; std::getline(in, line);) {
    std::istringstream cells(line);
    double row = 0, r = 0, value = 0, sum = 0;
    if (!line.starts_with("#") && cells >> row >> r >> value >> sum) g.push_back(value);
  }
  return g;
}

} // namespace

void lammpsFrames(Report& report) {
  const std::string name = "the same frame through LAMMPS", version = peers::lammpsVersion();
  const char* const quantities[] = {"largest difference of g(r)", "largest difference of a grain's q4",
                                    "largest difference of a grain's q6",
                                    "largest difference of a cell's volume, relative"};
  if (version.empty()) {
    for (const char* quantity : quantities)
      report.recorded(name, quantity, 0, 0, "0", "LAMMPS", "lammps is not installed");
    return;
  }
  const peers::ScratchFolder scratch;
  const Frame ours = sample();
  writeData(ours, scratch.path() / "points.data");
  peers::runLammps(scratch.path(), deck, 1);
  // Back through the reader of dumps, with all digits.
  ImportSettings settings;
  settings.radius = 0.5;
  settings.columns = {{"q4", "c_q[1]"}, {"q6", "c_q[2]"}, {"cell", "c_v[1]"}};
  const FramePtr theirs = openFrames(scratch.path() / "atoms.dump", &settings)->load(0);

  PairCorrelationOptions options;
  options.diameter = 1;
  options.rMax = farthest;
  options.bins = bins;
  report.between(name, quantities[0],
                 apart(pairCorrelation(*theirs, options).g.series.at(0).y, rdfOf(scratch.path() / "rdf.txt")),
                 0, 0, 1e-10, version + ", compute rdf");
  const NeighbourList near = neighboursWithin(theirs->position, theirs->domain, shellReach);
  const Bonds bonds{near.start, near.index, near.vector, {}};
  report.between(name, quantities[1], apart(magnitudes(bondOrder(bonds, 4)), theirs->scalar("q4")), 0, 0,
                 1e-10, version + ", compute orientorder/atom");
  report.between(name, quantities[2], apart(magnitudes(bondOrder(bonds, 6)), theirs->scalar("q6")), 0, 0,
                 1e-10, version + ", compute orientorder/atom");
  report.between(name, quantities[3], apart(voronoiCells(*theirs, {}).volume, theirs->scalar("cell")), 0, 0,
                 1e-10, version + ", compute voronoi/atom");
}

} // namespace sandglass::validate
