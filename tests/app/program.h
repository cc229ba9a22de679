#pragma once
// Runs the program as a user would and keeps what it said.

#include <catch2/catch.hpp>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <sys/wait.h>

namespace sandglass::test {

struct Result {
  int code = 0;
  std::string text; ///< standard output and standard error
};

/// `sandglass` with these arguments, without a display.
inline Result program(const std::string& arguments) {
  ::unsetenv("DISPLAY");
  const std::string command = std::string(SANDGLASS_PROGRAM) + " " + arguments + " 2>&1";
  std::FILE* pipe = ::popen(command.c_str(), "r");
  REQUIRE(pipe != nullptr);
  Result result;
  char buffer[512];
  while (std::fgets(buffer, sizeof buffer, pipe))
    result.text += buffer;
  result.code = WEXITSTATUS(::pclose(pipe));
  return result;
}

} // namespace sandglass::test
