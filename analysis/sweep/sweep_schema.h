#pragma once
// The tables of a sweep's database.

namespace sandglass::analysis {

/// What `info` holds under the key that tells a sweep's table from other databases.
inline constexpr const char* sweepForm = "sandglass sweep 1";

inline constexpr const char* sweepTables = R"(
CREATE TABLE info (key TEXT PRIMARY KEY, value TEXT NOT NULL);
CREATE TABLE columns (position INTEGER PRIMARY KEY, name TEXT UNIQUE NOT NULL, role TEXT NOT NULL,
  is_text INTEGER NOT NULL, unit TEXT NOT NULL, description TEXT NOT NULL);
CREATE TABLE points (id INTEGER PRIMARY KEY, level INTEGER NOT NULL, lattice TEXT NOT NULL);
CREATE TABLE runs (id INTEGER PRIMARY KEY, point INTEGER NOT NULL REFERENCES points(id),
  replicate INTEGER NOT NULL, seed INTEGER NOT NULL, status TEXT NOT NULL, fault TEXT NOT NULL DEFAULT '');
CREATE TABLE curves (run INTEGER NOT NULL REFERENCES runs(id), position INTEGER NOT NULL, name TEXT NOT NULL,
  title TEXT NOT NULL, x_name TEXT NOT NULL, x_unit TEXT NOT NULL, y_name TEXT NOT NULL, y_unit TEXT NOT NULL,
  data BLOB NOT NULL, PRIMARY KEY (run, position));
CREATE TABLE last_frames (run INTEGER PRIMARY KEY REFERENCES runs(id), time REAL NOT NULL, step INTEGER NOT NULL,
  stage TEXT NOT NULL, data BLOB NOT NULL);
CREATE TABLE timing (run INTEGER PRIMARY KEY REFERENCES runs(id), seconds REAL NOT NULL);
)";

} // namespace sandglass::analysis
