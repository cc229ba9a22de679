#pragma once
// A fresh folder under the build tree for one test, removed at its end.

#include <filesystem>
#include <string>
#include <unistd.h>

namespace sandglass::test {

class TemporaryFolder {
public:
  explicit TemporaryFolder(const std::string& name)
      : path_(std::filesystem::path(SANDGLASS_BINARY_DIR) / "test-output" /
              (name + "-" + std::to_string(::getpid()))) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

private:
  std::filesystem::path path_;
};

} // namespace sandglass::test
