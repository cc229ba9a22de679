#pragma once
// Results to files: CSV, JSON and, where the program can draw, a PNG chart.

#include "analysis/results.h"

#include <filesystem>
#include <memory>

namespace sandglass::cli {

class ResultFiles {
public:
  /// Makes the folder. `csvOnly`: neither JSON nor pictures.
  ResultFiles(const std::filesystem::path& folder, bool csvOnly);
  ~ResultFiles();

  /// Writes `prefix` + the curve's name + endings.
  void write(const analysis::Curve& curve, const std::string& prefix = "");
  void write(const analysis::Table& table, const std::string& prefix = "");
  void write(const analysis::Field& field, const std::string& prefix = ""); ///< VTK image data (.vti)

private:
  struct Painter;
  std::filesystem::path folder_;
  bool csvOnly_;
  std::unique_ptr<Painter> painter_; ///< made at the first chart: a GL context takes time
};

} // namespace sandglass::cli
