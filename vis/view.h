#pragma once
// Everything needed to draw a Frame the same way twice: camera, colouring, clipping, representation.
// A value type, saved as TOML, embedded in every PNG.

#include "sim/base/vec.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sandglass::vis {

struct Camera {
  Vec3 position = Vec3(0, -1, 0), target = Vec3::Zero(), up = Vec3::UnitZ(); ///< [m]
  double viewAngle = 30;                                                     ///< [deg], perspective
  bool orthographic = false;
  double orthographicHeight = 1; ///< [m], when orthographic
  std::string preset = "fit"; ///< "fit", "front", "back", "left", "right", "top", "bottom", "iso": resolved
                              ///< against the scene's bounds at draw time; "" uses the numbers above
};

enum class ColourRange { frame, run, fixed };

/// Colour by one number for each grain.
struct Colouring {
  /// What grainScalar() understands; "original.x" (y, z): where the grain was in the run's first frame, in
  /// bands the stripes of dyed layers; "" for one colour.
  std::string quantity = "speed";
  std::string map = "dune"; ///< perceptually uniform maps, see colourMaps()
  bool reversed = false;    ///< the map turned round
  int bands = 0;            ///< more than 0: so many steps instead of a smooth map
  ColourRange range = ColourRange::frame;
  double low = 0, high = 1; ///< for ColourRange::fixed and, once known, ::run
  std::array<double, 3> plain{0.85, 0.78, 0.62};
};

/// Keeps what lies on the side that `normal` points to.
struct ClipPlane {
  Vec3 point = Vec3::Zero(), normal = Vec3::UnitX();
};

/// Keeps what lies inside, or outside, a box along the axes.
struct ClipBox {
  Vec3 lower = Vec3::Zero(), upper = Vec3::Ones(); ///< [m]
  bool inside = true;
};

/// Keeps what lies inside, or outside, an endless cylinder.
struct ClipCylinder {
  Vec3 point = Vec3::Zero(), axis = Vec3::UnitZ();
  double radius = 1; ///< [m]
  bool inside = true;
};

/// Grains chosen by an expression over their quantities, such as "z > 0.05 && speed < 0.1" (see selection.h),
/// or by name; where there are both, those that fulfil both.
struct Selection {
  enum class Use { only, hide, highlight };
  std::string expression; ///< empty: no choice
  Use use = Use::only;    ///< draw only these, all but these, or these in their colour and the others pale
  std::vector<std::int64_t> grains; ///< ids; empty: no choice
};

/// Contacts as tubes from centre to centre (or to the point on the wall), as thick and coloured as the force.
struct ForceChains {
  bool shown = false;
  double width = 0;   ///< [m] thickness of a tube that carries the highest force; 0: the mean grain radius
  double minimum = 0; ///< contacts with less than this share of the mean force are left out
  double highest = 0; ///< [N] the force of full thickness and colour; 0: the largest of the frame
  std::string map = "inferno";
};

/// A vector of each grain as an arrow from its centre.
struct Arrows {
  std::string vector; ///< "velocity", "spin", "force", any vector of the frames; "": none
  double scale = 0;   ///< metres of arrow for one SI unit; 0: the longest of the frame has four mean radii
  int maximum = 3000; ///< an even subset when there are more grains
  std::array<double, 3> colour{0.10, 0.10, 0.12};
};

/// Where chosen grains have been until now.
struct Tracks {
  std::vector<std::int64_t> grains; ///< ids
  double duration = 0;              ///< [s] back from the picture's time; 0: since the first frame
};

/// A plane through a coarse-grained field of the frame.
struct FieldSlice {
  bool shown = false;
  std::string field;    ///< name of the field; "": the first
  std::string quantity; ///< an array; of a vector "velocity" its magnitude |velocity|, or "velocity.x"
  Vec3 point = Vec3::Zero(), normal = Vec3::UnitY(); ///< ignored by fields that are flat themselves
  std::string map = "viridis";
  ColourRange range = ColourRange::frame; ///< ::run is taken as ::fixed once low and high are known
  double low = 0, high = 1, opacity = 1;
  std::string streamlines; ///< a vector array whose lines are drawn from points of the plane, or ""
};

struct View {
  Camera camera;
  Colouring colouring;
  std::vector<ClipPlane> clips;
  std::vector<ClipBox> clipBoxes;
  std::vector<ClipCylinder> clipCylinders;
  Selection selection;
  ForceChains forceChains;
  Arrows arrows;
  Tracks tracks;
  FieldSlice slice;
  bool grains = true, walls = true, axes = true, legend = true, timeStamp = true, scaleBar = true;
  bool removedWalls = false;         ///< show walls that a stage has removed
  bool wallEdges = true, box = true; ///< feature edges of walls; the domain where it is periodic or bare
  double wallOpacity = 0.18;
  double grainScale = 1; ///< radii are drawn this much larger: small grains that let chains be seen
  std::array<int, 3> periodicImages{0, 0,
                                    0}; ///< copies of everything on each side, along periodic directions
  bool meshes = false; ///< superellipsoids as triangle meshes: slow, to check the ray-cast ones
  std::string title;   ///< empty: the scene's
  std::array<double, 3> background{1, 1, 1};
  bool transparentBackground = false;
  int width = 1280, height = 720; ///< [pixel]
  int supersampling = 1;          ///< pixels drawn for each pixel of the picture, in each direction
  int maximumGrains = 0;          ///< 0: all; else an even subset is drawn (while the camera moves)
};

View readView(const std::string& file); ///< throws InputError, every fault at once
View parseView(const std::string& toml, const std::string& nameForMessages);
std::string writeView(const View& view); ///< TOML; reading it gives the same View
std::vector<std::string> colourMaps();

} // namespace sandglass::vis
