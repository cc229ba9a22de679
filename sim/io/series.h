#pragma once
// series.csv: what the probes of a run saw. One header line; one row per time at which any probe was due:
// time [s], step, then a column `<probe>.<value>` for each value of each probe in the order of the scene. A
// cell is empty when its probe was not due. Numbers are written so that reading gives the same bits.

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace sandglass {

class SeriesWriter {
public:
  /// Cuts an existing file to `keepBytes` and goes on; 0 starts afresh. Throws RunError.
  SeriesWriter(const std::filesystem::path& file, std::vector<std::string> columns, std::uint64_t keepBytes);
  /// Values by column name; columns left out stay empty. Throws RunError.
  void row(double time, std::int64_t step, const std::map<std::string, double>& values);
  /// Brings all rows to disk and returns the length of the file.
  std::uint64_t sync();

private:
  void write(const std::string& line);
  std::filesystem::path file_;
  std::vector<std::string> columns_;
  std::ofstream out_;
  std::uint64_t bytes_ = 0;
};

/// Times and values of one column, empty cells left out.
struct SeriesColumn {
  std::vector<double> time, value;
};

/// All columns by name. A last line cut off by a kill is left out. Throws InputError with file and line.
std::map<std::string, SeriesColumn> readSeries(const std::filesystem::path& file);

} // namespace sandglass
