// NumPy arrays (https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html) of the shape
// (frames, n, c) or (n, c): x y z, and a fourth column called "energy" unless the settings name it "column 4"
// otherwise. Numbers are float or double, C order. The k-th row is the same grain in every frame.

#include "sim/io/import/npy.h"

#include "sim/base/error.h"
#include "sim/io/import/row_parser.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <regex>

namespace sandglass {

namespace {

class Npy final : public FrameFormat {
public:
  Npy(const ImportFile& file, const ImportSettings&) : name_(file.name()), stream_(file.open()) {
    readHeader();
    if (const auto size = file.size()) {
      const std::uint64_t whole = (*size - std::min(*size, data_)) / frameBytes_;
      if (whole < frames_) {
        cutAt_ = *size;
        present_ = whole;
      }
    }
  }

  std::optional<FrameMark> next() override {
    if (at_ == frames_) return std::nullopt;
    if (at_ == present_)
      throw InputError(
          fmt::format("{}: byte {}: the file ends in frame {} of the {} that its header promises; it "
                      "was cut off",
                      name_, *cutAt_, at_, frames_));
    FrameMark mark;
    mark.index = at_++;
    return mark;
  }

  RawFrame read(const FrameMark& mark) override {
    const std::uint64_t start = data_ + mark.index * frameBytes_;
    stream_->seek(start);
    RawFrame frame;
    frame.orderIsIdentity = true;
    frame.rows = rows_;
    static const char* const names[] = {"x", "y", "z"};
    for (std::uint64_t c = 0; c < columns_; ++c)
      frame.columns.push_back({c < 3           ? names[c]
                               : columns_ == 4 ? "energy"
                                               : fmt::format("column {}", c + 1),
                               {},
                               {}});
    const std::size_t rowBytes = columns_ * width_;
    const std::size_t blockRows = std::max<std::size_t>(1, (std::size_t{1} << 20) / rowBytes);
    std::vector<char> block(blockRows * rowBytes);
    for (std::uint64_t row = 0; row < rows_;) {
      const std::size_t want = std::min<std::uint64_t>(blockRows, rows_ - row) * rowBytes;
      std::size_t have = 0;
      while (have < want) {
        const std::size_t got = stream_->read(block.data() + have, want - have);
        if (got == 0)
          throw InputError(
              fmt::format("{}: byte {}: the file ends in frame {} of the {} that its header promises; "
                          "it was cut off",
                          name_, start + row * rowBytes + have, mark.index, frames_));
        have += got;
      }
      for (std::size_t at = 0; at < want; at += rowBytes)
        for (std::uint64_t c = 0; c < columns_; ++c)
          frame.columns[c].numbers.push_back(number(block.data() + at + c * width_));
      row += want / rowBytes;
    }
    return frame;
  }

private:
  [[noreturn]] void fail(std::uint64_t byte, const std::string& sentence) const {
    throw InputError(fmt::format("{}: byte {}: {}", name_, byte, sentence));
  }

  double number(const char* at) const {
    char bytes[8];
    for (std::size_t k = 0; k < width_; ++k)
      bytes[k] = at[swapped_ ? width_ - 1 - k : k];
    if (width_ == 4) {
      float value;
      std::memcpy(&value, bytes, 4);
      return static_cast<double>(value);
    }
    double value;
    std::memcpy(&value, bytes, 8);
    return value;
  }

