#pragma once
// The one exception family. Thrown at borders (scene, file, command line); kernels never throw.
// Every message is a sentence: file, place, quantity, value found, rule, what to do.

#include <stdexcept>
#include <string>
#include <vector>

namespace sandglass {

/// Base of all errors that the program reports on purpose.
class Error : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// The user's input is wrong (exit code 2). Carries every fault found, not the first alone.
class InputError : public Error {
public:
  explicit InputError(std::string sentence) : InputError(std::vector<std::string>{std::move(sentence)}) {}
  explicit InputError(std::vector<std::string> sentences)
      : Error(join(sentences)), sentences_(std::move(sentences)) {}
  const std::vector<std::string>& sentences() const { return sentences_; }

private:
  static std::string join(const std::vector<std::string>& sentences) {
    std::string all;
    for (const auto& s : sentences) all += (all.empty() ? "" : "\n") + s;
    return all;
  }
  std::vector<std::string> sentences_;
};

/// The run itself went wrong (exit code 1): NaN, escaped grain, excessive overlap, energy from nowhere.
class RunError : public Error {
public:
  using Error::Error;
};

} // namespace sandglass
