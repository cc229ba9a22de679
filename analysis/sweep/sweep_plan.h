#pragma once
// What a sweep is to do: a SWEEP.toml, read strictly. docs/sweep.md tells users the same.
//
//   scene = "../vortex_tank/scene.toml"       # what all runs have in common
//   set = ["stage.run.until.duration=\"2 s\""] # changes for all of them, as --set takes them
//   seeds = 3                                 # replicates: the scene's seed and the next two; or a list
//   sampling = "grid"                         # or "random", "latin_hypercube" with points = 100
//   [[axis]]
//   name = "r"                                # column, variable of expressions
//   key = "species.bead.size.diameter"        # what it changes in the scene; may be left out
//   unit = "mm"                               # of the numbers below and in the table
//   values = [4, 6, 8]                        # or from, to, count, scale = "linear" | "log"
//   [[derived]]
//   name = "omega"
//   key = "field.vortex.rotation"
//   unit = "rad/s"
//   value = "ratio * 42.94 * (r / 120)^1.5"   # of axes and of what is derived before it
//   [refine]
//   levels = 2                                # more points between neighbours that disagree, twice
//   by = "state"

#include "sim/scene/scene.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace sandglass::analysis {

/// A cell of the table: nothing, a number, a text.
using SweepValue = std::variant<std::monostate, double, std::string>;

struct SweepAxis {
  std::string name, unit = "1";
  std::vector<std::string> keys;  ///< of the scene, dotted; may be empty
  std::vector<double> numbers;    ///< ascending or as written; of random sampling the two limits
  std::vector<std::string> texts; ///< instead of numbers
  bool logarithmic = false;
  bool isText() const { return !texts.empty(); }
  std::size_t size() const { return isText() ? texts.size() : numbers.size(); }
};

struct SweepDerived {
  std::string name, unit = "1", expression;
  std::vector<std::string> keys;
  bool whole = false; ///< rounded to the nearest whole number
};

enum class SweepSampling { grid, random, latinHypercube };

struct SweepPlan {
  std::string title;
  std::string file;                 ///< for messages
  std::string text;                 ///< the SWEEP.toml
  std::string sceneFile, sceneText; ///< of the base scene
  std::vector<std::string> set;
  std::vector<SweepAxis> axes;
  std::vector<SweepDerived> derived;
  std::vector<std::uint64_t> seeds;
  SweepSampling sampling = SweepSampling::grid;
  std::size_t points = 0; ///< of random and Latin hypercube sampling
  std::uint64_t samplingSeed = 1;
  int refineLevels = 0;
  std::string refineBy = "state"; ///< column that neighbours are compared by
  double refineDifference = 0;    ///< of a column of numbers: what is still alike
  double sampleInterval = 0;      ///< [s] between the frames that are classified; 0: the scene's frames
  std::string states = "auto";    ///< "auto", "vortex", "none"
  Parameters thresholds;          ///< [thresholds]: knobs of the analysis vortex_states, all of them
  bool stateMap = false;          ///< shares of solid, liquid and gas at the end, beside the states
};

/// Reads the plan and the scene that it names. Throws InputError with every fault.
SweepPlan readSweep(const std::filesystem::path& file);
/// From texts that a table kept; `sceneText` in place of the scene's file.
SweepPlan parseSweep(const std::string& text, const std::string& nameForMessages,
                     const std::filesystem::path& folder, const std::optional<std::string>& sceneText = {});

/// One point: a value for each axis.
struct SweepPoint {
  int id = 0;                        ///< from 1, in the order in which points are run
  int level = 0;                     ///< 0, then the round of refinement that added it
  std::vector<std::int64_t> lattice; ///< of a grid: position along each axis in units of 1 / 2^refineLevels
  std::vector<SweepValue> values;    ///< of the axes, then of what is derived
};

/// What is derived from the axes' values. Throws InputError for an expression that is none.
std::vector<SweepValue> deriveValues(const SweepPlan& plan, const std::vector<SweepValue>& axes);

/// "key=value" for --set, for the whole point.
std::vector<std::string> overridesOf(const SweepPlan& plan, const SweepPoint& point);

/// The point's scene with one of the plan's seeds. Throws InputError.
Scene sceneOf(const SweepPlan& plan, const SweepPoint& point, std::uint64_t seed);

} // namespace sandglass::analysis
