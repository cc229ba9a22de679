#pragma once
// Other programs on this machine: whether they are there, and what they say.

#include <filesystem>
#include <string>

namespace sandglass::peers {

/// Where `name` lies on the PATH; empty when it is not installed.
std::filesystem::path findProgram(const std::string& name);

struct ProgramOutput {
  int code = 0;
  std::string text; ///< standard output and standard error
};

/// Runs a command line of the shell in `folder`. Throws RunError when it cannot be started.
ProgramOutput runCommand(const std::filesystem::path& folder, const std::string& command);

/// A fresh folder below the system's temporary one, deleted with all in it at the end.
class ScratchFolder {
public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
};

} // namespace sandglass::peers
