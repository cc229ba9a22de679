#pragma once
// The cases of the dry hopper: which beds each needs and how it judges them. Numbers (V5, ...) are those
// under which docs/validation quotes them.

#include "tests/validate/hopper/runs.h"
#include "tests/validate/verdicts.h"

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace sandglass::validate {

struct HopperCase {
  std::string name, title;
  std::vector<HopperBed> beds;
  std::function<void(const HopperRuns&, Report&)> judge;
};

std::vector<HopperCase> pairCases();      ///< V1, V28: two grains, conservation
std::vector<HopperCase> rateCases();      ///< V5, V6, V11: base rate, outlet and bin width
std::vector<HopperCase> frictionCases();  ///< V7 to V10: fill height, friction, restitution
std::vector<HopperCase> shapeCases();     ///< V12 to V14: diameter, depth and rolling, half angle
std::vector<HopperCase> courseCases();    ///< V15, V25: end of the steady range, heap left behind
std::vector<HopperCase> mixtureCases();   ///< V16: two sizes
std::vector<HopperCase> allHopperCases(); ///< in order of their numbers

// What several families use.
inline constexpr double unbounded = std::numeric_limits<double>::infinity();
inline const std::string anand = "Anand 2009";
/// The base bed; emptied, so that one run serves all cases.
HopperBed baseBed();
/// Outlets of V6 and the slot law fitted to them.
std::vector<HopperBed> outletBeds();
double fittedK(const HopperRuns& runs);
/// Rates with error bars against something.
analysis::Series measuredSeries(const HopperRuns& runs, const std::vector<HopperBed>& beds,
                                const std::vector<double>& x);
/// Two points for a value expected over a range.
analysis::Series levelSeries(const std::string& name, double low, double high, double value);

} // namespace sandglass::validate
