#pragma once
// What VTK would print to standard error, kept instead: a library does not print, and a picture that VTK
// complained about must not pass for a good one.

#include <string>

namespace sandglass::vis {

/// From now on VTK's messages are kept, for the whole process. Any number of calls.
void keepVtkMessages();

/// The first error since the last call, or "". Warnings are dropped.
std::string takeVtkError();

} // namespace sandglass::vis
