#pragma once
// The reference page of scene files, made from the same lists that the reader checks against.

#include <string>

namespace sandglass {

/// Markdown: every table, kind and key with its dimension, range and default.
std::string sceneReference();

} // namespace sandglass