  void readHeader() {
    std::string start(12, '\0');
    std::size_t have = 0;
    while (have < start.size()) {
      const std::size_t got = stream_->read(start.data() + have, start.size() - have);
      if (got == 0) fail(have, "the file ends in the header; it was cut off");
      have += got;
    }
    const auto byte = [&](std::size_t k) {
      return static_cast<std::uint64_t>(static_cast<unsigned char>(start[k]));
    };
    const std::uint64_t version = byte(6);
    if (version < 1 || version > 3)
      fail(6, fmt::format("found version {} of the format, but 1 to 3 are due", version));
    const std::uint64_t prefix = version == 1 ? 10 : 12;
    const std::uint64_t length = version == 1 ? byte(8) + 256 * byte(9)
                                              : byte(8) + 256 * (byte(9) + 256 * (byte(10) + 256 * byte(11)));
    if (length > 65536) fail(8, fmt::format("found a header of {} bytes, but at most 65536 are due", length));
    data_ = prefix + length;
    std::string header(length, '\0');
    stream_->seek(prefix);
    for (have = 0; have < length;) {
      const std::size_t got = stream_->read(header.data() + have, length - have);
      if (got == 0) fail(prefix + have, "the file ends in the header; it was cut off");
      have += got;
    }
    parse(header, prefix);
  }

  void parse(const std::string& header, std::uint64_t at) {
    std::smatch found;
    static const std::regex type("'descr':\\s*'([<>=|]?)([a-z])([0-9]{1,3})'"),
        order("'fortran_order':\\s*(True|False)"), shape("'shape':\\s*\\(([0-9, ]{0,100})\\)");
    if (!std::regex_search(header, found, type))
      fail(at, "the header does not say what the numbers are (descr)");
    const std::string letter = found[2], bytes = found[3];
    if (letter != "f" || (bytes != "4" && bytes != "8"))
      fail(at, fmt::format("found numbers of the type '{}{}', but f4 or f8 is due", letter, bytes));
    width_ = bytes == "4" ? 4 : 8;
    swapped_ = found[1] == (std::endian::native == std::endian::little ? ">" : "<");
    if (!std::regex_search(header, found, order) || found[1] == "True")
      fail(at, "the array is in Fortran order, but C order is due; save it with numpy.ascontiguousarray");
    if (!std::regex_search(header, found, shape)) fail(at, "the header does not say the array's shape");
    std::vector<std::uint64_t> extents;
    const std::string list = found[1];
    for (std::size_t from = 0; from < list.size();) {
      const std::size_t comma = std::min(list.find(',', from), list.size());
      const std::string part = list.substr(from, comma - from);
      from = comma + 1;
      if (cellsOf(part).empty()) continue;
      const auto value = wholeNumberIn(part);
      if (!value) fail(at, fmt::format("found '{}' in the array's shape, but a whole number is due", part));
      extents.push_back(static_cast<std::uint64_t>(*value));
    }
    if (extents.size() == 2) extents.insert(extents.begin(), 1);
    if (extents.size() != 3 || extents[2] < 3 || extents[2] > 100)
      fail(at, fmt::format(
                   "found an array of the shape ({}), but (frames, grains, 3 or 4) or (grains, 3 or 4) is "
                   "due",
                   list));
    frames_ = extents[0];
    rows_ = extents[1];
    columns_ = extents[2];
    if (rows_ == 0) fail(at, "the frames hold no grains");
    if (rows_ > mostNumbersInFrame / columns_)
      fail(at, fmt::format("a frame has {} x {} numbers, but at most {} are read", rows_, columns_,
                           mostNumbersInFrame));
    frameBytes_ = rows_ * columns_ * width_;
    present_ = frames_;
  }

  std::string name_;
  std::unique_ptr<ByteStream> stream_;
  std::uint64_t data_ = 0, frames_ = 0, rows_ = 0, columns_ = 0, frameBytes_ = 1, at_ = 0, present_ = 0;
  std::size_t width_ = 8;
  bool swapped_ = false;
  std::optional<std::uint64_t> cutAt_;
};

} // namespace

ReaderKind npy() {
  return {"NumPy array of (frames, n, 3 or 4)", "the bytes 93 4E 55 4D 50 59 (.npy)",
          [](std::string_view head) { return head.starts_with("\x93NUMPY"); },
          [](const ImportFile& file, const ImportSettings& settings) -> std::unique_ptr<FrameFormat> {
            return std::make_unique<Npy>(file, settings);
          }};
}

} // namespace sandglass
