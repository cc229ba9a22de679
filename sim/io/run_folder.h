#pragma once
// The files of a run: scene.toml, frames/, series.csv, checkpoints/, log.txt.
// A kill at any moment leaves every closed segment and a checkpoint readable.

#include "sim/base/log.h"
#include "sim/frame/frame.h"
#include "sim/scene/scene.h"
#include "sim/solvers/solver.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace sandglass {

struct ImportSettings;

/// Random access to the frames of one source (a run folder, a segment, a file of another program, many of
/// them).
class FrameSource {
public:
  virtual ~FrameSource() = default;
  virtual std::size_t size() const = 0;
  virtual double time(std::size_t index) const = 0; ///< [s]
  virtual FramePtr load(std::size_t index) const = 0;
  virtual std::string name() const = 0; ///< path as the user gave it
  /// Look for frames written since (a run still going); true when there are more.
  virtual bool refresh() { return false; }
  /// Whether size() counts all that the source holds. While it does not, refresh() looks on for a moment.
  virtual bool complete() const { return true; }
  /// The resolved scene that goes with the frames; empty when there is none.
  virtual std::string sceneText() const { return {}; }
  /// Sentences for the user: what was taken for granted, and where a file stops making sense.
  virtual std::vector<std::string> remarks() const { return {}; }
};

/// Opens a run folder, a .vtkhdf file, a file of another program (sim/io/import/reader_table.h) or all files
/// that a pattern fits. Throws InputError with a sentence. Without settings those that lie beside a foreign
/// file hold.
std::unique_ptr<FrameSource> openFrames(const std::filesystem::path& path,
                                        const ImportSettings* settings = nullptr);

/// Writes segments: frames/00000.vtkhdf, ... VTKHDF PolyData with Steps. Temporary name, closed, synced,
/// renamed. Segments close at 64 MB or 30 s of wall time.
class FrameWriter {
public:
  virtual ~FrameWriter() = default;
  virtual void write(const Frame& frame) = 0;
  virtual void closeSegment() = 0; ///< everything written so far is safe afterwards
  virtual void closeIfOld() = 0;   ///< closes a segment that has been open for 30 s; for quiet times
};
std::unique_ptr<FrameWriter> makeFrameWriter(const std::filesystem::path& runFolder, const Scene& scene);

/// Atomic checkpoint files: last two alternating, spaced ones kept.
void writeCheckpoint(const std::filesystem::path& file, const Solver::State& state);
Solver::State readCheckpoint(const std::filesystem::path& file); ///< throws InputError when torn or foreign

/// VTP and .pvd for readers older than VTK 9.3; any frames in, a folder or file out.
void exportVtp(const Frame& frame, const std::filesystem::path& file);
void exportPvd(FrameSource& frames, const std::filesystem::path& pvdFile, const Log& log = {});

} // namespace sandglass
