#pragma once
// The complete description of a run, resolved: units in SI, defaults filled in, references checked.
// A value type. A scene plus a program version determines a run bit for bit.

#include "sim/base/vec.h"
#include "sim/frame/frame.h"
#include "sim/scene/parameters.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sandglass {

class Sector;

inline bool operator==(const Domain& a, const Domain& b) {
  return a.lower == b.lower && a.upper == b.upper && a.periodic == b.periodic;
}

/// A kind from one of the registries together with its values.
struct Choice {
  std::string kind;
  Parameters parameters;
  bool operator==(const Choice&) const = default;
};

/// A sector of a scene that is its own image under turns by `angle` about an axis through the origin.
struct WedgeSpec {
  double angle = 0; ///< [rad], a whole number of times in a full circle
  std::string axis = "z";
  int sectors() const; ///< in a full circle
  bool operator==(const WedgeSpec&) const = default;
};

struct Material {
  std::string name;
  double density = 0;                  ///< [kg/m^3]; walls' materials need none (0)
  std::optional<double> youngsModulus; ///< [Pa], needed by Hertzian laws
  std::optional<double> poissonRatio;  ///< -1 < nu <= 0.5
  bool operator==(const Material&) const = default;
};

/// How two materials touch. One per unordered pair of materials that can meet.
struct ContactSpec {
  std::string first, second; ///< material names
  Choice normal;             ///< "linear", "hertz", ...
  Choice tangential;         ///< "none", "spring", ... (kind "none" when the scene leaves it out)
  Choice rolling;            ///< "none", "elastic_plastic", ...
  Choice torsion;            ///< about the normal: "none", "elastic_plastic", ...
  std::vector<Choice> gap;   ///< further laws (bridges, ...), usually empty
  bool operator==(const ContactSpec&) const = default;
};

/// Diameters of a species; the registry of distributions is in sim/grains.
struct Species {
  std::string name;
  std::string material;
  bool frozen = false; ///< its grains keep the motion that they come with, whatever pushes them
  Choice size;         ///< "single", "uniform", "normal", "lognormal", "table"
  bool operator==(const Species&) const = default;
};

struct WallSpec {
  std::string name;
  std::string material;
  Choice shape;  ///< a WallKind
  Choice motion; ///< a MotionKind; kind "" for a wall that stands still
  bool operator==(const WallSpec&) const = default;
};

/// One species' share of a filling.
struct Share {
  std::string species;
  double fraction = 1; ///< of number or mass, as FillSpec::byMass says; shares sum to 1
  bool operator==(const Share&) const = default;
};

/// What acts on grains beside contacts and gravity.
struct FieldSpec {
  std::string name;
  Choice what; ///< a FieldKind
  bool operator==(const FieldSpec&) const = default;
};

/// Strength of a field over what the scene says of it.
struct FieldFactor {
  std::string field;
  double factor = 1;
  bool operator==(const FieldFactor&) const = default;
};

struct FillSpec {
  Choice how;                 ///< "random", "rain", "lattice", "list"
  std::vector<Share> mixture; ///< empty for "list", whose rows name their species
  bool byMass = false;
  std::string stage; ///< when it happens: name of a stage; the first by default
  bool operator==(const FillSpec&) const = default;
};

/// When a stage ends: at the first condition met.
struct StageSpec {
  std::string name;
  std::vector<std::string> removeWalls;
  std::vector<FieldFactor> fields;            ///< from now on
  std::optional<double> drag;                 ///< [1/s], rate at which velocities and spins decay meanwhile
  std::optional<double> duration;             ///< [s] from the start of the stage
  std::optional<double> settledKineticEnergy; ///< [J] per grain, mean; checked after `settledAfter`
  std::optional<double> settledSpeed;         ///< [m/s], of the fastest; with both, both must hold
  double settledAfter = 0;                    ///< [s]
  bool untilEmpty = false;                    ///< no grain left
  std::optional<double> massDischarged;       ///< [kg]
  std::optional<double> quietTime;            ///< [s] without any grain leaving
  std::optional<double> recirculations;       ///< grains put back, a multiple of the number at the start or now
  bool operator==(const StageSpec&) const = default;
};

