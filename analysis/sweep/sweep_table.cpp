#include "analysis/sweep/sweep_table.h"

#include "analysis/sweep/database.h"
#include "analysis/sweep/sweep_blobs.h"
#include "analysis/sweep/sweep_design.h"
#include "analysis/sweep/sweep_schema.h"
#include "sim/base/error.h"
#include "sim/base/version.h"
#include "sim/run/preview.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace sandglass::analysis {

namespace fs = std::filesystem;

namespace {

constexpr const char* roleNames[] = {"axis", "derived", "result"};
constexpr const char* statusNames[] = {"waiting", "done", "failed"};

template <class Enum, std::size_t N> Enum named(const std::string& name, const char* const (&names)[N]) {
  for (std::size_t k = 0; k < N; ++k)
    if (name == names[k]) return static_cast<Enum>(k);
  return static_cast<Enum>(0);
}

std::vector<SweepColumn> planColumns(const SweepPlan& plan) {
  std::vector<SweepColumn> columns;
  const auto unit = [](const std::string& u) { return u == "1" ? std::string() : u; };
  for (const auto& a : plan.axes)
    columns.push_back(
        {a.name, unit(a.unit), SweepRole::axis, a.isText(), fmt::format("{}", fmt::join(a.keys, ", "))});
  for (const auto& d : plan.derived)
    columns.push_back({d.name, unit(d.unit), SweepRole::derived, false, d.expression});
  return columns;
}

} // namespace

const char* nameOf(SweepStatus status) {
  return statusNames[static_cast<int>(status)];
}

struct SweepTable::Impl {
  Impl(const fs::path& file, Database::Mode mode) : database(file, mode) {}
  Database database;
  SweepPlan plan;
  std::vector<SweepColumn> columns;
  std::size_t ofPoints = 0; ///< columns of axes and derived values

  void addColumn(const SweepColumn& column) {
    database.execute(fmt::format("ALTER TABLE {} ADD COLUMN {} {}",
                                 column.role == SweepRole::result ? "runs" : "points", sqlName(column.name),
                                 column.text ? "TEXT" : "REAL"));
    Statement(database, "INSERT INTO columns VALUES (?, ?, ?, ?, ?, ?)")
        .bind(1, static_cast<std::int64_t>(columns.size()))
        .bind(2, column.name)
        .bind(3, std::string(roleNames[static_cast<int>(column.role)]))
        .bind(4, static_cast<std::int64_t>(column.text))
        .bind(5, column.unit)
        .bind(6, column.description)
        .run();
    columns.push_back(column);
    if (column.role != SweepRole::result) ++ofPoints;
  }

  void load() {
    columns.clear();
    ofPoints = 0;
    Statement s(database, "SELECT name, role, is_text, unit, description FROM columns ORDER BY position");
    while (s.step()) {
      columns.push_back(
          {s.text(0), s.text(3), named<SweepRole>(s.text(1), roleNames), s.integer(2) != 0, s.text(4)});
      if (columns.back().role != SweepRole::result) ++ofPoints;
    }
  }

  std::string info(const std::string& key) const {
    Statement s(database, "SELECT value FROM info WHERE key = ?");
    s.bind(1, key);
    return s.step() ? s.text(0) : "";
  }

  void note(const std::string& key, const std::string& value) {
    Statement(database, "INSERT OR REPLACE INTO info VALUES (?, ?)").bind(1, key).bind(2, value).run();
  }

