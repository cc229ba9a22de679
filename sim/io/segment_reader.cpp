#include "sim/base/error.h"
#include "sim/io/frame_segment.h"
#include "sim/io/hdf5.h"
#include "sim/io/wall_columns.h"
#include "sim/walls/posed_shape.h"

#include <fmt/format.h>

#include <cstring>

namespace sandglass {

using namespace hdf5;

namespace {

std::vector<Vec3> toVectors(const std::vector<double>& flat) {
  std::vector<Vec3> vectors(flat.size() / 3);
  for (std::size_t i = 0; i < vectors.size(); ++i)
    vectors[i] = Vec3(flat[3 * i], flat[3 * i + 1], flat[3 * i + 2]);
  return vectors;
}

std::vector<Eigen::Quaterniond> toTurns(const std::vector<double>& flat) {
  std::vector<Eigen::Quaterniond> turns;
  turns.reserve(flat.size() / 4);
  for (std::size_t i = 0; i < flat.size(); i += 4)
    turns.emplace_back(flat[i], flat[i + 1], flat[i + 2], flat[i + 3]);
  return turns;
}

} // namespace

struct SegmentReader::Impl {
  std::filesystem::path path;
  Handle file, vtk, own, ownSteps;
  std::vector<double> times;
  std::vector<std::int64_t> steps, counts, firstPoints, contactCounts;
  std::vector<std::string> stages, wallNames, speciesNames;
  std::map<std::string, std::string> provenance;
  std::vector<GrainShape> shapes;
  std::array<bool, 3> periodic{};
  bool persistentIds = true;

  void open() {
    file = openFile(path);
    if (!exists(file, "VTKHDF") || !exists(file, "Sandglass"))
      throw Failure("it lacks the groups /VTKHDF and /Sandglass that a Sandglass run writes");
    vtk = openGroup(file, "VTKHDF");
    own = openGroup(file, "Sandglass");
    if (const auto version = readNumbers(own, "formatVersion"); version != std::vector<std::int64_t>{1})
      throw Failure(fmt::format("its format version is {} and this program reads 1",
                                version.empty() ? "missing" : std::to_string(version.front())));
    ownSteps = openGroup(own, "Steps");
    const Handle vtkSteps = openGroup(vtk, "Steps");
    times = readAll<double>(vtkSteps, "Values", 1);
    firstPoints = readAll<std::int64_t>(vtkSteps, "PointOffsets", 1);
    counts = readAll<std::int64_t>(vtk, "NumberOfPoints", 1);
    steps = readAll<std::int64_t>(ownSteps, "step", 1);
    contactCounts = readAll<std::int64_t>(ownSteps, "contactCount", 1);
    const auto stageNames = readTexts(own, "stageNames");
    for (const auto index : readAll<std::int32_t>(ownSteps, "stage", 1)) {
      if (index < 0 || static_cast<std::size_t>(index) >= stageNames.size())
        throw Failure(fmt::format("it names stage {} of {}", index, stageNames.size()));
      stages.push_back(stageNames[index]);
    }
    for (const std::size_t n :
         {firstPoints.size(), counts.size(), steps.size(), contactCounts.size(), stages.size()})
      if (n != times.size())
        throw Failure(fmt::format("its lists of steps have {} and {} entries", times.size(), n));
    for (const auto* list : {&firstPoints, &counts, &contactCounts})
      for (const std::int64_t n : *list)
        if (n < 0) throw Failure(fmt::format("it counts {} grains or contacts in a step", n));
    wallNames = readTexts(own, "wallNames");
    speciesNames = readTexts(own, "speciesNames");
    if (exists(own, "shapes")) {
      const auto rows = readAll<double>(own, "shapes", 5);
      for (std::size_t i = 0; i < rows.size(); i += 5)
        shapes.push_back({Vec3(rows[i], rows[i + 1], rows[i + 2]), rows[i + 3], rows[i + 4]});
    }
    const auto flags = readNumbers(own, "periodic");
    if (flags.size() != 3) throw Failure("its attribute 'periodic' has not three entries");
    for (int k = 0; k < 3; ++k)
      periodic[k] = flags[k] != 0;
    persistentIds = readNumbers(own, "persistentIds") != std::vector<std::int64_t>{0};
    const Handle keys = openGroup(own, "provenance");
    for (const auto& key : attributeNames(keys))
      provenance[key] = readText(keys, key);
  }

  Vec3 stepVector(const char* name, std::size_t index) const {
    return toVectors(readRows<double>(ownSteps, name, index, 1, 3)).front();
  }

  void loadGrains(Frame& frame, std::size_t index) const {
    const auto first = static_cast<hsize_t>(firstPoints[index]), count = static_cast<hsize_t>(counts[index]);
    frame.position = toVectors(readRows<double>(vtk, "Points", first, count, 3));
    const Handle data = openGroup(vtk, "PointData");
    for (const auto& name : datasetNames(data)) {
      const auto lengths = shape(data, name);
      if (name == "id")
        frame.id = readRows<std::int64_t>(data, name, first, count, 1);
      else if (name == quantity::orientation)
        frame.orientation = toTurns(readRows<double>(data, name, first, count, 4));
      else if (lengths.size() == 1)
        frame.scalars[name] = readRows<double>(data, name, first, count, 1);
      else
        frame.vectors[name] = toVectors(readRows<double>(data, name, first, count, 3));
    }
    if (frame.id.size() != count) throw Failure("it has no array 'id'");
  }