/// What changes at a step of the run, whichever stage that falls into: what somebody changed while the run
/// went on, kept so that the file gives the same bits when it is run again.
struct EventSpec {
  std::int64_t step = 0;                  ///< before which it happens, counted from the start of the run
  std::optional<Vec3> gravity{};          ///< [m/s^2], from now on
  std::optional<double> drag{};           ///< [1/s], until the next stage begins
  std::vector<std::string> removeWalls{}; ///< from now on
  std::vector<FieldFactor> fields{};      ///< from now on
  std::vector<std::string> paceWalls{};   ///< whose motions go at another pace from now on
  std::optional<double> pace{};           ///< as a multiple of what the scene gives them
  bool endStage = false;                  ///< the stage ends after this step
  bool operator==(const EventSpec&) const = default;
};

/// Where an outlet puts grains back: at the lowest free height over what lies in this box.
struct RecycleSpec {
  Vec3 lower = Vec3::Zero(), upper = Vec3::Zero(); ///< [m]
  Vec3 velocity = Vec3::Zero();                    ///< [m/s]
  bool operator==(const RecycleSpec&) const = default;
};

/// Grains beyond this plane (on the side its normal points to) count as discharged and leave the run, unless
/// they are put back.
struct OutletSpec {
  std::string name;
  Vec3 point = Vec3::Zero(), normal = -Vec3::UnitY();
  bool record = false; ///< each grain that leaves gets a row in discharged.csv
  std::optional<RecycleSpec> recycle;
  bool operator==(const OutletSpec&) const = default;
};

struct ProbeSpec {
  std::string name;
  Choice what;         ///< "energies", "mass_in_region", "flow_rate", "wall_force"
  double interval = 0; ///< [s]
  bool operator==(const ProbeSpec&) const = default;
};

struct OutputSpec {
  double frameInterval = 0;            ///< [s]; 0: no frames but the first and the last
  double checkpointInterval = 0;       ///< [s] simulated; 0: chosen so that a run leaves 20
  std::vector<std::string> quantities; ///< optional quantities to write
  bool contacts = false;
  bool singlePrecisionPositions = false;
  bool operator==(const OutputSpec&) const = default;
};

/// The knobs that trade speed for accuracy.
struct AccuracySpec {
  std::string level = "standard"; ///< "draft", "standard", "reference"
  double stepsPerContact = 0;     ///< steps in the shortest collision; > 0 after resolution
  std::optional<double> timeStep; ///< [s], when the scene fixes it
  double stiffnessScale = 1;      ///< of all contacts; 1: as the laws say
  bool semiImplicit = false;      ///< velocities are those of the full step, and errors of first order
  bool mixedPrecision = false;    ///< pairs in single precision, sums and motion in double
  bool fastArithmetic = false;    ///< roots and quotients to two units in the last place
  double skin = 0;                ///< list skin as a share of the mean grain diameter
  double maximumOverlap = 0;      ///< share of the smaller radius at which the run stops
  double maximumTravel = 0;       ///< share of the smallest radius that a grain may go in a step
  bool operator==(const AccuracySpec&) const = default;
};

struct Scene {
  std::string title, description;
  std::string file; ///< where it came from; for messages only
  std::uint64_t seed = 1;
  std::string solver = "dem";
  Vec3 gravity = Vec3(0, 0, -9.81); ///< [m/s^2]
  Domain domain;
  std::optional<WedgeSpec> wedge;
  std::vector<Material> materials;
  std::vector<ContactSpec> contacts;
  std::vector<Species> species;
  std::vector<WallSpec> walls;
  std::vector<FieldSpec> fields;
  std::vector<FillSpec> fills;
  std::vector<OutletSpec> outlets;
  std::vector<StageSpec> stages;
  std::vector<EventSpec> events; ///< in the order of their steps
  std::vector<ProbeSpec> probes;
  OutputSpec output;
  AccuracySpec accuracy;

  Sector sector() const; ///< of the wedge; the whole circle without
  const Material& material(const std::string& name) const;
  const Species& speciesNamed(const std::string& name) const;
  const ContactSpec& contact(const std::string& a, const std::string& b) const;
  bool operator==(const Scene&) const = default;
};

/// Reads and checks a scene. Throws InputError with every fault found.
/// `overrides`: "key.path=value" as --set gives them, checked like the file itself.
Scene readScene(const std::string& file, const std::vector<std::string>& overrides = {});
Scene parseScene(const std::string& tomlText, const std::string& nameForMessages,
                 const std::vector<std::string>& overrides = {}, const std::string& baseFolder = ".");

/// The resolved scene as TOML: reading it again gives the same Scene.
std::string writeScene(const Scene& scene);

/// Hash of writeScene() without title and description: the scene's name in provenance.
std::string sceneHash(const Scene& scene);

} // namespace sandglass
