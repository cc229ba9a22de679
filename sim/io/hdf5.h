#pragma once
// Thin ownership and typed helpers over the plain HDF5 C API; used by sim/io alone.
//
// Every function throws hdf5::Failure (a phrase without the file's name) when HDF5 refuses; the callers turn
// it into a sentence. Hold a Session while using any of this: HDF5 keeps global state, and prints to standard
// error unless told not to.

#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

namespace sandglass::hdf5 {

class Failure : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// One thread at a time inside HDF5, its error printer off.
class Session {
public:
  Session();
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

private:
  std::unique_lock<std::recursive_mutex> lock_;
  H5E_auto2_t printer_ = nullptr;
  void* printerData_ = nullptr;
};

/// Owns one HDF5 identifier of any kind.
class Handle {
public:
  Handle() = default;
  /// Throws Failure("cannot <what>") when `id` is negative.
  Handle(hid_t id, const std::string& what);
  Handle(Handle&& other) noexcept : id_(other.id_) { other.id_ = -1; }
  Handle& operator=(Handle&& other) noexcept;
  ~Handle() { reset(); }
  operator hid_t() const { return id_; }
  /// Lets go of the identifier; throws when HDF5 cannot write what it still holds.
  void close();

private:
  void reset() noexcept;
  hid_t id_ = -1;
};

Handle createFile(const std::filesystem::path& file);
Handle openFile(const std::filesystem::path& file);
/// Creation order is tracked, as VTKHDF wants it.
Handle createGroup(hid_t parent, const std::string& name);
Handle openGroup(hid_t parent, const std::string& name);
bool exists(hid_t parent, const std::string& name);

template <class T> hid_t typeOf();
template <> inline hid_t typeOf<double>() {
  return H5T_NATIVE_DOUBLE;
}
template <> inline hid_t typeOf<float>() {
  return H5T_NATIVE_FLOAT;
}
template <> inline hid_t typeOf<std::int64_t>() {
  return H5T_NATIVE_INT64;
}
template <> inline hid_t typeOf<std::int32_t>() {
  return H5T_NATIVE_INT32;
}
template <> inline hid_t typeOf<std::uint8_t>() {
  return H5T_NATIVE_UINT8;
}

/// Attributes: whole numbers (a scalar when `values` has one entry) and fixed-length text.
void writeAttribute(hid_t location, const std::string& name, const std::vector<std::int64_t>& values,
                    bool scalar);
void writeAttribute(hid_t location, const std::string& name, const std::string& text);
std::vector<std::int64_t> readNumbers(hid_t location, const std::string& name);
std::string readText(hid_t location, const std::string& name);
std::vector<std::string> attributeNames(hid_t location);

/// Text of any length as a scalar dataset.
void writeTextDataset(hid_t location, const std::string& name, const std::string& text);
std::string readTextDataset(hid_t location, const std::string& name);

/// A list of texts, each padded with zeros to the longest.
void writeTexts(hid_t parent, const std::string& name, const std::vector<std::string>& texts);
std::vector<std::string> readTexts(hid_t parent, const std::string& name);

/// A dataset that grows by rows along its first dimension: chunked, shuffled, deflated, with checksums.
class Column {
public:
  Column() = default;
  /// `tail`: the lengths of the other dimensions, empty for a plain list. `storedType` is what lies in the
  /// file; append() converts.
  Column(hid_t parent, const std::string& name, hid_t storedType, std::vector<hsize_t> tail,
         hsize_t chunkRows);
  template <class T> void append(const T* rows, std::size_t count) { appendRaw(rows, typeOf<T>(), count); }
  hsize_t rows() const { return rows_; }

private:
  void appendRaw(const void* data, hid_t memoryType, std::size_t count);
  Handle dataset_;
  std::vector<hsize_t> tail_;
  hsize_t rows_ = 0;
};

/// Names of the datasets in a group, in alphabetical order.
std::vector<std::string> datasetNames(hid_t group);
/// Lengths of all dimensions of a dataset.
std::vector<hsize_t> shape(hid_t parent, const std::string& name);

/// Rows [first, first + count) flattened; `width` must be the product of the other dimensions.
template <class T>
std::vector<T> readRows(hid_t parent, const std::string& name, hsize_t first, hsize_t count, hsize_t width);
template <class T> std::vector<T> readAll(hid_t parent, const std::string& name, hsize_t width) {
  return readRows<T>(parent, name, 0, shape(parent, name).at(0), width);
}

} // namespace sandglass::hdf5
