#pragma once
// Which program this is, for provenance.

#include <string>

namespace sandglass {

/// "0.1.0 (1a2b3c4)": the project's version and, where it was built from a git clone, the commit, with
/// "-modified" when files differed from it.
std::string programVersion();

} // namespace sandglass
