#include "tests/peers/circumstances.h"

#include "sim/base/version.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <fstream>
#include <thread>

namespace sandglass::peers {

namespace {

std::string processor() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown processor";
}

} // namespace

std::string circumstances() {
  const auto now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  return fmt::format("{}, {} cores; sandglass {}; {:%d %B %Y}", processor(),
                     std::thread::hardware_concurrency(), programVersion(), fmt::gmtime(now));
}

} // namespace sandglass::peers
