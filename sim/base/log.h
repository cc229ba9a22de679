#pragma once
// Libraries do not print. They report through a Log that the application or a test owns.

#include <functional>
#include <string>

namespace sandglass {

enum class LogLevel { info, warning, error };

/// Receives messages; an empty Log swallows them. Called from the thread that runs the library code.
using Log = std::function<void(LogLevel, const std::string&)>;

inline void report(const Log& log, LogLevel level, const std::string& message) {
  if (log) log(level, message);
}

} // namespace sandglass
