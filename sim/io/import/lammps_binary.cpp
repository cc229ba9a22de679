// Binary dumps of LAMMPS (dump custom and dump atom into a file .bin), of versions since 2020, whose frames
// begin with a magic word; as LAMMPS' tool binary2txt reads them:
//
//   int64 -(length of the magic word), "DUMPCUSTOM" or "DUMPATOM", int32 1 (order of bytes), int32 revision
//   int64 step, int64 atoms, int32 tilted, int32 boundary[6], double bounds[6], [double tilt[3]]
//   int32 numbers an atom, from revision 2: text units, char time is said, [double time], text columns
//   int32 chunks; each: int32 count of numbers, double numbers[count]        (text: int32 length, characters)

#include "sim/io/import/lammps_binary.h"

#include "sim/io/import/lammps_box.h"
#include "sim/io/import/row_parser.h"

#include "sim/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace sandglass {

namespace {

/// Values of the native kind one after the other, with the place for messages.
class Bytes {
public:
  explicit Bytes(const ImportFile& file) : name_(file.name()), stream_(file.open()) {}

  std::uint64_t at() const { return end_ - (block_.size() - next_); }
  void seek(std::uint64_t offset) {
    stream_->seek(offset);
    end_ = offset;
    block_.clear();
    next_ = 0;
  }
  /// False when the file ends before the first byte.
  bool take(void* to, std::size_t size, bool mayEnd = false) {
    for (std::size_t have = 0; have < size;) {
      if (next_ == block_.size() && !refill()) {
        if (have == 0 && mayEnd) return false;
        fail("the file ends in a frame; it was cut off");
      }
      const std::size_t got = std::min(size - have, block_.size() - next_);
      std::memcpy(static_cast<char*>(to) + have, block_.data() + next_, got);
      next_ += got;
      have += got;
    }
    return true;
  }
  template <class T> T value() {
    T v;
    take(&v, sizeof v);
    return v;
  }
  std::string text(std::size_t most) {
    const auto length = value<std::int32_t>();
    if (length < 0 || static_cast<std::size_t>(length) > most)
      fail(fmt::format("found a text of {} characters, but at most {} are due", length, most));
    std::string words(static_cast<std::size_t>(length), '\0');
    take(words.data(), words.size());
    return words;
  }
  [[noreturn]] void fail(const std::string& sentence) const {
    throw InputError(fmt::format("{}: byte {}: {}", name_, at(), sentence));
  }

private:
  bool refill() {
    block_.resize(std::size_t{1} << 16);
    next_ = 0;
    const std::size_t got = stream_->read(block_.data(), block_.size());
    block_.resize(got);
    end_ += got;
    return got > 0;
  }
  std::string name_;
  std::unique_ptr<ByteStream> stream_;
  std::vector<char> block_;
  std::size_t next_ = 0;
  std::uint64_t end_ = 0; ///< where the block ends in the file
};

struct Header {
  std::int64_t step = 0;
  std::uint64_t atoms = 0;
  std::uint64_t width = 0; // numbers an atom
  Domain box;
  Vec3 tilt = Vec3::Zero();
  std::optional<double> time;
  std::string units;
  std::vector<std::string> columns;
};

class LammpsBinary final : public FrameFormat {
public:
  explicit LammpsBinary(const ImportFile& file) : walker_(file), jumper_(file) {}

  std::optional<FrameMark> next() override {
    const std::uint64_t start = walker_.at();
    Header header;
    if (!readHeader(walker_, header)) return std::nullopt;
    // Over the numbers in blocks: the end of a plain file is met where it is, and a packed one has to be
    // read.
    std::vector<char> block(std::size_t{1} << 16);
    eachChunk(walker_, header, [&](std::uint64_t numbers) {
      for (std::uint64_t left = numbers * sizeof(double); left > 0;) {
        const auto piece = static_cast<std::size_t>(std::min<std::uint64_t>(left, block.size()));
        walker_.take(block.data(), piece);
        left -= piece;
      }
    });
    return FrameMark{start, 0, frames_++, header.time, header.step};
  }

  RawFrame read(const FrameMark& mark) override {
    jumper_.seek(mark.offset);
    Header header;
    if (!readHeader(jumper_, header)) jumper_.fail("the file has changed since it was opened");
    RawFrame frame;
    frame.time = header.time;
    frame.step = header.step;
    frame.box = header.box;
    frame.tilt = header.tilt;
    frame.rows = header.atoms;
    for (const auto& name : header.columns)
      frame.columns.push_back({name, {}, {}});
    if (!header.units.empty() && header.units != "si" && header.units != "lj")
      frame.remarks.push_back(unitsRemark(header.units));
    std::vector<double> row(header.width);
    eachChunk(jumper_, header, [&](std::uint64_t numbers) {
      for (std::uint64_t k = 0; k < numbers / header.width; ++k) {
        jumper_.take(row.data(), row.size() * sizeof(double));
        for (std::size_t c = 0; c < row.size(); ++c)
          frame.columns[c].numbers.push_back(row[c]);
      }
    });
    return frame;
  }

private:
  static bool readHeader(Bytes& in, Header& header) {
    std::int64_t length = 0;
    if (!in.take(&length, sizeof length, true)) return false;
    if (length != -8 && length != -10)
      in.fail("no frame of a binary LAMMPS dump begins here; the file is damaged");
    std::string magic(static_cast<std::size_t>(-length), '\0');
    in.take(magic.data(), magic.size());
    if (magic != "DUMPATOM" && magic != "DUMPCUSTOM")
      in.fail("no frame of a binary LAMMPS dump begins here; the file is damaged");
    if (in.value<std::int32_t>() != 1)
      in.fail(
          "the dump was written on a machine with another order of bytes; write it as text (a name without "
          ".bin)");
    const auto revision = in.value<std::int32_t>();
    if (revision < 1 || revision > 2)
      in.fail(
          fmt::format("found revision {} of the format, but 1 or 2 is due; write the dump as text (a name "
                      "without .bin)",
                      revision));
    header.step = in.value<std::int64_t>();
    const auto atoms = in.value<std::int64_t>();
    if (atoms < 0 || static_cast<std::uint64_t>(atoms) > mostNumbersInFrame)
      in.fail(fmt::format("found {} atoms, but 0 to {} are due", atoms, mostNumbersInFrame));
    header.atoms = static_cast<std::uint64_t>(atoms);
    const bool tilted = in.value<std::int32_t>() != 0;
    readBox(in, tilted, header);
    const auto width = in.value<std::int32_t>();
    constexpr std::int32_t mostColumns = 1000;
    if (width < 1 || width > mostColumns)
      in.fail(fmt::format("found {} numbers an atom, but 1 to {} are due", width, mostColumns));
    header.width = static_cast<std::uint64_t>(width);
    if (header.atoms * header.width > mostNumbersInFrame)
      in.fail(fmt::format("a frame has {} x {} numbers, but at most {} are read", header.atoms, header.width,
                          mostNumbersInFrame));
    if (revision > 1) readTexts(in, header);
    nameColumns(in, magic == "DUMPATOM", header);
    return true;
  }

