#include "sim/io/hdf5.h"

#include <fmt/format.h>

#include <algorithm>

namespace sandglass::hdf5 {

namespace {

std::recursive_mutex& mutex() {
  static std::recursive_mutex m;
  return m;
}

void check(herr_t status, const std::string& what) {
  if (status < 0) throw Failure("cannot " + what);
}

Handle textType(std::size_t length) {
  Handle type(H5Tcopy(H5T_C_S1), "make a text type");
  check(H5Tset_size(type, length), "make a text type");
  check(H5Tset_strpad(type, H5T_STR_NULLPAD), "make a text type");
  return type;
}

Handle openDataset(hid_t parent, const std::string& name) {
  return Handle(H5Dopen2(parent, name.c_str(), H5P_DEFAULT), fmt::format("find the dataset '{}'", name));
}

std::vector<hsize_t> shapeOf(hid_t dataset, const std::string& name) {
  const Handle space(H5Dget_space(dataset), fmt::format("read the shape of '{}'", name));
  const int rank = H5Sget_simple_extent_ndims(space);
  check(rank, fmt::format("read the shape of '{}'", name));
  std::vector<hsize_t> lengths(rank);
  check(H5Sget_simple_extent_dims(space, lengths.data(), nullptr),
        fmt::format("read the shape of '{}'", name));
  return lengths;
}

} // namespace

Session::Session() : lock_(mutex()) {
  // Every file is closed by its owner; HDF5's own cleaning up at exit prints, and fails after a damaged file.
  [[maybe_unused]] static const herr_t once = H5dont_atexit();
  H5Eget_auto2(H5E_DEFAULT, &printer_, &printerData_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Session::~Session() {
  H5Eset_auto2(H5E_DEFAULT, printer_, printerData_);
}

Handle::Handle(hid_t id, const std::string& what) : id_(id) {
  if (id < 0) throw Failure("cannot " + what);
}

Handle& Handle::operator=(Handle&& other) noexcept {
  if (this != &other) {
    reset();
    id_ = other.id_;
    other.id_ = -1;
  }
  return *this;
}

void Handle::reset() noexcept {
  if (id_ < 0) return;
  const Session session; // a handle may be the last owner of an open file
  H5Idec_ref(id_);
  id_ = -1;
}

void Handle::close() {
  if (id_ < 0) return;
  const hid_t id = id_;
  id_ = -1;
  if (H5Idec_ref(id) < 0) throw Failure("cannot finish writing (is the disk full?)");
}

Handle createFile(const std::filesystem::path& file) {
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), "set up writing");
  // The older forms carry no checksums, and HDF5 1.10 crashes on damaged ones.
  check(H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110), "set up writing");
  return Handle(H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), "create the file");
}

Handle openFile(const std::filesystem::path& file) {
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), "set up reading");
#if H5_VERSION_GE(1, 10, 7)
  // Closed segments never change, and some file systems know no locks.
  H5Pset_file_locking(access, false, true);
#endif
  return Handle(H5Fopen(file.c_str(), H5F_ACC_RDONLY, access), "open it as HDF5");
}

Handle createGroup(hid_t parent, const std::string& name) {
  const Handle create(H5Pcreate(H5P_GROUP_CREATE), "set up a group");
  check(H5Pset_link_creation_order(create, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED), "set up a group");
  return Handle(H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, create, H5P_DEFAULT),
                fmt::format("create the group '{}'", name));
}

Handle openGroup(hid_t parent, const std::string& name) {
  return Handle(H5Gopen2(parent, name.c_str(), H5P_DEFAULT), fmt::format("find the group '{}'", name));
}

bool exists(hid_t parent, const std::string& name) {
  return H5Lexists(parent, name.c_str(), H5P_DEFAULT) > 0;
}

void writeAttribute(hid_t location, const std::string& name, const std::vector<std::int64_t>& values,
                    bool scalar) {
  const hsize_t count = values.size();
  const Handle space(scalar ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &count, nullptr), "make a space");
  const Handle attribute(
      H5Acreate2(location, name.c_str(), H5T_NATIVE_INT64, space, H5P_DEFAULT, H5P_DEFAULT),
      fmt::format("create the attribute '{}'", name));
  check(H5Awrite(attribute, H5T_NATIVE_INT64, values.data()), fmt::format("write the attribute '{}'", name));
}

void writeAttribute(hid_t location, const std::string& name, const std::string& text) {
  const Handle space(H5Screate(H5S_SCALAR), "make a space");
  const Handle type = textType(std::max<std::size_t>(text.size(), 1));
  const Handle attribute(H5Acreate2(location, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT),
                         fmt::format("create the attribute '{}'", name));
  const std::string padded = text.empty() ? std::string(1, '\0') : text;
  check(H5Awrite(attribute, type, padded.data()), fmt::format("write the attribute '{}'", name));
}

