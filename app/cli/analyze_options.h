#pragma once
// What `sandglass analyze` is asked for, and the small languages of its options.

#include "analysis/pair_correlation.h"
#include "app/cli/import_options.h"

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sandglass::cli {

struct AnalyzeOptions {
  std::vector<std::string> sources;
  std::string folder;
  bool packing = false, discharge = false, energies = false, beverloo = false, all = false;
  bool contacts = false, residence = false, outflow = false, heap = false;
  std::string impactMap;  ///< a scene
  double impactSpeed = 0; ///< [m/s]; 0: slow
  bool csvOnly = false;
  std::string rMax = "5d", estimator = "E3", frames, diameter, margin, shares, depth, probe, flowingDensity;
  std::vector<std::string> limits;
  int bins = 200;
  std::vector<std::string> kinds; ///< names of analyses asked for
  std::vector<std::string> knobs; ///< "gr.bins=400"
  std::string up;                 ///< "0,0,1"
  std::string heights, radii;     ///< of profiles: "8 cm,12 cm" or "5d,10d"
  bool list = false;
  ImportArguments import;
};

/// "5d" in grain diameters, "12 mm" or "0.012" in metres. Throws InputError naming the option.
double lengthOption(const std::string& option, const std::string& text, double diameter);

/// "8 cm,12 cm" or "0,5d": any sign, in metres. Throws InputError naming the option.
std::vector<double> placesOption(const std::string& option, const std::string& text, double diameter);

/// "y>1cm", "x<0": limits laid into the region. Throws InputError.
void addLimits(const std::vector<std::string>& limits, analysis::RegionOptions& region);

/// "0,0,1": a unit vector. Throws InputError naming the option.
Vec3 directionOption(const std::string& option, const std::string& text);

/// "A:B", "A:", ":B", "A", ":": first and last index, both used. Throws InputError when none is left.
std::pair<std::size_t, std::size_t> frameRange(const std::string& text, std::size_t count,
                                               const std::string& source);

/// "0.1:0.5". Throws InputError.
std::pair<double, double> shareRange(const std::string& text);

} // namespace sandglass::cli