  void addPoints(const std::vector<SweepPoint>& points) {
    std::string names, places;
    for (std::size_t c = 0; c < ofPoints; ++c) {
      names += ", " + sqlName(columns[c].name);
      places += ", ?";
    }
    Statement point(
        database, fmt::format("INSERT INTO points (id, level, lattice{}) VALUES (?, ?, ?{})", names, places));
    std::int64_t runs = 0;
    {
      Statement count(database, "SELECT COUNT(*) FROM runs");
      if (count.step()) runs = count.integer(0);
    }
    for (const auto& p : points) {
      point.bind(1, static_cast<std::int64_t>(p.id)).bind(2, static_cast<std::int64_t>(p.level));
      point.bind(3, fmt::format("{}", fmt::join(p.lattice, " ")));
      for (std::size_t c = 0; c < ofPoints; ++c)
        point.bind(static_cast<int>(c) + 4, p.values[c]);
      point.run();
    }
    // The first seed of all points, then the second: a map is there early.
    Statement run(database, "INSERT INTO runs (id, point, replicate, seed, status) VALUES (?, ?, ?, ?, ?)");
    for (std::size_t k = 0; k < plan.seeds.size(); ++k)
      for (const auto& p : points)
        run.bind(1, ++runs)
            .bind(2, static_cast<std::int64_t>(p.id))
            .bind(3, static_cast<std::int64_t>(k) + 1)
            .bind(4, static_cast<std::int64_t>(plan.seeds[k]))
            .bind(5, std::string(statusNames[0]))
            .run();
  }

  std::vector<SweepRow> rows(const std::string& condition, std::int64_t bound) const {
    std::string names;
    for (const auto& c : columns)
      names += fmt::format(", {}.{}", c.role == SweepRole::result ? "runs" : "points", sqlName(c.name));
    Statement s(database, fmt::format("SELECT runs.id, runs.point, runs.replicate, points.level, runs.seed, "
                                      "runs.status, runs.fault{} FROM runs JOIN points ON points.id = "
                                      "runs.point {} ORDER BY runs.id",
                                      names, condition));
    if (!condition.empty()) s.bind(1, bound);
    std::vector<SweepRow> all;
    while (s.step()) {
      SweepRow row;
      row.run = static_cast<int>(s.integer(0));
      row.point = static_cast<int>(s.integer(1));
      row.replicate = static_cast<int>(s.integer(2));
      row.level = static_cast<int>(s.integer(3));
      row.seed = static_cast<std::uint64_t>(s.integer(4));
      row.status = named<SweepStatus>(s.text(5), statusNames);
      row.fault = s.text(6);
      for (std::size_t c = 0; c < columns.size(); ++c)
        row.values.push_back(s.value(static_cast<int>(c) + 7));
      all.push_back(std::move(row));
    }
    return all;
  }
};