  void loadWalls(Frame& frame, std::size_t index, const WallShapes& shapes) const {
    const hsize_t n = wallNames.size();
    if (n == 0) return;
    const auto active = readRows<std::uint8_t>(ownSteps, "wallActive", index, 1, n);
    frame.walls.resize(n);
    for (std::size_t w = 0; w < n; ++w) {
      frame.walls[w].name = wallNames[w];
      frame.walls[w].shape = shapes(wallNames[w]);
      frame.walls[w].active = active[w] != 0;
    }
    for (const auto& [name, member] : wallVectorNames) {
      if (!exists(ownSteps, name)) continue; // files of before walls could move lack some
      const auto vectors = toVectors(readRows<double>(ownSteps, name, index, 1, 3 * n));
      for (std::size_t w = 0; w < n; ++w)
        frame.walls[w].*member = vectors[w];
    }
    if (!exists(ownSteps, wallRotationName)) return;
    const auto rotation = readRows<double>(ownSteps, wallRotationName, index, 1, 4 * n);
    const auto sums = readRows<double>(ownSteps, wallSumsName, index, 1, 5 * n);
    for (std::size_t w = 0; w < n; ++w) {
      FrameWall& wall = frame.walls[w];
      const double *q = &rotation[4 * w], *sum = &sums[5 * w];
      wall.rotation = Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
      wall.moving = sum[0] != 0.0;
      wall.work = sum[1];
      wall.power = sum[2];
      wall.wearWork = sum[3];
      wall.collisions = static_cast<std::int64_t>(sum[4]);
      WallPose pose;
      pose.translation = wall.translation;
      pose.turned = !(q[0] == 1.0 && q[1] == 0.0 && q[2] == 0.0 && q[3] == 0.0);
      if (pose.turned) pose.rotation = wall.rotation.normalized().toRotationMatrix();
      wall.shape = posed(wall.shape, pose);
    }
  }

  void loadContacts(Frame& frame, std::size_t index) const {
    const auto count = static_cast<hsize_t>(contactCounts[index]);
    if (count == 0) return;
    hsize_t first = 0;
    for (std::size_t i = 0; i < index; ++i)
      first += static_cast<hsize_t>(contactCounts[i]);
    const Handle group = openGroup(own, "Contacts");
    const auto a = readRows<std::int64_t>(group, "a", first, count, 1);
    const auto b = readRows<std::int64_t>(group, "b", first, count, 1);
    const auto wall = readRows<std::int32_t>(group, "wall", first, count, 1);
    const auto image = readRows<std::int32_t>(group, "image", first, count, 3);
    const auto vectors = [&](const char* name) {
      return toVectors(readRows<double>(group, name, first, count, 3));
    };
    const auto point = vectors("point"), normal = vectors("normal"), force = vectors("force");
    const auto overlap = exists(group, "overlap") // files of earlier versions have none
                             ? readRows<double>(group, "overlap", first, count, 1)
                             : std::vector<double>(count, 0.0);
    for (std::size_t i = 0; i < count; ++i)
      frame.contacts.push_back({a[i],
                                b[i],
                                wall[i],
                                {image[3 * i], image[3 * i + 1], image[3 * i + 2]},
                                point[i],
                                normal[i],
                                force[i],
                                overlap[i]});
  }

  [[noreturn]] void refuse(const Failure& failure) const {
    throw InputError(
        fmt::format("{}: this is no whole frame file of Sandglass ({}); leave it out or run again",
                    path.string(), failure.what()));
  }
};

SegmentReader::SegmentReader(const std::filesystem::path& file) : impl_(std::make_unique<Impl>()) {
  const Session session;
  impl_->path = file;
  try {
    impl_->open();
  } catch (const Failure& failure) {
    impl_->refuse(failure);
  }
}

SegmentReader::~SegmentReader() {
  const Session session;
  impl_.reset();
}

std::size_t SegmentReader::size() const {
  return impl_->times.size();
}
double SegmentReader::time(std::size_t index) const {
  return impl_->times.at(index);
}
std::int64_t SegmentReader::step(std::size_t index) const {
  return impl_->steps.at(index);
}

std::string SegmentReader::sceneText() const {
  const Session session;
  try {
    return readTextDataset(impl_->own, "scene");
  } catch (const Failure& failure) {
    impl_->refuse(failure);
  }
}

Frame SegmentReader::load(std::size_t index, const WallShapes& shapes) const {
  const Session session;
  Frame frame;
  frame.time = impl_->times.at(index);
  frame.step = impl_->steps[index];
  frame.stage = impl_->stages[index];
  frame.persistentIds = impl_->persistentIds;
  frame.speciesNames = impl_->speciesNames;
  frame.shapes = impl_->shapes;
  frame.provenance = impl_->provenance;
  try {
    frame.domain = {impl_->stepVector("domainLower", index), impl_->stepVector("domainUpper", index),
                    impl_->periodic};
    impl_->loadGrains(frame, index);
    impl_->loadWalls(frame, index, shapes);
    impl_->loadContacts(frame, index);
  } catch (const Failure& failure) {
    impl_->refuse(failure);
  }
  return frame;
}

} // namespace sandglass
