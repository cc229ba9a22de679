#pragma once
// What walls and fields whose numbers come from a file have in common: readers by the file's extension, to
// which the program adds those that need other libraries, and the keys that place the file in the scene.

#include "sim/scene/parameters.h"

#include <filesystem>
#include <map>
#include <string>
#include <utility>

namespace sandglass {

template <class Reader> class ReadersByExtension {
public:
  ReadersByExtension() = default;
  ReadersByExtension(std::initializer_list<std::pair<const std::string, Reader>> first) : all_(first) {}

  /// `extension` in small letters, with its dot.
  void add(const std::string& extension, Reader reader) { all_[extension] = std::move(reader); }
  /// Null where there is none.
  const Reader* find(const std::filesystem::path& file) const {
    const auto it = all_.find(inSmallLetters(file.extension().string()));
    return it == all_.end() ? nullptr : &it->second;
  }
  /// All extensions, with commas between.
  std::string known() const {
    std::string names;
    for (const auto& [extension, reader] : all_)
      names += (names.empty() ? "" : ", ") + extension;
    return names;
  }

private:
  static std::string inSmallLetters(std::string text) {
    for (char& c : text)
      c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return text;
  }
  std::map<std::string, Reader> all_;
};

/// The keys `scale` and `shift`.
ParameterSpec fileScale();
ParameterSpec fileShift();
/// Their values. Throws InputError without a scale, with `example` of one ("1 mm").
double scaleOf(const Parameters& parameters, const char* example);
Vec3 shiftOf(const Parameters& parameters);

} // namespace sandglass
