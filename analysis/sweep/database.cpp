#include "analysis/sweep/database.h"

#include "sim/base/error.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <cmath>
#include <cstring>
#include <limits>

namespace sandglass::analysis {

Statement::Statement(const Database& database, const std::string& sql) : database_(database) {
  if (sqlite3_prepare_v2(database.handle(), sql.c_str(), -1, &statement_, nullptr) != SQLITE_OK)
    database.fail(sql);
}

Statement::~Statement() {
  sqlite3_finalize(statement_);
}

void Statement::check(int code) const {
  if (code != SQLITE_OK) database_.fail("binding a value");
}

Statement& Statement::bind(int place, std::int64_t value) {
  check(sqlite3_bind_int64(statement_, place, value));
  return *this;
}

Statement& Statement::bind(int place, const std::string& value) {
  check(sqlite3_bind_text(statement_, place, value.data(), static_cast<int>(value.size()), SQLITE_TRANSIENT));
  return *this;
}

Statement& Statement::bind(int place, const SweepValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return bind(place, *text);
  const auto* number = std::get_if<double>(&value);
  check(number && !std::isnan(*number) ? sqlite3_bind_double(statement_, place, *number)
                                       : sqlite3_bind_null(statement_, place));
  return *this;
}

Statement& Statement::bind(int place, std::span<const std::byte> value) {
  check(sqlite3_bind_blob(statement_, place, value.data(), static_cast<int>(value.size()), SQLITE_TRANSIENT));
  return *this;
}

bool Statement::step() {
  const int code = sqlite3_step(statement_);
  if (code != SQLITE_ROW && code != SQLITE_DONE) database_.fail(sqlite3_sql(statement_));
  return code == SQLITE_ROW;
}

void Statement::run() {
  while (step()) {
  }
  sqlite3_reset(statement_);
}

std::int64_t Statement::integer(int column) const {
  return sqlite3_column_int64(statement_, column);
}

double Statement::number(int column) const {
  return sqlite3_column_type(statement_, column) == SQLITE_NULL ? std::numeric_limits<double>::quiet_NaN()
                                                                : sqlite3_column_double(statement_, column);
}

std::string Statement::text(int column) const {
  const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column));
  return text ? std::string(text, static_cast<std::size_t>(sqlite3_column_bytes(statement_, column))) : "";
}

SweepValue Statement::value(int column) const {
  switch (sqlite3_column_type(statement_, column)) {
  case SQLITE_NULL:
    return {};
  case SQLITE_TEXT:
    return text(column);
  default:
    return number(column);
  }
}

std::vector<std::byte> Statement::bytes(int column) const {
  const auto* data = static_cast<const std::byte*>(sqlite3_column_blob(statement_, column));
  return {data, data + sqlite3_column_bytes(statement_, column)};
}

Database::Database(const std::filesystem::path& file, Mode mode) : file_(file) {
  // A reader may have to undo what a kill left half done: SQLite needs to write for that, and falls back to
  // reading alone where the file is protected.
  const int flags = SQLITE_OPEN_READWRITE | (mode == Mode::create ? SQLITE_OPEN_CREATE : 0);
  if (sqlite3_open_v2(file.c_str(), &handle_, flags, nullptr) != SQLITE_OK) {
    const std::string why = handle_ ? sqlite3_errmsg(handle_) : "no memory";
    sqlite3_close(handle_);
    throw InputError(fmt::format("{}: the table cannot be opened: {}", file.string(), why));
  }
  sqlite3_busy_timeout(handle_, 60'000); // [ms] another process may be writing a run
  try {
    // A rollback journal, not a write-ahead log: that one needs memory shared between processes, which
    // network file systems do not have. FULL: what is committed survives a power cut.
    execute(mode == Mode::read ? "PRAGMA query_only = 1"
                               : "PRAGMA journal_mode = TRUNCATE; PRAGMA synchronous = FULL");
  } catch (...) {
    sqlite3_close(handle_);
    throw;
  }
}

Database::~Database() {
  sqlite3_close(handle_);
}

void Database::execute(const std::string& sql) {
  if (sqlite3_exec(handle_, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) fail(sql);
}

void Database::fail(const std::string& what) const {
  const std::string why = sqlite3_errmsg(handle_);
  if (sqlite3_errcode(handle_) == SQLITE_NOTADB)
    throw InputError(fmt::format("{}: this is not the table of a sweep", file_.string()));
  throw RunError(fmt::format("{}: {}: {}", file_.string(), what, why));
}

Transaction::Transaction(Database& database) : database_(database) {
  database_.execute("BEGIN IMMEDIATE");
}

Transaction::~Transaction() {
  if (open_) sqlite3_exec(database_.handle(), "ROLLBACK", nullptr, nullptr, nullptr);
}

void Transaction::commit() {
  database_.execute("COMMIT");
  open_ = false;
}

std::string sqlName(const std::string& name) {
  std::string text = "\"";
  for (const char c : name) {
    if (c == '"') text += '"';
    text += c;
  }
  return text + '"';
}

} // namespace sandglass::analysis
