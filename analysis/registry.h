#pragma once
// The list of analyses. Each is one entry: its name, what it needs from a Frame, its knobs, and how to make
// one. The command line makes an option of each, the desktop a panel; neither knows them one by one.
// To add one: a file in analysis/kinds with the entry, a line in registry.cpp, a line in docs/analysis.md.
//
//   const AnalysisKind& kind = analysisKind("bond_angles");
//   Parameters knobs = defaultKnobs(kind);
//   setKnob(knobs, kind, "cutoff", "1.4");          // or knobs.set("cutoff", 1.4)
//   AnalysisContext context;                        // up, gates, limits, diameter, seed
//   if (auto why = reasonAgainst(kind, *frame, context); !why.empty()) ...;
//   auto work = makeAnalysis(kind, knobs, context);
//   work->add(*frame);                              // as many as there are, in order of time
//   Results results = work->results();

#include "analysis/region.h"
#include "analysis/results.h"
#include "analysis/run_facts.h"
#include "sim/frame/frame.h"
#include "sim/scene/parameters.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sandglass::analysis {

/// What an analysis wants to know and a Frame does not say.
struct AnalysisContext {
  RunFacts facts;       ///< of the scene where there is one; `up` alone is often enough
  RegionOptions limits; ///< lower, upper and surfaceMargin [m]; the rest is set by the analysis
  double diameter = 0;  ///< [m]; 0: twice the mean radius of the first Frame
  std::uint64_t seed = 1;
};

/// What a Frame must have.
struct AnalysisNeeds {
  std::vector<std::string> quantities; ///< names as in sim/frame/frame.h
  bool contacts = false;               ///< contacts with forces
  bool persistentIds = false;          ///< the same grain has the same id in each Frame
  bool up = false;                     ///< gravity
  std::size_t grains = 1;              ///< at least
  std::size_t frames = 1;              ///< at least; 2 or more: it looks at how things change
};

/// An analysis at work. Results may be asked for at any time, again and again. Not thread-safe; uses the
/// calling thread's TBB arena.
class Analysis {
public:
  virtual ~Analysis() = default;
  /// Frames in ascending order of time. Throws InputError with a sentence when this one cannot be used.
  virtual void add(const Frame& frame) = 0;
  /// Throws InputError when there is nothing to tell from.
  virtual Results results() const = 0;
};

struct AnalysisKind {
  std::string name;        ///< snake_case; the option is the same with dashes
  std::string title;       ///< for menus: "Bond angles"
  std::string description; ///< one phrase for help texts
  std::string source;      ///< formula's paper or book, short
  AnalysisNeeds needs;
  std::vector<ParameterSpec> knobs; ///< all have a fallback; lengths in mean grain diameters
  /// For makeAnalysis().
  std::unique_ptr<Analysis> (*make)(const Parameters& knobs, const AnalysisContext& context) = nullptr;
};

/// One at work. Of a wedge it looks at the whole circle (analysis/whole_circle.h) and says so; values of
/// single grains are those of the Frame's own.
std::unique_ptr<Analysis> makeAnalysis(const AnalysisKind& kind, const Parameters& knobs,
                                       const AnalysisContext& context);

/// All, in the order of the documentation.
const std::vector<AnalysisKind>& analysisKinds();

/// Throws InputError naming those there are.
const AnalysisKind& analysisKind(const std::string& name);

/// Every knob at its fallback.
Parameters defaultKnobs(const AnalysisKind& kind);

/// Checks type, range and choices. Throws InputError: knob, value found, rule.
void setKnob(Parameters& knobs, const AnalysisKind& kind, const std::string& knob, const std::string& text);

/// Why this Frame cannot be analysed so, as a sentence; empty when it can.
std::string reasonAgainst(const AnalysisKind& kind, const Frame& frame, const AnalysisContext& context);

/// All in one call. Throws InputError with the reason against the first Frame.
Results analyze(const AnalysisKind& kind, const Parameters& knobs, const AnalysisContext& context,
                const std::vector<FramePtr>& frames);

} // namespace sandglass::analysis
