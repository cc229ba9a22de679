#pragma once
// Plain values to bytes and back, for checkpoints. Reading past the end throws InputError: a checkpoint's
// checksum was right by then, so another version of the program wrote it.

#include "sim/base/error.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

namespace sandglass {

class ByteWriter {
public:
  template <class T> ByteWriter& operator<<(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto* bytes = reinterpret_cast<const std::byte*>(&value);
    bytes_.insert(bytes_.end(), bytes, bytes + sizeof value);
    return *this;
  }
  template <class T> ByteWriter& operator<<(const std::vector<T>& list) {
    *this << static_cast<std::uint64_t>(list.size());
    for (const auto& value : list)
      *this << value;
    return *this;
  }
  std::vector<std::byte> take() { return std::move(bytes_); }

private:
  std::vector<std::byte> bytes_;
};

class ByteReader {
public:
  explicit ByteReader(const std::vector<std::byte>& bytes) : bytes_(bytes) {}
  template <class T> ByteReader& operator>>(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (sizeof value > bytes_.size() - at_) tooShort();
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
    return *this;
  }
  template <class T> ByteReader& operator>>(std::vector<T>& list) {
    std::uint64_t count = 0;
    *this >> count;
    if (count > (bytes_.size() - at_) / sizeof(T)) tooShort();
    list.resize(count);
    for (auto& value : list)
      *this >> value;
    return *this;
  }

private:
  [[noreturn]] static void tooShort() {
    throw InputError("the checkpoint was written by another version of the program; run from the start");
  }
  const std::vector<std::byte>& bytes_;
  std::size_t at_ = 0;
};

} // namespace sandglass
