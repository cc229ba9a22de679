#pragma once
// Everything needed to draw a Frame the same way twice: camera, colouring, clipping, representation.
// A value type, saved as TOML, embedded in every PNG.

#include "sim/base/vec.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace sandglass::vis {

struct Camera {
  Vec3 position = Vec3(0, -1, 0), target = Vec3::Zero(), up = Vec3::UnitZ(); ///< [m]
  double viewAngle = 30;          ///< [deg], perspective
  bool orthographic = false;
  double orthographicHeight = 1;  ///< [m], when orthographic
  std::string preset = "fit";     ///< "fit", "front", "back", "left", "right", "top", "bottom", "iso": resolved
                                  ///< against the scene's bounds at draw time; "" uses the numbers above
};

enum class ColourRange { frame, run, fixed };

struct Colouring {
  std::string quantity = "speed"; ///< what grainScalar() understands, or "" for one colour
  std::string map = "dune";       ///< perceptually uniform maps, see colourMaps()
  ColourRange range = ColourRange::frame;
  double low = 0, high = 1;       ///< for ColourRange::fixed and, once known, ::run
  std::array<double, 3> plain{0.85, 0.78, 0.62};
};

/// Keeps what lies on the side that `normal` points to.
struct ClipPlane {
  Vec3 point = Vec3::Zero(), normal = Vec3::UnitX();
};

struct View {
  Camera camera;
  Colouring colouring;
  std::vector<ClipPlane> clips;
  bool grains = true, walls = true, axes = true, legend = true, timeStamp = true, scaleBar = true;
  bool removedWalls = false;      ///< show walls that a stage has removed
  double wallOpacity = 0.18;
  std::string title;              ///< empty: the scene's
  std::array<double, 3> background{1, 1, 1};
  bool transparentBackground = false;
  int width = 1280, height = 720; ///< [pixel]
  int maximumGrains = 0;          ///< 0: all; else an even subset is drawn (while the camera moves)
};

View readView(const std::string& file);           ///< throws InputError, every fault at once
View parseView(const std::string& toml, const std::string& nameForMessages);
std::string writeView(const View& view);          ///< TOML; reading it gives the same View
std::vector<std::string> colourMaps();

} // namespace sandglass::vis