std::vector<std::int64_t> readNumbers(hid_t location, const std::string& name) {
  const Handle attribute(H5Aopen(location, name.c_str(), H5P_DEFAULT),
                         fmt::format("find the attribute '{}'", name));
  const Handle space(H5Aget_space(attribute), fmt::format("read the attribute '{}'", name));
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  check(count < 0 || count > 1'000'000 ? -1 : 0, fmt::format("read the attribute '{}'", name));
  std::vector<std::int64_t> values(count);
  check(H5Aread(attribute, H5T_NATIVE_INT64, values.data()), fmt::format("read the attribute '{}'", name));
  return values;
}

std::string readText(hid_t location, const std::string& name) {
  const std::string what = fmt::format("read the attribute '{}'", name);
  const Handle attribute(H5Aopen(location, name.c_str(), H5P_DEFAULT),
                         fmt::format("find the attribute '{}'", name));
  const Handle stored(H5Aget_type(attribute), what);
  if (H5Tget_class(stored) != H5T_STRING || H5Tis_variable_str(stored) > 0)
    throw Failure(what + " as fixed-length text");
  std::string text(H5Tget_size(stored), '\0');
  check(H5Aread(attribute, stored, text.data()), what);
  text.erase(std::find(text.begin(), text.end(), '\0'), text.end());
  return text;
}

std::vector<std::string> attributeNames(hid_t location) {
  std::vector<std::string> names;
  const auto collect = [](hid_t, const char* name, const H5A_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  hsize_t at = 0;
  check(H5Aiterate2(location, H5_INDEX_NAME, H5_ITER_INC, &at, collect, &names), "list the attributes");
  return names;
}

void writeTextDataset(hid_t location, const std::string& name, const std::string& text) {
  const Handle space(H5Screate(H5S_SCALAR), "make a space");
  const Handle type = textType(std::max<std::size_t>(text.size(), 1));
  const std::string what = fmt::format("write the dataset '{}'", name);
  const Handle dataset(H5Dcreate2(location, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                       what);
  const std::string padded = text.empty() ? std::string(1, '\0') : text;
  check(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, padded.data()), what);
}

std::string readTextDataset(hid_t location, const std::string& name) {
  const Handle dataset = openDataset(location, name);
  const std::string what = fmt::format("read the dataset '{}'", name);
  const Handle stored(H5Dget_type(dataset), what);
  if (H5Tget_class(stored) != H5T_STRING || H5Tis_variable_str(stored) > 0 || !shapeOf(dataset, name).empty())
    throw Failure(what + " as fixed-length text");
  std::string text(H5Tget_size(stored), '\0');
  check(H5Dread(dataset, stored, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()), what);
  text.erase(std::find(text.begin(), text.end(), '\0'), text.end());
  return text;
}

Column::Column(hid_t parent, const std::string& name, hid_t storedType, std::vector<hsize_t> tail,
               hsize_t chunkRows)
    : tail_(std::move(tail)) {
  const std::string what = fmt::format("create the dataset '{}'", name);
  std::vector<hsize_t> now{0}, limit{H5S_UNLIMITED}, chunk{chunkRows};
  for (const hsize_t length : tail_)
    for (auto* dimensions : {&now, &limit, &chunk})
      dimensions->push_back(length);
  const Handle space(H5Screate_simple(static_cast<int>(now.size()), now.data(), limit.data()), what);
  const Handle create(H5Pcreate(H5P_DATASET_CREATE), what);
  check(H5Pset_chunk(create, static_cast<int>(chunk.size()), chunk.data()), what);
  check(H5Pset_shuffle(create), what);
  check(H5Pset_deflate(create, 1), what); // higher levels cost several times the time for a few per cent
  check(H5Pset_fletcher32(create), what); // metadata have checksums of their own
  dataset_ =
      Handle(H5Dcreate2(parent, name.c_str(), storedType, space, H5P_DEFAULT, create, H5P_DEFAULT), what);
}

void Column::appendRaw(const void* data, hid_t memoryType, std::size_t count) {
  std::vector<hsize_t> size{rows_ + count}, start{rows_}, block{count};
  for (const hsize_t length : tail_) {
    size.push_back(length);
    start.push_back(0);
    block.push_back(length);
  }
  if (count == 0) return;
  check(H5Dset_extent(dataset_, size.data()), "extend a dataset (is the disk full?)");
  const Handle file(H5Dget_space(dataset_), "extend a dataset");
  check(H5Sselect_hyperslab(file, H5S_SELECT_SET, start.data(), nullptr, block.data(), nullptr),
        "extend a dataset");
  const Handle memory(H5Screate_simple(static_cast<int>(block.size()), block.data(), nullptr),
                      "extend a dataset");
  check(H5Dwrite(dataset_, memoryType, memory, file, H5P_DEFAULT, data),
        "write a dataset (is the disk full?)");
  rows_ += count;
}

std::vector<std::string> datasetNames(hid_t group) {
  std::vector<std::string> names;
  const auto collect = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  hsize_t at = 0;
  check(H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, &at, collect, &names), "list a group");
  return names;
}

