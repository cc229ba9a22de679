#include "sim/scene/fault_list.h"

#include "sim/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace sandglass {

void FaultList::note(const std::string& key, const Value& value) {
  known_[key] = {value.place, describe(value)};
}

const FaultList::Known* FaultList::known(std::string key) const {
  while (true) {
    if (const auto it = known_.find(key); it != known_.end()) return &it->second;
    const auto dot = key.rfind('.');
    if (dot == std::string::npos) return nullptr;
    key.resize(dot);
  }
}

void FaultList::add(const std::string& key, const Known* at, const std::string& sentence) {
  constexpr int last = std::numeric_limits<int>::max();
  std::string prefix = file_;
  int order = 0;
  if (at && at->place.override_) {
    prefix = "--set";
    order = last;
  } else if (at && at->place.line > 0) {
    prefix = fmt::format("{}:{}", file_, at->place.line);
    order = at->place.line;
  }
  faults_.push_back({order, key, prefix + ": " + sentence});
}

void FaultList::wrong(const std::string& key, const std::string& problem) {
  const auto it = known_.find(key);
  if (it == known_.end()) return about(key, "is not given, " + problem);
  add(key, &it->second, fmt::format("{} is {}, {}", key, it->second.text, problem));
}

void FaultList::about(const std::string& key, const std::string& sentence) {
  add(key, known(key), fmt::format("{} {}", key, sentence));
}

void FaultList::general(const std::string& sentence, const std::string& key) {
  add(key, nullptr, sentence);
}

void FaultList::foreign(const std::string& sentence, const std::string& key) {
  const Known* at = key.empty() ? nullptr : known(key);
  const bool placed = at && !at->place.override_ && at->place.line > 0;
  faults_.push_back({placed ? at->place.line : std::numeric_limits<int>::max(), key, sentence});
}

bool FaultList::has(const std::string& key) const {
  return std::any_of(faults_.begin(), faults_.end(), [&](const Fault& f) {
    return f.key == key || (f.key.starts_with(key) && f.key[key.size()] == '.');
  });
}

void FaultList::throwIfAny() const {
  if (faults_.empty()) return;
  auto ordered = faults_;
  std::stable_sort(ordered.begin(), ordered.end(),
                   [](const Fault& a, const Fault& b) { return a.order < b.order; });
  std::vector<std::string> sentences;
  for (const auto& fault : ordered)
    sentences.push_back(fault.sentence);
  throw InputError(std::move(sentences));
}

} // namespace sandglass
