#pragma once
// What a solver publishes and everyone else reads. Mandatory: time, step, id, position. Everything else is
// optional and asked for by name. Immutable once published, shared by pointer, the only thing that crosses
// threads. Imported snapshots become Frames too.

#include "sim/base/vec.h"
#include "sim/walls/wall_shape.h"

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace sandglass {

/// Names of the standard optional quantities (SI units).
namespace quantity {
inline constexpr const char* radius = "radius";     ///< scalar [m]
inline constexpr const char* mass = "mass";         ///< scalar [kg]
inline constexpr const char* species = "species";   ///< scalar, index into Frame::speciesNames
inline constexpr const char* shape = "shape";       ///< scalar, index into Frame::shapes, or -1: a sphere
inline constexpr const char* velocity = "velocity"; ///< vector [m/s]
inline constexpr const char* spin = "spin";         ///< vector [rad/s]
inline constexpr const char* orientation = "orientation"; ///< Frame::orientation
inline constexpr const char* force = "force";       ///< vector [N], all forces on the grain
inline constexpr const char* residenceTime = "residence_time"; ///< scalar [s] since it entered or was put back
inline constexpr const char* life = "life";         ///< scalar, how often an outlet has put it back
} // namespace quantity

/// The space of the scene. Where `periodic[k]` is false, lower/upper merely bound what is there.
struct Domain {
  Vec3 lower = Vec3::Zero(), upper = Vec3::Zero(); ///< [m]
  std::array<bool, 3> periodic{false, false, false};
};

/// A wall as it stands at the time of the Frame.
struct FrameWall {
  std::string name;
  std::shared_ptr<const WallShape> shape; ///< geometry where it is now; never null
  bool active = true;                     ///< false once a stage has removed it (an opened gate)
  Vec3 velocity = Vec3::Zero();           ///< [m/s] of the reference point
  Vec3 force = Vec3::Zero();              ///< [N], force of the grains on the wall
  Vec3 torque = Vec3::Zero();             ///< [N m] about the reference point
  Vec3 spin = Vec3::Zero();               ///< [rad/s]
  /// [m] A point on the axis of a wall that turns; else the middle of the shape (0 along directions in which
  /// it has no end), which moves with the wall.
  Vec3 reference = Vec3::Zero();
  bool moving = false;                                          ///< has a motion, even while it stands still
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity(); ///< from the scene's description to now
  Vec3 translation = Vec3::Zero();                              ///< [m], applied after the rotation
  double work = 0;     ///< [J] that the moving wall has done on the grains since the run began
  double power = 0;    ///< [W] of it now
  double wearWork = 0; ///< [J] of tangential forces along the slip; 0 unless a probe looks at the wall
  std::int64_t collisions = 0; ///< contacts begun; 0 unless a probe looks at the wall
};

/// A contact between grain `a` and grain `b` (or wall `wall` when b < 0).
struct FrameContact {
  std::int64_t a = -1, b = -1;       ///< grain ids
  int wall = -1;                     ///< index into Frame::walls, or -1
  std::array<int, 3> image{0, 0, 0}; ///< periodic image of b
  Vec3 point = Vec3::Zero();         ///< [m]
  Vec3 normal = Vec3::Zero();        ///< unit, from b (or wall) to a
  Vec3 force = Vec3::Zero();         ///< [N] on a
  double overlap = 0;                ///< [m]; negative: a gap, across which a law acts
};

/// A superellipsoid (Barr 1981, doi:10.1109/MCG.1981.1673799) in its own axes:
///   (|x/a|^(2/e2) + |y/b|^(2/e2))^(e2/e1) + |z/c|^(2/e1) = 1
/// e1 shapes the profile along z, e2 the section across it: 1 is round, towards 0 box-like, 2 an octahedron.
/// Codes that write blockiness n1, n2 have e1 = 2 / n1, e2 = 2 / n2.
struct GrainShape {
  Vec3 semiAxes = Vec3::Ones(); ///< a, b, c [m]
  double e1 = 1, e2 = 1;        ///< 0 < e <= 2: convex
  bool operator==(const GrainShape&) const = default;
};

/// Averages on a regular grid (the points of a VTK image), coarse-grained from the grains.
struct FrameField {
  std::string name;
  std::array<int, 3> points{1, 1, 1};                   ///< along x, y, z; 1 along a direction averaged over
  Vec3 origin = Vec3::Zero(), spacing = Vec3::Ones();   ///< [m] first point, distance of points
  std::map<std::string, std::vector<double>> scalars{}; ///< one value a point, x fastest; NaN: nothing there
  std::map<std::string, std::vector<Vec3>> vectors{};
  std::map<std::string, std::string> units{}; ///< SI symbols by array name
  std::size_t size() const {
    return static_cast<std::size_t>(points[0]) * static_cast<std::size_t>(points[1]) *
           static_cast<std::size_t>(points[2]);
  }
};

struct Frame {
  double time = 0; ///< [s]
  std::int64_t step = 0;
  std::string stage;                                  ///< name of the stage it was taken in; may be empty
  bool persistentIds = true;                          ///< whether an id means the same grain in another frame
  std::vector<std::int64_t> id;                       ///< ascending for frames of our own solvers
  std::vector<Vec3> position;                         ///< [m]; inside the domain along periodic directions
  std::map<std::string, std::vector<double>> scalars; ///< one value per grain each
  std::map<std::string, std::vector<Vec3>> vectors;   ///< one vector per grain each
  std::vector<std::string> speciesNames;
  Domain domain;
  std::vector<FrameWall> walls;
  std::vector<FrameContact> contacts;            ///< empty unless asked for
  std::vector<GrainShape> shapes;                ///< those that quantity::shape counts; empty: all spheres
  /// From a grain's own axes to the scene's, one for each grain; empty where nothing turns visibly.
  std::vector<Eigen::Quaterniond> orientation;
  std::vector<FrameField> fields; ///< of this moment; not written into frame files
  std::map<std::string, std::string> provenance; ///< scene hash, version, seed, solver, accuracy, step size

  std::size_t size() const { return position.size(); }
  bool has(const std::string& name) const {
    return scalars.contains(name) || vectors.contains(name) ||
           (name == quantity::orientation && !orientation.empty());
  }
  /// Throw InputError (one sentence naming the quantity and those present) when it is not there.
  const std::vector<double>& scalar(const std::string& name) const;
  const std::vector<Vec3>& vector(const std::string& name) const;
};

using FramePtr = std::shared_ptr<const Frame>;

/// One number per grain for colouring, selection and histograms: any scalar by name; for a vector `v` its
/// magnitude `|v|` and components `v.x` `v.y` `v.z`; the shorthands `x` `y` `z` `speed` `id`.
/// Throws InputError when the Frame does not have it.
std::vector<double> grainScalar(const Frame& frame, const std::string& expression);

/// Everything grainScalar() understands on this Frame, for menus and error messages.
std::vector<std::string> grainScalarNames(const Frame& frame);

/// SI unit of such a quantity as text ("m/s", "rad/s", "" when unknown or dimensionless).
std::string unitOf(const std::string& expression);

} // namespace sandglass
