#pragma once
// Where, with what and when a table was made.

#include <string>

namespace sandglass::peers {

/// "Intel(R) Xeon(R) Processor, 2 cores; sandglass 0.1.0 (1a2b3c4); 22 November 2026"
std::string circumstances();

} // namespace sandglass::peers
