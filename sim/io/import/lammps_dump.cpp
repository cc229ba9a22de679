// Text dumps of LAMMPS and LIGGGHTS (https://docs.lammps.org/dump.html) and the snapshots that carry the same
// headings without names of columns: `id type diameter x y z` with a bare box (2007) and LAMMPS' own of
// before 2010, `id type xs ys zs`.
//
//   ITEM: UNITS / ITEM: TIME         may stand before the step
//   ITEM: TIMESTEP
//   ITEM: NUMBER OF ATOMS
//   ITEM: BOX BOUNDS [xy xz yz] pp pp ff
//   ITEM: ATOMS id type x y z ...

#include "sim/io/import/lammps_dump.h"

#include "sim/io/import/lammps_box.h"
#include "sim/io/import/row_parser.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sandglass {

namespace {

struct Header {
  std::optional<double> time;
  std::optional<std::int64_t> step;
  std::optional<std::uint64_t> count;
  std::optional<Domain> box;
  Vec3 tilt = Vec3::Zero(); // xy, xz, yz
  std::string units;
  std::vector<std::string> columns;
  bool found = false; ///< false: the file ended before it
};

class LammpsDump final : public TextFormat {
public:
  using TextFormat::TextFormat;

  std::optional<FrameMark> next() override {
    LineReader& in = walker();
    const FrameMark start{in.offset(), in.line(), frames_, {}, {}};
    const Header header = readHeader(in);
    if (!header.found) return std::nullopt;
    const std::uint64_t heading = in.line();
    const std::uint64_t rows = in.skip(*header.count);
    if (rows < *header.count || (rows > 0 && !in.ended()))
      in.fail(fmt::format("the file ends {} row {} of the {} that line {} promises; it was cut off",
                          in.ended() ? "after" : "in", rows, *header.count, countLine_));
    std::string_view line;
    while (in.peek(line) && cellsOf(line).empty())
      in.next(line); // blank lines at the end
    if (in.peek(line) && !line.starts_with("ITEM:")) {
      in.next(line);
      in.fail(fmt::format("found {}, but 'ITEM: TIMESTEP' is due after the {} rows that line {} promises for "
                          "the frame of line {}",
                          shownText(line), rows, countLine_, heading));
    }
    ++frames_;
    return FrameMark{start.offset, start.line, start.index, header.time, header.step};
  }

  RawFrame read(const FrameMark& mark) override {
    LineReader& in = jumper(mark);
    const Header header = readHeader(in);
    RawFrame frame;
    frame.time = header.time;
    frame.step = header.step;
    frame.box = header.box;
    frame.tilt = header.tilt;
    frame.firstLine = in.line() + 1;
    std::string_view line;
    std::vector<std::string> names = header.columns;
    if (names.empty() && *header.count > 0 && in.peek(line))
      names = oldColumns(in, cellsOf(line).size(), frame);
    nameColumns(frame, names);
    if (!header.units.empty() && header.units != "si" && header.units != "lj")
      frame.remarks.push_back(unitsRemark(header.units));
    RowParser parser(in, frame);
    parser.expect(*header.count, bytesLeft(in));
    for (std::uint64_t k = 0; k < *header.count; ++k) {
      if (!in.next(line)) in.fail("the file ends before the last row; it has changed since it was opened");
      parser.add(line);
    }
    return frame;
  }

private:
  Header readHeader(LineReader& in) {
    Header header;
    std::string_view line;
    while (in.next(line)) {
      if (cellsOf(line).empty()) continue; // blank lines between frames
      if (!line.starts_with("ITEM: "))
        in.fail(fmt::format("found {}, but a line that begins with 'ITEM: ' is due", shownText(line)));
      const std::string item(line.substr(6));
      if (item.starts_with("ATOMS") || item.starts_with("ENTRIES")) {
        if (item.starts_with("ENTRIES"))
          in.fail("this is a local dump (of bonds or contacts), but only dumps of atoms can be read");
        for (const auto& cell : cellsOf(line.substr(11)))
          header.columns.emplace_back(cell);
        if (!header.count) in.fail("the rows begin, but 'ITEM: NUMBER OF ATOMS' has not been said");
        header.found = true;
        return header;
      }
      readItem(in, item, header);
    }
    if (header.step || header.time || header.count)
      in.fail("the file ends before 'ITEM: ATOMS'; it was cut off");
    return header;
  }

