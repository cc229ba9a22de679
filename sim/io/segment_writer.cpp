#include "sim/base/error.h"
#include "sim/io/frame_segment.h"
#include "sim/io/hdf5.h"
#include "sim/io/wall_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

namespace sandglass {

using namespace hdf5;

namespace {

constexpr hsize_t grainRows = 8192; ///< a chunk: 192 kB of positions, small beside HDF5's chunk cache
constexpr hsize_t stepRows = 64;
constexpr std::array<const char*, 4> cellKinds{"Vertices", "Lines", "Polygons", "Strips"};

/// Everything that must not change within one file.
struct Signature {
  std::vector<std::string> scalars, vectors, walls, species;
  std::map<std::string, std::string> provenance;
  std::array<bool, 3> periodic;
  std::vector<GrainShape> shapes;
  bool persistentIds, oriented;

  explicit Signature(const Frame& frame)
      : species(frame.speciesNames), provenance(frame.provenance), periodic(frame.domain.periodic),
        shapes(frame.shapes), persistentIds(frame.persistentIds), oriented(!frame.orientation.empty()) {
    for (const auto& [name, values] : frame.scalars)
      scalars.push_back(name);
    for (const auto& [name, values] : frame.vectors)
      vectors.push_back(name);
    for (const auto& wall : frame.walls)
      walls.push_back(wall.name);
  }
  bool operator==(const Signature&) const = default;
};

std::vector<std::int64_t> countUp(std::int64_t n) {
  std::vector<std::int64_t> numbers(n);
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

} // namespace

struct SegmentWriter::Impl {
  std::filesystem::path path;
  Signature signature;
  Handle file, vtk, steps, own, ownSteps;
  Column points, partPoints, times, partOffsets, partCounts, pointOffsets, cellOffsets, connectivityOffsets;
  struct Cells {
    Column counts, connectivityCounts, offsets, connectivity;
  };
  std::array<Cells, 4> cells;
  std::map<std::string, Column> data, dataOffsets;
  Column step, stage, lower, upper, contactCount, wallActive;
  std::map<std::string, Column> wallVectors; ///< three numbers a wall
  Column wallRotation, wallSums;
  Handle contactGroup;
  std::map<std::string, Column> contacts;
  std::vector<std::string> stageNames; ///< written at the end, when all are known
  std::int64_t count = 0;

  Impl(const std::filesystem::path& p, const Frame& first) : path(p), signature(first) {}

  /// HDF5 closes a file with its last object: all others first, so that a fault shows when the file closes.
  void closeAll() {
    Handle last = std::move(file);
    *this = Impl(path, Frame{});
    last.close();
  }

  void create(const std::string& sceneText, bool single) {
    file = createFile(path);
    vtk = createGroup(file, "VTKHDF");
    writeAttribute(vtk, "Version", {2, 0}, false);
    writeAttribute(vtk, "Type", "PolyData");
    points = Column(vtk, "Points", single ? H5T_NATIVE_FLOAT : H5T_NATIVE_DOUBLE, {3}, grainRows);
    partPoints = Column(vtk, "NumberOfPoints", H5T_NATIVE_INT64, {}, stepRows);
    for (std::size_t k = 0; k < cellKinds.size(); ++k) {
      const Handle group = createGroup(vtk, cellKinds[k]);
      cells[k].counts = Column(group, "NumberOfCells", H5T_NATIVE_INT64, {}, stepRows);
      cells[k].connectivityCounts = Column(group, "NumberOfConnectivityIds", H5T_NATIVE_INT64, {}, stepRows);
      cells[k].offsets = Column(group, "Offsets", H5T_NATIVE_INT64, {}, k == 0 ? grainRows : stepRows);
      cells[k].connectivity =
          Column(group, "Connectivity", H5T_NATIVE_INT64, {}, k == 0 ? grainRows : stepRows);
    }
    steps = createGroup(vtk, "Steps");
    times = Column(steps, "Values", H5T_NATIVE_DOUBLE, {}, stepRows);
    partOffsets = Column(steps, "PartOffsets", H5T_NATIVE_INT64, {}, stepRows);
    partCounts = Column(steps, "NumberOfParts", H5T_NATIVE_INT64, {}, stepRows);
    pointOffsets = Column(steps, "PointOffsets", H5T_NATIVE_INT64, {}, stepRows);
    cellOffsets = Column(steps, "CellOffsets", H5T_NATIVE_INT64, {4}, stepRows);
    connectivityOffsets = Column(steps, "ConnectivityIdOffsets", H5T_NATIVE_INT64, {4}, stepRows);
    createPointData();
    createOwn(sceneText);
  }