SweepTable::SweepTable(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
SweepTable::SweepTable(SweepTable&&) noexcept = default;
SweepTable::~SweepTable() = default;

SweepTable::SweepTable(const fs::path& folder, Access access) {
  const fs::path file = fs::is_directory(folder) ? folder / fileName : folder;
  if (!fs::exists(file)) throw InputError(fmt::format("{}: there is no table of a sweep", file.string()));
  impl_ =
      std::make_unique<Impl>(file, access == Access::write ? Database::Mode::write : Database::Mode::read);
  std::string version;
  if (Statement(impl_->database, "SELECT 1 FROM sqlite_master WHERE name = 'info'").step())
    version = impl_->info("form");
  if (version != sweepForm)
    throw InputError(fmt::format("{}: this is not the table of a sweep", file.string()));
  impl_->load();
  const fs::path scene = impl_->info("scene_file");
  impl_->plan =
      parseSweep(impl_->info("sweep"), impl_->info("sweep_file"), scene.parent_path(), impl_->info("scene"));
  impl_->plan.sceneFile = scene.string();
}

SweepTable SweepTable::create(const fs::path& file, const SweepPlan& plan) {
  // Under another name until it is whole: what a kill leaves of it is no table.
  fs::path part = file;
  part += ".part";
  fs::remove(part);
  {
    Impl impl(part, Database::Mode::create);
    impl.plan = plan;
    Transaction transaction(impl.database);
    impl.database.execute(sweepTables);
    for (const auto& column : planColumns(plan))
      impl.addColumn(column);
    impl.note("form", sweepForm);
    impl.note("version", programVersion());
    impl.note("title", plan.title);
    impl.note("sweep", plan.text);
    impl.note("sweep_file", plan.file);
    impl.note("scene", plan.sceneText);
    impl.note("scene_file", fs::absolute(plan.sceneFile).lexically_normal().string());
    impl.addPoints(firstPoints(plan));
    transaction.commit();
  }
  fs::remove(fs::path(part) += "-journal");
  fs::rename(part, file);
  return SweepTable(file, Access::write);
}

const SweepPlan& SweepTable::plan() const {
  return impl_->plan;
}

const std::vector<SweepColumn>& SweepTable::columns() const {
  return impl_->columns;
}

std::size_t SweepTable::column(const std::string& name) const {
  std::vector<std::string> names;
  for (std::size_t c = 0; c < impl_->columns.size(); ++c) {
    if (impl_->columns[c].name == name) return c;
    names.push_back(impl_->columns[c].name);
  }
  throw InputError(fmt::format("{}: there is no column '{}'; there are {}", impl_->database.file().string(),
                               name, fmt::join(names, ", ")));
}

std::vector<SweepPoint> SweepTable::points() const {
  std::string names;
  for (std::size_t c = 0; c < impl_->ofPoints; ++c)
    names += ", " + sqlName(impl_->columns[c].name);
  Statement s(impl_->database, fmt::format("SELECT id, level, lattice{} FROM points ORDER BY id", names));
  std::vector<SweepPoint> points;
  while (s.step()) {
    SweepPoint p;
    p.id = static_cast<int>(s.integer(0));
    p.level = static_cast<int>(s.integer(1));
    const std::string lattice = s.text(2);
    for (const char *at = lattice.data(), *end = at + lattice.size(); at < end; ++at) {
      std::int64_t index = 0;
      at = std::from_chars(at, end, index).ptr;
      p.lattice.push_back(index);
    }
    for (std::size_t c = 0; c < impl_->ofPoints; ++c)
      p.values.push_back(s.value(static_cast<int>(c) + 3));
    points.push_back(std::move(p));
  }
  return points;
}

std::vector<SweepRow> SweepTable::rows() const {
  return impl_->rows("", 0);
}

SweepRow SweepTable::row(int run) const {
  auto rows = impl_->rows("WHERE runs.id = ?", run);
  if (rows.empty())
    throw InputError(fmt::format("{}: there is no run {}", impl_->database.file().string(), run));
  return std::move(rows.front());
}

Scene SweepTable::scene(int run) const {
  const SweepRow at = row(run);
  SweepPoint point;
  point.id = at.point;
  point.values.assign(at.values.begin(), at.values.begin() + static_cast<std::ptrdiff_t>(impl_->ofPoints));
  return sceneOf(impl_->plan, point, at.seed);
}

FramePtr SweepTable::lastFrame(int run) const {
  Statement s(impl_->database, "SELECT time, step, stage, data FROM last_frames WHERE run = ?");
  s.bind(1, static_cast<std::int64_t>(run));
  if (!s.step()) return nullptr;
  auto frame = std::make_shared<Frame>();
  frame->time = s.number(0);
  frame->step = s.integer(1);
  frame->stage = s.text(2);
  readFrame(s.bytes(3), *frame);
  const Scene at = scene(run);
  frame->domain = at.domain;
  frame->walls = previewFrame(at, 0)->walls;
  for (auto& wall : frame->walls) // those that a stage has removed since
    for (const auto& stage : at.stages) {
      const auto& gone = stage.removeWalls;
      wall.active = wall.active && std::find(gone.begin(), gone.end(), wall.name) == gone.end();
      if (stage.name == frame->stage) break;
    }
  frame->provenance = {
      {"scene", sceneHash(at)}, {"seed", std::to_string(at.seed)}, {"version", info("version")}};
  return frame;
}

std::vector<Curve> SweepTable::curves(int run) const {
  Statement s(impl_->database,
              "SELECT name, title, x_name, x_unit, y_name, y_unit, data FROM curves WHERE run = ? "
              "ORDER BY position");
  s.bind(1, static_cast<std::int64_t>(run));
  std::vector<Curve> all;
  while (s.step()) {
    Curve curve;
    curve.name = s.text(0);
    curve.title = s.text(1);
    curve.x = {s.text(2), s.text(3)};
    curve.y = {s.text(4), s.text(5)};
    readCurve(s.bytes(6), curve);
    curve.series.front().name = curve.title;
    all.push_back(std::move(curve));
  }
  return all;
}

double SweepTable::seconds(int run) const {
  Statement s(impl_->database, "SELECT seconds FROM timing WHERE run = ?");
  s.bind(1, static_cast<std::int64_t>(run));
  return s.step() ? s.number(0) : 0;
}

std::string SweepTable::info(const std::string& key) const {
  return impl_->info(key);
}

void SweepTable::note(const std::string& key, const std::string& value) {
  impl_->note(key, value);
}

void SweepTable::add(const std::vector<SweepPoint>& points) {
  Transaction transaction(impl_->database);
  impl_->addPoints(points);
  transaction.commit();
}

void SweepTable::record(int run, const SweepOutcome& outcome) {
  Transaction transaction(impl_->database);
  std::string changes;
  for (const auto& [column, value] : outcome.results) {
    const auto known =
        std::find_if(impl_->columns.begin(), impl_->columns.end(),
                     [&, &name = column.name](const SweepColumn& c) { return c.name == name; });
    if (known == impl_->columns.end()) impl_->addColumn(column);
    changes += fmt::format(", {} = ?", sqlName(column.name));
  }
  Statement update(impl_->database,
                   fmt::format("UPDATE runs SET status = ?, fault = ?{} WHERE id = ?", changes));
  update.bind(1, std::string(nameOf(outcome.status))).bind(2, outcome.fault);
  int place = 3;
  for (const auto& [column, value] : outcome.results)
    update.bind(place++, value);
  update.bind(place, static_cast<std::int64_t>(run)).run();
  Statement curve(impl_->database, "INSERT OR REPLACE INTO curves VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)");
  std::int64_t position = 0;
  for (const auto& c : outcome.curves)
    curve.bind(1, static_cast<std::int64_t>(run))
        .bind(2, position++)
        .bind(3, c.name)
        .bind(4, c.title)
        .bind(5, c.x.name)
        .bind(6, c.x.unit)
        .bind(7, c.y.name)
        .bind(8, c.y.unit)
        .bind(9, std::span<const std::byte>(curveBytes(c)))
        .run();
  if (outcome.last)
    Statement(impl_->database, "INSERT OR REPLACE INTO last_frames VALUES (?, ?, ?, ?, ?)")
        .bind(1, static_cast<std::int64_t>(run))
        .bind(2, SweepValue(outcome.last->time))
        .bind(3, static_cast<std::int64_t>(outcome.last->step))
        .bind(4, outcome.last->stage)
        .bind(5, std::span<const std::byte>(frameBytes(*outcome.last)))
        .run();
  Statement(impl_->database, "INSERT OR REPLACE INTO timing VALUES (?, ?)")
      .bind(1, static_cast<std::int64_t>(run))
      .bind(2, SweepValue(outcome.seconds))
      .run();
  transaction.commit();
}

std::uint64_t SweepTable::blobHash(int run) const {
  Statement s(impl_->database,
              "SELECT data FROM curves WHERE run = ?1 UNION ALL SELECT data FROM last_frames "
              "WHERE run = ?1");
  s.bind(1, static_cast<std::int64_t>(run));
  XXH64_hash_t hash = 0;
  while (s.step()) {
    const auto bytes = s.bytes(0);
    hash = XXH3_64bits_withSeed(bytes.data(), bytes.size(), hash);
  }
  return hash;
}

const fs::path& SweepTable::file() const {
  return impl_->database.file();
}

} // namespace sandglass::analysis