  static void readBox(Bytes& in, bool tilted, Header& header) {
    for (std::size_t k = 0; k < 3; ++k) {
      header.box.periodic[k] = in.value<std::int32_t>() == 0; // 0 0: repeats on both ends
      in.value<std::int32_t>();
    }
    for (int k = 0; k < 3; ++k) {
      header.box.lower[k] = in.value<double>();
      header.box.upper[k] = in.value<double>();
    }
    if (tilted)
      for (int k = 0; k < 3; ++k)
        header.tilt[k] = in.value<double>();
    if (!header.box.lower.allFinite() || !header.box.upper.allFinite() || !header.tilt.allFinite() ||
        !takeCornersOff(header.box, header.tilt))
      in.fail("its box has an upper end below the lower one, or ends that are no numbers");
  }

  static void readTexts(Bytes& in, Header& header) {
    constexpr std::size_t mostUnits = 100, mostNames = 1 << 16;
    header.units = in.text(mostUnits);
    if (in.value<char>() != 0) {
      header.time = in.value<double>();
      if (!std::isfinite(*header.time)) in.fail("found a time that is no finite number");
    }
    const std::string names = in.text(mostNames);
    for (const auto& cell : cellsOf(names))
      header.columns.emplace_back(cell);
  }

  static void nameColumns(const Bytes& in, bool atomStyle, Header& header) {
    if (header.columns.empty() && atomStyle && header.width == 5)
      header.columns = {"id", "type", "xs", "ys", "zs"};
    if (header.columns.empty())
      for (std::uint64_t c = 0; c < header.width; ++c)
        header.columns.push_back(fmt::format("column {}", c + 1));
    if (header.columns.size() != header.width)
      in.fail(fmt::format("found {} names of columns, but {} numbers an atom", header.columns.size(),
                          header.width));
  }

  /// work(numbers) takes those of one chunk (what one process wrote) from `in`.
  template <class Work> static void eachChunk(Bytes& in, const Header& header, Work&& work) {
    const auto chunks = in.value<std::int32_t>();
    std::uint64_t left = header.atoms * header.width;
    for (std::int32_t k = 0; k < chunks; ++k) {
      const auto count = in.value<std::int32_t>();
      if (count < 0 || static_cast<std::uint64_t>(count) > left ||
          static_cast<std::uint64_t>(count) % header.width)
        in.fail(
            fmt::format("found a chunk of {} numbers, but whole atoms of {} numbers and at most {} are due",
                        count, header.width, left));
      work(static_cast<std::uint64_t>(count));
      left -= static_cast<std::uint64_t>(count);
    }
    if (left != 0) in.fail(fmt::format("the chunks hold {} numbers fewer than the atoms have", left));
  }

  Bytes walker_, jumper_;
  std::uint64_t frames_ = 0;
};

} // namespace

bool looksLikeOldLammpsBinary(std::string_view head) {
  struct {
    std::int64_t step, atoms;
    std::int32_t tilted, boundary[6];
  } start;
  constexpr std::size_t size = 8 + 8 + 4 + 6 * 4;
  if (head.size() < size + 6 * sizeof(double)) return false;
  std::memcpy(&start, head.data(), size);
  const bool boundaries = std::all_of(std::begin(start.boundary), std::end(start.boundary),
                                      [](std::int32_t b) { return b >= 0 && b <= 3; });
  double bounds[6];
  std::memcpy(bounds, head.data() + size, sizeof bounds);
  return start.step >= 0 && start.step < (std::int64_t{1} << 40) && start.atoms > 0 &&
         start.atoms <= static_cast<std::int64_t>(mostNumbersInFrame) &&
         (start.tilted == 0 || start.tilted == 1) && boundaries && bounds[0] < bounds[1] &&
         bounds[2] < bounds[3] && bounds[4] < bounds[5];
}

ReaderKind lammpsBinary() {
  return {"LAMMPS binary dump", "DUMPATOM or DUMPCUSTOM at byte 8 (LAMMPS .bin)",
          [](std::string_view head) {
            return head.size() > 16 &&
                   (head.substr(8, 8) == "DUMPATOM" || head.substr(8, 10) == "DUMPCUSTOM");
          },
          [](const ImportFile& file, const ImportSettings&) -> std::unique_ptr<FrameFormat> {
            return std::make_unique<LammpsBinary>(file);
          }};
}

} // namespace sandglass