std::vector<hsize_t> shape(hid_t parent, const std::string& name) {
  std::vector<hsize_t> lengths = shapeOf(openDataset(parent, name), name);
  if (lengths.empty()) throw Failure(fmt::format("read '{}' as a list", name));
  return lengths;
}

void writeTexts(hid_t parent, const std::string& name, const std::vector<std::string>& texts) {
  const std::string what = fmt::format("write the dataset '{}'", name);
  std::size_t width = 1;
  for (const auto& text : texts)
    width = std::max(width, text.size());
  std::string flat(width * texts.size(), '\0');
  for (std::size_t i = 0; i < texts.size(); ++i)
    texts[i].copy(flat.data() + i * width, width);
  const hsize_t count = texts.size();
  const Handle space(H5Screate_simple(1, &count, nullptr), what);
  const Handle type = textType(width);
  const Handle dataset(H5Dcreate2(parent, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                       what);
  if (count > 0) check(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, flat.data()), what);
}

std::vector<std::string> readTexts(hid_t parent, const std::string& name) {
  const std::string what = fmt::format("read the dataset '{}'", name);
  const Handle dataset = openDataset(parent, name);
  const auto lengths = shapeOf(dataset, name);
  const Handle stored(H5Dget_type(dataset), what);
  const std::size_t width = H5Tget_size(stored);
  if (lengths.size() != 1 || H5Tget_class(stored) != H5T_STRING || H5Tis_variable_str(stored) > 0 ||
      width == 0 || lengths[0] > 100'000'000 / width)
    throw Failure(what + " as a list of fixed-length texts");
  std::string flat(width * lengths[0], '\0');
  if (!flat.empty()) check(H5Dread(dataset, stored, H5S_ALL, H5S_ALL, H5P_DEFAULT, flat.data()), what);
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < lengths[0]; ++i) {
    const std::string padded = flat.substr(i * width, width);
    texts.push_back(padded.substr(0, padded.find('\0')));
  }
  return texts;
}

template <class T>
std::vector<T> readRows(hid_t parent, const std::string& name, hsize_t first, hsize_t count, hsize_t width) {
  const std::string what = fmt::format("read the dataset '{}'", name);
  const Handle dataset = openDataset(parent, name);
  const auto lengths = shapeOf(dataset, name);
  hsize_t found = 1;
  for (std::size_t k = 1; k < lengths.size(); ++k)
    found *= lengths[k];
  if (lengths.empty() || found != width)
    throw Failure(fmt::format("{}: its rows have {} numbers where {} are due", what, found, width));
  if (first > lengths[0] || count > lengths[0] - first)
    throw Failure(
        fmt::format("{}: it has {} rows and rows {} to {} are due", what, lengths[0], first, first + count));
  std::vector<T> values(count * width);
  if (values.empty()) return values;
  std::vector<hsize_t> start(lengths.size(), 0), block(lengths);
  start[0] = first;
  block[0] = count;
  const Handle file(H5Dget_space(dataset), what);
  check(H5Sselect_hyperslab(file, H5S_SELECT_SET, start.data(), nullptr, block.data(), nullptr), what);
  const Handle memory(H5Screate_simple(static_cast<int>(block.size()), block.data(), nullptr), what);
  check(H5Dread(dataset, typeOf<T>(), memory, file, H5P_DEFAULT, values.data()), what);
  return values;
}

template std::vector<double> readRows(hid_t, const std::string&, hsize_t, hsize_t, hsize_t);
template std::vector<std::int64_t> readRows(hid_t, const std::string&, hsize_t, hsize_t, hsize_t);
template std::vector<std::int32_t> readRows(hid_t, const std::string&, hsize_t, hsize_t, hsize_t);
template std::vector<std::uint8_t> readRows(hid_t, const std::string&, hsize_t, hsize_t, hsize_t);

} // namespace sandglass::hdf5
