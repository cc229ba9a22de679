#pragma once
// "did you mean ...?"

#include <string>
#include <vector>

namespace sandglass {

/// The known word nearest to `word` by edits (insert, delete, replace, swap), or "" when none is near.
std::string nearestWord(const std::string& word, const std::vector<std::string>& known);

/// "did you mean 'x'?" when a word is near, else "LABEL: a, b, c".
std::string suggestion(const std::string& word, const std::vector<std::string>& known,
                       const std::string& label);

/// Words joined by ", ".
std::string joined(const std::vector<std::string>& words);

} // namespace sandglass
