// VTKHDF (https://docs.vtk.org/en/latest/vtk_file_formats/vtkhdf_file_format/index.html): poly data and
// unstructured grids, with or without steps in time. Points are grains, point arrays their columns; cells
// play no part. Of a step: its parts are PartOffsets[s] .. + NumberOfParts[s], its points begin at
// PointOffsets[s], and those of an array at PointDataOffsets/NAME[s].

#include "sim/io/import/vtkhdf.h"

#include "sim/base/error.h"
#include "sim/io/hdf5.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <numeric>

namespace sandglass {

using namespace hdf5;

namespace {

constexpr std::string_view magic = "\x89HDF\r\n\x1a\n";

class Vtkhdf final : public FrameFormat {
public:
  explicit Vtkhdf(const ImportFile& file) : name_(file.name()), path_(file.path()) {
    if (!file.size() || path_.empty())
      throw InputError(fmt::format("{}: byte 0: a packed HDF5 file cannot be read; unpack it", name_));
    guarded([&] { open(); });
  }

  std::optional<FrameMark> next() override {
    if (at_ == steps_) return std::nullopt;
    FrameMark mark;
    mark.offset = mark.index = at_;
    guarded([&] {
      mark.time = times_.empty() ? staticTime() : std::optional(times_.at(at_));
      if (mark.time && !std::isfinite(*mark.time))
        throw Failure(fmt::format("the time of step {} is no number", at_));
      rowsOf(at_); // throws where its counts make no sense
    });
    ++at_;
    return mark;
  }

  RawFrame read(const FrameMark& mark) override {
    RawFrame frame;
    guarded([&] { load(mark.index, frame); });
    return frame;
  }

private:
  struct Rows {
    hsize_t first = 0, count = 0;
  };

  /// One thread at a time, and Failure as a sentence with the file's name.
  template <class Work> void guarded(Work&& work) const {
    const Session session;
    try {
      work();
    } catch (const Failure& e) {
      throw InputError(fmt::format("{}: {}", name_, e.what()));
    }
  }

  void open() {
    const Handle file = openFile(path_);
    if (!exists(file, "VTKHDF"))
      throw Failure(
          "this HDF5 file has no group /VTKHDF, and HDF5 of other kinds is not read; write the grains as "
          "VTKHDF, .npy or CSV");
    const Handle root = openGroup(file, "VTKHDF");
    const std::string type = readText(root, "Type");
    if (type != "PolyData" && type != "UnstructuredGrid")
      throw Failure(
          fmt::format("it holds {}, but grains are the points of PolyData or UnstructuredGrid; write its "
                      "blocks one by one",
                      type));
    pointCounts_ = readAll<std::int64_t>(root, "NumberOfPoints", 1);
    if (!exists(root, "Steps")) return;
    const Handle steps = openGroup(root, "Steps");
    times_ = readAll<double>(steps, "Values", 1);
    steps_ = times_.size();
    pointOffsets_ = readAll<std::int64_t>(steps, "PointOffsets", 1);
    if (exists(steps, "PartOffsets")) partOffsets_ = readAll<std::int64_t>(steps, "PartOffsets", 1);
    if (exists(steps, "NumberOfParts")) partCounts_ = readAll<std::int64_t>(steps, "NumberOfParts", 1);
  }

  Rows rowsOf(std::uint64_t step) const {
    if (times_.empty()) return rowsOfParts(0, pointCounts_.size(), 0);
    const auto entry = [&](const std::vector<std::int64_t>& list, std::int64_t otherwise) {
      if (list.empty()) return otherwise;
      if (step >= list.size())
        throw Failure(fmt::format("a list of steps has {} entries of {}", list.size(), steps_));
      return list[step];
    };
    const std::int64_t part = entry(partOffsets_, static_cast<std::int64_t>(step)),
                       parts = entry(partCounts_, 1), first = entry(pointOffsets_, -1);
    if (part < 0 || parts < 0 || first < 0)
      throw Failure(fmt::format("the offsets of step {} are below 0 or missing", step));
    return rowsOfParts(static_cast<std::uint64_t>(part), static_cast<std::uint64_t>(parts),
                       static_cast<hsize_t>(first));
  }

  Rows rowsOfParts(std::uint64_t part, std::uint64_t parts, hsize_t first) const {
    if (part > pointCounts_.size() || parts > pointCounts_.size() - part)
      throw Failure(
          fmt::format("parts {} to {} are due, but there are {}", part, part + parts, pointCounts_.size()));
    Rows rows{first, 0};
    for (std::uint64_t k = part; k < part + parts; ++k) {
      const std::int64_t n = pointCounts_[k];
      if (n < 0 || static_cast<std::uint64_t>(n) > mostNumbersInFrame - rows.count)
        throw Failure(
            fmt::format("it counts {} points in a part, but 0 to {} a frame are due", n, mostNumbersInFrame));
      rows.count += static_cast<hsize_t>(n);
    }
    return rows;
  }