  void readItem(LineReader& in, const std::string& item, Header& header) {
    if (item.starts_with("BOX BOUNDS")) {
      header.box = readBox(in, item, header.tilt);
      return;
    }
    std::string_view line;
    if (!in.next(line)) in.fail(fmt::format("the file ends after 'ITEM: {}'; it was cut off", item));
    if (item.starts_with("TIMESTEP")) {
      // LIGGGHTS and some converters put a time where the step belongs.
      if (!(header.step = wholeNumberIn(line)) && !(header.time = finite(line)))
        in.fail(fmt::format("found {}, but the number of the step is due", shownText(line)));
    } else if (item.starts_with("TIME")) {
      if (!(header.time = finite(line)))
        in.fail(fmt::format("found {}, but the time is due", shownText(line)));
    } else if (item.starts_with("NUMBER OF ATOMS")) {
      const auto count = wholeNumberIn(line);
      if (!count || *count < 0)
        in.fail(fmt::format("found {}, but the number of atoms is due", shownText(line)));
      header.count = static_cast<std::uint64_t>(*count);
      countLine_ = in.line();
    } else if (item.starts_with("UNITS")) {
      header.units = std::string(line);
    } // one line each for what else there may be (LABEL)
  }

  static std::optional<double> finite(std::string_view text) {
    const auto value = numberIn(text);
    return value && std::isfinite(*value) ? value : std::optional<double>{};
  }

  static Domain readBox(LineReader& in, const std::string& item, Vec3& tilts) {
    Domain box;
    const auto words = cellsOf(std::string_view(item).substr(10));
    const auto has = [&](std::string_view word) {
      return std::find(words.begin(), words.end(), word) != words.end();
    };
    if (has("abc"))
      in.fail("the box is given by three general vectors; write the dump with 'dump_modify triclinic/general "
              "no'");
    const bool tilted = has("xy");
    for (std::size_t k = 0, flags = 0; k < words.size(); ++k) {
      if (words[k].size() != 2 || words[k] == "xy" || words[k] == "xz" || words[k] == "yz") continue;
      if (flags < 3) box.periodic[flags++] = words[k] == "pp";
    }
    for (int k = 0; k < 3; ++k) {
      std::string_view line;
      if (!in.next(line)) in.fail("the file ends in the bounds of the box; it was cut off");
      const auto cells = cellsOf(line);
      if (cells.size() != (tilted ? 3u : 2u))
        in.fail(fmt::format("found {}, but the bounds of the box along {} are due ({} numbers)",
                            shownText(line), "xyz"[k], tilted ? 3 : 2));
      const auto low = finite(cells[0]), high = finite(cells[1]),
                 tilt = tilted ? finite(cells[2]) : std::optional<double>(0);
      if (!low || !high || !tilt || !(*low <= *high))
        in.fail(fmt::format("found {}, but the lower and the upper end of the box along {} are due",
                            shownText(line), "xyz"[k]));
      tilts[k] = *tilt;
      box.lower[k] = *low;
      box.upper[k] = *high;
    }
    if (!takeCornersOff(box, tilts))
      in.fail(fmt::format("the tilts {:g} {:g} {:g} are larger than the bounds of the box allow", tilts[0],
                          tilts[1], tilts[2]));
    return box;
  }

  static std::vector<std::string> oldColumns(LineReader& in, std::size_t count, RawFrame& frame) {
    if (count == 6) return {"id", "type", "diameter", "x", "y", "z"};
    if (count == 5) {
      frame.remarks.emplace_back("the columns have no names and are taken for id type xs ys zs, LAMMPS' old "
                                 "default");
      return {"id", "type", "xs", "ys", "zs"};
    }
    in.fail(
        fmt::format("the columns have no names; unnamed ones are read as id type diameter x y z (6) or id "
                    "type xs ys zs (5), but there are {}",
                    count));
  }

  std::uint64_t frames_ = 0, countLine_ = 0;
};

} // namespace

ReaderKind lammpsDump() {
  return {"LAMMPS or LIGGGHTS text dump, ITEM: snapshot", "'ITEM: TIMESTEP'",
          [](std::string_view head) { return head.starts_with("ITEM: "); },
          [](const ImportFile& file, const ImportSettings& settings) -> std::unique_ptr<FrameFormat> {
            return std::make_unique<LammpsDump>(file, settings);
          }};
}

} // namespace sandglass
