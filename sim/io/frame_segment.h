#pragma once
// One frame file: VTKHDF 2.0 PolyData with Steps, and our own groups beside it. docs/files.md lists both.
//
//   /VTKHDF      Points, one vertex cell a grain, PointData (id and every quantity), Steps
//   /Sandglass   scene (text), wallNames, speciesNames, stageNames, provenance (attributes),
//                Steps (step, stage, domain, walls) and Contacts, one row or a run of rows a frame

#include "sim/frame/frame.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

namespace sandglass {

/// Writes one file. Not readable by anyone before close() returned.
class SegmentWriter {
public:
  /// The file's columns are those of `first`, which is not yet written.
  SegmentWriter(const std::filesystem::path& file, const std::string& sceneText, const Frame& first,
                bool singlePrecisionPositions);
  ~SegmentWriter();
  /// Whether `frame` has the quantities, walls, species and provenance of this file.
  bool accepts(const Frame& frame) const;
  void append(const Frame& frame); ///< throws RunError
  void close();                    ///< throws RunError
  std::uint64_t bytes() const;     ///< size of the file so far

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Gives the shape of a wall by name; throws InputError when there is no such wall.
using WallShapes = std::function<std::shared_ptr<const WallShape>(const std::string&)>;

/// Random access to one closed file. Every function throws InputError when the file is torn or foreign.
class SegmentReader {
public:
  explicit SegmentReader(const std::filesystem::path& file);
  ~SegmentReader();
  std::size_t size() const;
  double time(std::size_t index) const; ///< [s]
  std::int64_t step(std::size_t index) const;
  std::string sceneText() const;
  Frame load(std::size_t index, const WallShapes& shapes) const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace sandglass