  void createPointData() {
    const Handle pointData = createGroup(vtk, "PointData");
    const Handle offsets = createGroup(steps, "PointDataOffsets");
    const auto add = [&](const std::string& name, hid_t type, std::vector<hsize_t> tail) {
      data[name] = Column(pointData, name, type, std::move(tail), grainRows);
      dataOffsets[name] = Column(offsets, name, H5T_NATIVE_INT64, {}, stepRows);
    };
    add("id", H5T_NATIVE_INT64, {});
    for (const auto& name : signature.scalars)
      add(name, H5T_NATIVE_DOUBLE, {});
    for (const auto& name : signature.vectors)
      add(name, H5T_NATIVE_DOUBLE, {3});
    if (signature.oriented) add(quantity::orientation, H5T_NATIVE_DOUBLE, {4});
  }

  void createOwn(const std::string& sceneText) {
    own = createGroup(file, "Sandglass");
    writeAttribute(own, "formatVersion", std::vector<std::int64_t>{1}, true);
    writeAttribute(own, "persistentIds", std::vector<std::int64_t>{signature.persistentIds}, true);
    const auto& periodic = signature.periodic;
    writeAttribute(own, "periodic", std::vector<std::int64_t>{periodic[0], periodic[1], periodic[2]}, false);
    writeTextDataset(own, "scene", sceneText);
    writeTexts(own, "wallNames", signature.walls);
    writeTexts(own, "speciesNames", signature.species);
    writeShapes();
    const Handle provenance = createGroup(own, "provenance");
    for (const auto& [key, value] : signature.provenance)
      writeAttribute(provenance, key, value);

    ownSteps = createGroup(own, "Steps");
    step = Column(ownSteps, "step", H5T_NATIVE_INT64, {}, stepRows);
    stage = Column(ownSteps, "stage", H5T_NATIVE_INT32, {}, stepRows);
    lower = Column(ownSteps, "domainLower", H5T_NATIVE_DOUBLE, {3}, stepRows);
    upper = Column(ownSteps, "domainUpper", H5T_NATIVE_DOUBLE, {3}, stepRows);
    contactCount = Column(ownSteps, "contactCount", H5T_NATIVE_INT64, {}, stepRows);
    const hsize_t n = signature.walls.size();
    if (n == 0) return; // HDF5 has no chunks of zero width
    wallActive = Column(ownSteps, "wallActive", H5T_NATIVE_UINT8, {n}, stepRows);
    for (const auto& [name, member] : wallVectorNames)
      wallVectors[name] = Column(ownSteps, name, H5T_NATIVE_DOUBLE, {n, 3}, stepRows);
    wallRotation = Column(ownSteps, wallRotationName, H5T_NATIVE_DOUBLE, {n, 4}, stepRows);
    wallSums = Column(ownSteps, wallSumsName, H5T_NATIVE_DOUBLE, {n, 5}, stepRows);
  }

  void writeShapes() {
    if (signature.shapes.empty()) return;
    std::vector<double> rows;
    for (const auto& [axes, e1, e2] : signature.shapes)
      rows.insert(rows.end(), {axes.x(), axes.y(), axes.z(), e1, e2});
    Column(own, "shapes", H5T_NATIVE_DOUBLE, {5}, stepRows).append(rows.data(), signature.shapes.size());
  }

