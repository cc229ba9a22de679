#pragma once
// Collects everything that is wrong with a scene, each fault one sentence that begins with file and line.

#include "sim/scene/document.h"

#include <map>
#include <string>
#include <vector>

namespace sandglass {

class FaultList {
public:
  explicit FaultList(std::string file) : file_(std::move(file)) {}

  /// Remembers where a key stands and how its value reads.
  void note(const std::string& key, const Value& value);

  /// "FILE:LINE: KEY is VALUE, PROBLEM"
  void wrong(const std::string& key, const std::string& problem);
  /// "FILE:LINE: KEY SENTENCE"; the line is that of the nearest table around a key that is not there.
  void about(const std::string& key, const std::string& sentence);
  /// A fault of the scene as a whole, "FILE: SENTENCE"; it counts as one of `key` where that is given.
  void general(const std::string& sentence, const std::string& key = "");
  /// A finished sentence with its own place: a bad override, or a CSV file, which is listed where `key` names
  /// it.
  void foreign(const std::string& sentence, const std::string& key = "");

  bool empty() const { return faults_.empty(); }
  /// True when a fault was reported for this key or one below it: further checks of it would only confuse.
  bool has(const std::string& key) const;
  /// Throws InputError with all sentences, in the order of the file.
  void throwIfAny() const;

private:
  struct Known {
    Place place;
    std::string text;
  };
  struct Fault {
    int order;
    std::string key, sentence;
  };
  const Known* known(std::string key) const;
  void add(const std::string& key, const Known* at, const std::string& sentence);

  std::string file_;
  std::map<std::string, Known> known_;
  std::vector<Fault> faults_;
};

} // namespace sandglass
