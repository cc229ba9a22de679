#pragma once
// The program itself, started and left alone: for tests that kill it.

#include <catch2/catch.hpp>

#include <fcntl.h>
#include <spawn.h>
#include <string>
#include <unistd.h>
#include <vector>

extern char** environ;

namespace sandglass::test {

/// Starts `sandglass` with these arguments, silent, and returns its process id.
inline pid_t startProgram(std::vector<std::string> words) {
  words.insert(words.begin(), SANDGLASS_PROGRAM);
  std::vector<char*> arguments;
  for (auto& word : words)
    arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t quiet;
  posix_spawn_file_actions_init(&quiet);
  posix_spawn_file_actions_addopen(&quiet, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&quiet, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int fault = posix_spawn(&child, SANDGLASS_PROGRAM, &quiet, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&quiet);
  REQUIRE(fault == 0);
  return child;
}

} // namespace sandglass::test
