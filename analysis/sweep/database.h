#pragma once
// SQLite with exceptions and values instead of codes and pointers: as much as the table of a sweep needs.

#include "analysis/sweep/sweep_plan.h"

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

struct sqlite3;
struct sqlite3_stmt;

namespace sandglass::analysis {

class Database;

/// A prepared statement. Places are numbered from 1 (values to bind) and columns from 0, as in SQLite.
class Statement {
public:
  Statement(const Database& database, const std::string& sql);
  ~Statement();
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  Statement& bind(int place, std::int64_t value);
  Statement& bind(int place, const std::string& value);
  Statement& bind(int place, const SweepValue& value); ///< NaN becomes NULL, as SQLite has no other
  Statement& bind(int place, std::span<const std::byte> value);
  bool step(); ///< true: there is a row
  void run();  ///< step() to the end, and ready for new values

  std::int64_t integer(int column) const;
  double number(int column) const; ///< NaN for NULL
  std::string text(int column) const;
  SweepValue value(int column) const;
  std::vector<std::byte> bytes(int column) const;

private:
  void check(int code) const;
  const Database& database_;
  sqlite3_stmt* statement_ = nullptr;
};

/// Throws RunError ("FILE: ...: what SQLite says").
class Database {
public:
  enum class Mode { read, write, create };
  Database(const std::filesystem::path& file, Mode mode);
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  void execute(const std::string& sql);
  const std::filesystem::path& file() const { return file_; }
  sqlite3* handle() const { return handle_; }
  [[noreturn]] void fail(const std::string& what) const;

private:
  std::filesystem::path file_;
  sqlite3* handle_ = nullptr;
};

/// Rolls back unless committed.
class Transaction {
public:
  explicit Transaction(Database& database);
  ~Transaction();
  void commit();

private:
  Database& database_;
  bool open_ = true;
};

/// "name" as SQL quotes it.
std::string sqlName(const std::string& name);

} // namespace sandglass::analysis
