#include "tests/peers/programs.h"

#include "sim/base/error.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <sys/wait.h>
#include <unistd.h>

namespace sandglass::peers {

namespace fs = std::filesystem;

fs::path findProgram(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path candidate = fs::path(folder) / name;
    if (::access(candidate.c_str(), X_OK) == 0 && fs::is_regular_file(candidate)) return candidate;
  }
  return {};
}

ProgramOutput runCommand(const fs::path& folder, const std::string& command) {
  const std::string line = fmt::format("cd '{}' && {} 2>&1", folder.string(), command);
  std::FILE* pipe = ::popen(line.c_str(), "r");
  if (!pipe) throw RunError(fmt::format("the command '{}' cannot be started", command));
  ProgramOutput output;
  char buffer[4096];
  while (std::fgets(buffer, sizeof buffer, pipe))
    output.text += buffer;
  output.code = WEXITSTATUS(::pclose(pipe));
  return output;
}

ScratchFolder::ScratchFolder() {
  std::string name = (fs::temp_directory_path() / "sandglass-XXXXXX").string();
  if (!::mkdtemp(name.data())) throw RunError(fmt::format("no folder '{}' can be made", name));
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

} // namespace sandglass::peers