  void appendVtk(const Frame& frame) {
    const std::int64_t n = static_cast<std::int64_t>(frame.size()), one = 1, none = 0;
    const std::int64_t firstPoint = static_cast<std::int64_t>(points.rows());
    times.append(&frame.time, 1);
    partOffsets.append(&count, 1);
    partCounts.append(&one, 1);
    pointOffsets.append(&firstPoint, 1);
    // Readers add the number of parts before this one to a cell offset, since each part's list of offsets is
    // one longer than its cells: these count cells, not entries of the list.
    const std::array<std::int64_t, 4> offsets{firstPoint, 0, 0, 0};
    cellOffsets.append(offsets.data(), 1);
    connectivityOffsets.append(offsets.data(), 1);
    points.append(n > 0 ? frame.position.front().data() : nullptr, n);
    partPoints.append(&n, 1);
    const auto upTo = countUp(n + 1);
    cells[0].counts.append(&n, 1);
    cells[0].connectivityCounts.append(&n, 1);
    cells[0].offsets.append(upTo.data(), n + 1);
    cells[0].connectivity.append(upTo.data(), n);
    for (int k = 1; k < 4; ++k) {
      cells[k].counts.append(&none, 1);
      cells[k].connectivityCounts.append(&none, 1);
      cells[k].offsets.append(&none, 1);
    }
    for (auto& [name, column] : dataOffsets)
      column.append(&firstPoint, 1);
    data.at("id").append(frame.id.data(), n);
    for (const auto& [name, values] : frame.scalars)
      data.at(name).append(values.data(), n);
    for (const auto& [name, values] : frame.vectors)
      data.at(name).append(n > 0 ? values.front().data() : nullptr, n);
    if (!signature.oriented) return;
    std::vector<double> turns; // w, x, y, z, as VTK's glyphs take them
    turns.reserve(4 * frame.size());
    for (const auto& q : frame.orientation)
      turns.insert(turns.end(), {q.w(), q.x(), q.y(), q.z()});
    data.at(quantity::orientation).append(turns.data(), n);
  }

  void appendOwn(const Frame& frame) {
    step.append(&frame.step, 1);
    const auto known = std::find(stageNames.begin(), stageNames.end(), frame.stage);
    const auto stageIndex = static_cast<std::int32_t>(known - stageNames.begin());
    if (known == stageNames.end()) stageNames.push_back(frame.stage);
    stage.append(&stageIndex, 1);
    lower.append(frame.domain.lower.data(), 1);
    upper.append(frame.domain.upper.data(), 1);
    const auto contactsNow = static_cast<std::int64_t>(frame.contacts.size());
    contactCount.append(&contactsNow, 1);
    if (!frame.walls.empty()) {
      std::vector<std::uint8_t> active;
      std::vector<double> rotation, sums;
      std::map<std::string, std::vector<double>> vectors;
      for (const auto& wall : frame.walls) {
        active.push_back(wall.active);
        for (const auto& [name, member] : wallVectorNames)
          vectors[name].insert(vectors[name].end(), (wall.*member).data(), (wall.*member).data() + 3);
        const auto& q = wall.rotation;
        rotation.insert(rotation.end(), {q.w(), q.x(), q.y(), q.z()});
        sums.insert(sums.end(), {wall.moving ? 1.0 : 0.0, wall.work, wall.power, wall.wearWork,
                                 static_cast<double>(wall.collisions)});
      }
      wallActive.append(active.data(), 1);
      for (auto& [name, values] : vectors)
        wallVectors[name].append(values.data(), 1);
      wallRotation.append(rotation.data(), 1);
      wallSums.append(sums.data(), 1);
    }
    if (contactsNow > 0) appendContacts(frame.contacts);
  }

