#pragma once
// Three sets of rules for the states of grains in a vortex, all thresholds by name.
//
// "listed": those of the program in the appendix of H. E. Rice, Simulation and Phases of Macroscopic
// Particles in Vortex Flow (M.S. thesis, University of Mississippi, 2012); "text": those of its chapter 3,
// which differ in two places; "own": ours, in times instead of frames, free of units, with windows that
// slide.
//
//   settled. Listed and text: over 500 frames, mean |dE| / (1 + E) <= 3e-5 and no centre above the
//     tank. Own: means of the halves of 0.5 s differ by <= 5 %, and the same height.
//   fluid. All: >= 90 % of the last 1500 frames (own: 1.5 s), in which bins rise outwards by >= 0.1 r
//     and at most one does not.
//   pinned. Listed: innermost centre beyond 2 r in 1000 frames, counted over the whole run. Text:
//     beyond R - 2 r in 1000 of 2000 frames. Own: beyond max(2 r, R / 4) in 50 % of the last 1.5 s.
//   spout, of c grains within 3/4 R that rise by r/100 a frame more than the mean (own: 0.2 sqrt(g r)
//     faster). Listed: 5 <= c < n/8 (small), 5 <= c < n/4 (large) in 2000 frames running. Text: large
//     from n/8. Own: n/50 <= c < n/4 in 90 % of the last 1.5 s, large when the mean c >= n/8, and about
//     an open core.
//
// Where several hold, large spout goes before small spout, pinned, fluid, flat. Flat is settled and nothing
// else. Ours asks more than 2 r of an empty core because thin beds have larger holes by chance.

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace sandglass::analysis {

enum class VortexState { unresolved = 0, flat = 1, fluid = 2, pinned = 3, smallSpout = 4, largeSpout = 5 };

/// "unresolved", "flat", "fluid", "pinned", "small spout", "large spout".
const char* nameOf(VortexState state);

struct VortexRules {
  std::string name;          ///< "listed", "text" or "own"
  bool sliding = false;      ///< own: windows end now; else as the source has them
  bool pinnedAtWall = false; ///< text: every centre near the wall; else an empty core
  bool pinnedAddsUp = false; ///< listed: frames count over the whole run, in no window
  bool spoutsApart = false;  ///< text: a large spout begins where a small one ends
  double settleWindow = 0;   ///< frames (source) or seconds (own), like all windows
  double settleDrift = 0;    ///< greatest change of energy that is settled
  double heightLimit = 0; ///< [m] above the floor, that no centre reaches; 0: the tank's top, at most 20/3 R
  double fluidWindow = 0;
  double fluidShare = 0.9;    ///< of the frames
  double fluidViolations = 1; ///< bins that may fail to rise
  double pinnedWindow = 0;
  double pinnedShare = 0.5;   ///< of the frames
  double pinnedCore = 2;      ///< empty core in grain radii, or the margin at the wall
  double pinnedCoreShare = 0; ///< and in tank radii (own)
  double spoutWindow = 0;
  double spoutShare = 1;     ///< of the frames
  double spoutLeast = 5;     ///< rising grains at least: a number, or a share of all where below 1
  double spoutSmall = 0.125; ///< share of the grains below which a spout is small
  double spoutLarge = 0.25;  ///< share from which it is no spout
  double spoutCore = 0; ///< mean radius of the empty core, in tank radii, below which nothing spouts (own):
                        ///< grains of a flat bed that hovers rise and fall too, but none flow up its middle

  /// Every number by name, with what it means, for tables and pictures.
  std::vector<std::pair<std::string, double>> thresholds() const;
};

VortexRules listedVortexRules();
VortexRules textVortexRules();
VortexRules ownVortexRules();
/// By name. Throws InputError naming the three.
VortexRules vortexRules(const std::string& name);

} // namespace sandglass::analysis
