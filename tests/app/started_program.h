#pragma once
// The program itself, started and left alone: for tests that kill it.

#include <catch2/catch.hpp>

#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <spawn.h>
#include <string>
#include <sys/wait.h>
#include <thread>
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

/// Waits until enough() (asked at every `look`) says that `pieces` of work are done, and `part` of the time
/// that one took has gone by once more, or the child has ended; kills it and returns its status.
template <class Enough>
int killAfter(pid_t child, std::size_t pieces, double part, std::chrono::microseconds look, Enough&& enough) {
  using Clock = std::chrono::steady_clock;
  const auto began = Clock::now();
  int status = 0;
  while (!enough()) {
    if (waitpid(child, &status, WNOHANG) == child) return status;
    std::this_thread::sleep_for(look);
  }
  std::chrono::duration<double> usual(0.02); // of a start; where it takes longer, the kill falls into it
  if (pieces > 0) usual = (Clock::now() - began) / static_cast<double>(pieces);
  std::this_thread::sleep_for(part * usual);
  kill(child, SIGKILL);
  waitpid(child, &status, 0);
  return status;
}

} // namespace sandglass::test