  void appendContacts(const std::vector<FrameContact>& list) {
    if (contacts.empty()) {
      contactGroup = createGroup(own, "Contacts");
      for (const char* name : {"a", "b"})
        contacts[name] = Column(contactGroup, name, H5T_NATIVE_INT64, {}, grainRows);
      contacts["wall"] = Column(contactGroup, "wall", H5T_NATIVE_INT32, {}, grainRows);
      contacts["image"] = Column(contactGroup, "image", H5T_NATIVE_INT32, {3}, grainRows);
      contacts["overlap"] = Column(contactGroup, "overlap", H5T_NATIVE_DOUBLE, {}, grainRows);
      for (const char* name : {"point", "normal", "force"})
        contacts[name] = Column(contactGroup, name, H5T_NATIVE_DOUBLE, {3}, grainRows);
    }
    const auto gather = [&](const std::string& name, auto value) {
      std::vector<decltype(value(list.front()))> rows;
      rows.reserve(list.size());
      for (const auto& contact : list)
        rows.push_back(value(contact));
      return rows;
    };
    const auto a = gather("a", [](const FrameContact& c) { return c.a; });
    const auto b = gather("b", [](const FrameContact& c) { return c.b; });
    const auto wall = gather("wall", [](const FrameContact& c) { return static_cast<std::int32_t>(c.wall); });
    const auto overlap = gather("overlap", [](const FrameContact& c) { return c.overlap; });
    contacts["overlap"].append(overlap.data(), overlap.size());
    const auto image = gather("image", [](const FrameContact& c) { return c.image; });
    contacts["a"].append(a.data(), a.size());
    contacts["b"].append(b.data(), b.size());
    contacts["wall"].append(wall.data(), wall.size());
    contacts["image"].append(image.front().data(), image.size());
    const auto appendVectors = [&](const std::string& name, Vec3 FrameContact::*member) {
      const auto rows = gather(name, [member](const FrameContact& c) { return c.*member; });
      contacts[name].append(rows.front().data(), rows.size());
    };
    appendVectors("point", &FrameContact::point);
    appendVectors("normal", &FrameContact::normal);
    appendVectors("force", &FrameContact::force);
  }
};

SegmentWriter::SegmentWriter(const std::filesystem::path& file, const std::string& sceneText,
                             const Frame& first, bool singlePrecisionPositions)
    : impl_(std::make_unique<Impl>(file, first)) {
  const Session session;
  try {
    impl_->create(sceneText, singlePrecisionPositions);
  } catch (const Failure& failure) {
    throw RunError(fmt::format("{}: {}; check the folder and the free space", file.string(), failure.what()));
  }
}

SegmentWriter::~SegmentWriter() {
  const Session session;
  impl_.reset();
}

bool SegmentWriter::accepts(const Frame& frame) const {
  Signature given(frame);
  if (frame.size() == 0) given.oriented = impl_->signature.oriented;
  return given == impl_->signature;
}

void SegmentWriter::append(const Frame& frame) {
  const Session session;
  try {
    impl_->appendVtk(frame);
    impl_->appendOwn(frame);
    ++impl_->count;
  } catch (const Failure& failure) {
    throw RunError(fmt::format("{}: {}", impl_->path.string(), failure.what()));
  }
}

void SegmentWriter::close() {
  const Session session;
  try {
    writeAttribute(impl_->steps, "NSteps", std::vector<std::int64_t>{impl_->count}, true);
    writeTexts(impl_->own, "stageNames", impl_->stageNames);
    if (H5Fflush(impl_->file, H5F_SCOPE_LOCAL) < 0)
      throw Failure("cannot finish writing (is the disk full?)");
    impl_->closeAll();
  } catch (const Failure& failure) {
    throw RunError(fmt::format("{}: {}", impl_->path.string(), failure.what()));
  }
}

std::uint64_t SegmentWriter::bytes() const {
  const Session session;
  hsize_t size = 0;
  return impl_->file >= 0 && H5Fget_filesize(impl_->file, &size) >= 0 ? size : 0;
}

} // namespace sandglass