  std::optional<double> staticTime() const {
    const Handle file = openFile(path_);
    const Handle root = openGroup(file, "VTKHDF");
    if (!exists(root, "FieldData")) return std::nullopt;
    const Handle fields = openGroup(root, "FieldData");
    for (const char* name : {"TIME", "TimeValue", "time", "Time"})
      if (exists(fields, name) && shape(fields, name) == std::vector<hsize_t>{1})
        return readRows<double>(fields, name, 0, 1, 1)[0];
    return std::nullopt;
  }

  void load(std::uint64_t step, RawFrame& frame) const {
    const Rows rows = rowsOf(step);
    frame.rows = rows.count;
    const Handle file = openFile(path_);
    const Handle root = openGroup(file, "VTKHDF");
    addColumns(root, "Points", rows, frame, true);
    if (!exists(root, "PointData")) return;
    const Handle data = openGroup(root, "PointData");
    for (const auto& name : datasetNames(data)) {
      Rows own = rows;
      if (const auto first = arrayOffset(root, name, step)) own.first = *first;
      addColumns(data, name, own, frame, false);
    }
  }

  std::optional<hsize_t> arrayOffset(hid_t root, const std::string& name, std::uint64_t step) const {
    if (times_.empty()) return std::nullopt;
    const Handle steps = openGroup(root, "Steps");
    if (!exists(steps, "PointDataOffsets")) return std::nullopt;
    const Handle offsets = openGroup(steps, "PointDataOffsets");
    if (!exists(offsets, name)) return std::nullopt;
    const std::int64_t first = readRows<std::int64_t>(offsets, name, step, 1, 1)[0];
    if (first < 0) throw Failure(fmt::format("the offset of '{}' in step {} is below 0", name, step));
    return static_cast<hsize_t>(first);
  }

  static void addColumns(hid_t parent, const std::string& name, const Rows& rows, RawFrame& frame,
                         bool points) {
    const auto lengths = shape(parent, name);
    constexpr hsize_t mostComponents = 4; // tensors have no place in a frame
    const hsize_t parts = lengths.size() == 2 ? lengths[1] : 1;
    if (points && (lengths.size() != 2 || parts != 3))
      throw Failure("its points have not three coordinates each");
    if (lengths.size() > 2 || parts < 1 || parts > mostComponents) return;
    if (rows.count > mostNumbersInFrame / parts)
      throw Failure(fmt::format("a frame has {} x {} numbers, but at most {} are read", rows.count, parts,
                                mostNumbersInFrame));
    const auto flat = readRows<double>(parent, name, rows.first, rows.count, parts);
    for (hsize_t c = 0; c < parts; ++c) {
      RawColumn column;
      column.name = points ? std::string(1, "xyz"[c]) : parts == 1 ? name : fmt::format("{}:{}", name, c);
      column.numbers.reserve(rows.count);
      for (hsize_t k = 0; k < rows.count; ++k)
        column.numbers.push_back(flat[k * parts + c]);
      frame.columns.push_back(std::move(column));
    }
  }

  std::string name_;
  std::filesystem::path path_;
  std::vector<std::int64_t> pointCounts_, pointOffsets_, partOffsets_, partCounts_;
  std::vector<double> times_; ///< empty: the file has no steps
  std::size_t steps_ = 1;
  std::uint64_t at_ = 0;
};

bool isHdf5(const std::filesystem::path& file) {
  char head[magic.size()] = {};
  std::ifstream(file, std::ios::binary).read(head, sizeof head);
  return std::string_view(head, sizeof head) == magic;
}

} // namespace

bool isOwnSegment(const std::filesystem::path& file) {
  const bool named = file.extension() == ".vtkhdf";
  if (!isHdf5(file)) return named;
  const Session session;
  try {
    const Handle opened = openFile(file);
    return exists(opened, "Sandglass") || (named && !exists(opened, "VTKHDF"));
  } catch (const Failure&) {
    return named;
  }
}

ReaderKind vtkhdf() {
  return {"VTKHDF", "the bytes 89 48 44 46 (VTKHDF)",
          [](std::string_view head) { return head.starts_with(magic); },
          [](const ImportFile& file, const ImportSettings&) -> std::unique_ptr<FrameFormat> {
            return std::make_unique<Vtkhdf>(file);
          }};
}

} // namespace sandglass
