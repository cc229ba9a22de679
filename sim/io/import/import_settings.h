#pragma once
// What a file of frames does not say: which column is which, units, box, radii, times, walls. Kept in a small
// TOML file, so that it is written once for a lab's or a program's files and used again:
//
//   [columns]                  # quantity = "name of the column"; docs/formats.md lists the quantities
//   radius = "R_eff"
//   velocity.x = "U0"
//   ignore = ["proc"]
//   [units]                    # of the numbers in the file
//   length = "mm"
//   time = "ms"
//   mass = "g"
//   [time]
//   step = "1e-5 s"            # time of a step, where the file counts steps
//   interval = "1 ms"          # time between frames, where it counts nothing
//   [box]
//   lower = ["0 mm", "0 mm", "0 mm"]
//   upper = ["10 mm", "5 mm", "80 mm"]
//   periodic = "y"
//   [grains]
//   radius = "1.5 mm"          # where the file has none
//   radius_of = { 1 = "1 mm", 2 = "2 mm" }   # by species
//   shape = "diameters"        # what shapex, shapey, shapez are: "diameters" or "semi-axes"
//   [walls]
//   files = ["hopper.stl"]     # triangles, or a scene whose walls, gravity and outlets hold
//   unit = "mm"                # of the triangles

#include "sim/base/vec.h"

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace sandglass {

struct ImportSettings {
  std::map<std::string, std::string> columns; ///< quantity -> name in the file; "" = leave it out
  std::vector<std::string> ignored;           ///< names in the file
  double length = 1, time = 1, mass = 1;      ///< [m], [s], [kg] that the file's units are
  std::optional<double> timeStep;             ///< [s] a step
  std::optional<double> frameInterval;        ///< [s] from frame to frame
  std::optional<Vec3> lower, upper;           ///< [m]
  std::optional<std::array<bool, 3>> periodic;
  std::optional<double> radius;           ///< [m]
  std::map<std::string, double> radiusOf; ///< [m] by species
  std::string shape;                      ///< "diameters", "semi-axes" or "": as the columns' names tell
  std::vector<std::filesystem::path> walls;
  double wallUnit = 1; ///< [m]
  bool operator==(const ImportSettings&) const = default;

  bool ignores(const std::string& column) const;
};

/// Throws InputError with every fault found. Names of files are taken from the folder of `file`.
ImportSettings readImportSettings(const std::filesystem::path& file);
ImportSettings parseImportSettings(const std::string& toml, const std::string& nameForMessages,
                                   const std::filesystem::path& folder = {});
/// Reading it again gives the same settings.
std::string writeImportSettings(const ImportSettings& settings);

/// A length, time or mass as text ("3 mm") or as a number in SI units. Throws InputError naming `what`.
double importQuantity(const std::string& what, const std::string& text, const std::string& siUnit);
/// "xy", "none": directions in which the box repeats. Throws InputError.
std::array<bool, 3> periodicDirections(const std::string& what, const std::string& text);

/// The settings that lie beside a file: NAME.import.toml, else import.toml in its folder; none when neither
/// is there.
std::optional<std::filesystem::path> importSettingsBeside(const std::filesystem::path& file);
/// What they say; without them the defaults. Throws InputError.
ImportSettings settingsBeside(const std::filesystem::path& file);

} // namespace sandglass
