#pragma once
// The results of a sweep in one SQLite file, sweep.sqlite in the folder of the sweep. docs/sweep.md has its
// tables for those who ask it directly.
//
// It grows by one transaction a run, with the journal synced to disk before: a kill at any moment leaves a
// whole table that lacks the runs that were going on. Reading while a sweep writes is allowed, from other
// processes too. Not thread-safe: one object per thread, or a lock.
//
//   const SweepTable table(folder);                       // for reading
//   for (const SweepRow& row : table.rows())              // a row a run: axes, derived, results
//     ... table.column("state") ... row.text(table.column("state"))
//   Scene scene = table.scene(row.run);                   // run it: the same bits as in the sweep
//   FramePtr last = table.lastFrame(row.run);             // what was kept of it
//   std::vector<Curve> curves = table.curves(row.run);

#include "analysis/result.h"
#include "analysis/sweep/sweep_plan.h"
#include "sim/frame/frame.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace sandglass::analysis {

enum class SweepRole { axis, derived, result };

struct SweepColumn {
  std::string name, unit; ///< SI symbol or the axis's unit; "" when dimensionless
  SweepRole role = SweepRole::result;
  bool text = false;
  std::string description;
};

enum class SweepStatus { waiting, done, failed };
const char* nameOf(SweepStatus status);

/// One run of one point.
struct SweepRow {
  int run = 0, point = 0, replicate = 0, level = 0;
  std::uint64_t seed = 0;
  SweepStatus status = SweepStatus::waiting;
  std::string fault;              ///< why it failed
  std::vector<SweepValue> values; ///< one for each column
  /// NaN where there is no number in this column.
  double number(std::size_t column) const;
  std::string text(std::size_t column) const;
};

/// What a run leaves in the table.
struct SweepOutcome {
  SweepStatus status = SweepStatus::done;
  std::string fault;
  std::vector<std::pair<SweepColumn, SweepValue>> results;
  std::vector<Curve> curves; ///< one series each
  FramePtr last;             ///< null: none
  double seconds = 0;        ///< of computing; beside the results, since it is another each time
};

class SweepTable {
public:
  static constexpr const char* fileName = "sweep.sqlite";
  enum class Access { read, write };

  /// Opens the table of a folder, or a table's file itself. Throws InputError when there is none or it is not
  /// one, RunError for faults of SQLite.
  explicit SweepTable(const std::filesystem::path& folder, Access access = Access::read);
  /// A new table with its plan and the points of level 0, all runs waiting.
  static SweepTable create(const std::filesystem::path& file, const SweepPlan& plan);
  SweepTable(SweepTable&&) noexcept;
  ~SweepTable();

  const SweepPlan& plan() const;
  const std::vector<SweepColumn>& columns() const;   ///< axes, derived, results
  std::size_t column(const std::string& name) const; ///< index. Throws InputError naming those there are.
  std::vector<SweepPoint> points() const;            ///< by id
  std::vector<SweepRow> rows() const;                ///< by run
  SweepRow row(int run) const;                       ///< Throws InputError when there is none.
  Scene scene(int run) const;                        ///< Throws InputError
  FramePtr lastFrame(int run) const; ///< id, position, radius, velocity and walls; null where none was kept
  std::vector<Curve> curves(int run) const;
  double seconds(int run) const;                  ///< of computing; 0 when it has not run
  std::string info(const std::string& key) const; ///< "version", "title", ...; empty when unknown

  void add(const std::vector<SweepPoint>& points);   ///< with a waiting run for each seed
  void record(int run, const SweepOutcome& outcome); ///< one transaction
  void note(const std::string& key, const std::string& value);
  /// Takes over what another table of the same plan has of these runs. Returns how many were new.
  std::size_t merge(const SweepTable& other);

  /// Everything but times of computing as CSV, a row a run, doubles to the last bit: equal sweeps give equal
  /// text. `withBlobs`: also hashes of curves and last frames.
  std::string csv(bool withBlobs = false) const;

private:
  std::uint64_t blobHash(int run) const; ///< of curves and last frame
  const std::filesystem::path& file() const;

  struct Impl;
  explicit SweepTable(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

} // namespace sandglass::analysis
