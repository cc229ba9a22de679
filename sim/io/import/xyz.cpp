// XYZ: a line with the number of grains, a line of comment, a row `name x y z` each. Extended XYZ
// (https://github.com/libAtoms/extxyz) says in the comment what the columns are and what the box is:
//
//   Lattice="10 0 0 0 10 0 0 0 80" Origin="0 0 0" pbc="T T F" Properties=species:S:1:pos:R:3:radius:R:1
//   Time=0.5

#include "sim/io/import/xyz.h"

#include "sim/io/import/row_parser.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

namespace sandglass {

namespace {

std::string lower(std::string_view text) {
  std::string low(text);
  std::transform(low.begin(), low.end(), low.begin(), [](unsigned char c) { return std::tolower(c); });
  return low;
}

/// key=value, key="a value", key={a value} of a comment; keys in lower case.
std::map<std::string, std::string> pairsOf(std::string_view comment) {
  std::map<std::string, std::string> pairs;
  std::size_t at = 0;
  const auto blank = [&](std::size_t k) { return comment[k] == ' ' || comment[k] == '\t'; };
  while (at < comment.size()) {
    while (at < comment.size() && blank(at))
      ++at;
    const std::size_t from = at;
    while (at < comment.size() && !blank(at) && comment[at] != '=')
      ++at;
    const std::string key = lower(comment.substr(from, at - from));
    if (at == comment.size() || comment[at] != '=') continue;
    ++at;
    const char open = at < comment.size() ? comment[at] : ' ';
    const char close = open == '{' ? '}' : open == '[' ? ']' : open;
    std::size_t begin = at, end = at;
    if (open == '"' || open == '\'' || open == '{' || open == '[') {
      begin = at + 1;
      end = std::min(comment.find(close, begin), comment.size());
      at = std::min(end + 1, comment.size());
    } else {
      while (end < comment.size() && !blank(end))
        ++end;
      at = end;
    }
    pairs[key] = std::string(comment.substr(begin, end - begin));
  }
  return pairs;
}

/// "Atoms. Timestep: 1200", as LAMMPS' dump xyz writes.
std::optional<std::int64_t> stepIn(std::string_view comment) {
  const std::string low = lower(comment);
  const std::size_t at = low.find("timestep:");
  if (at == std::string::npos) return std::nullopt;
  const auto words = cellsOf(comment.substr(at + 9));
  return words.empty() ? std::optional<std::int64_t>{} : wholeNumberIn(words[0]);
}

class Xyz final : public TextFormat {
public:
  using TextFormat::TextFormat;

  std::optional<FrameMark> next() override {
    LineReader& in = walker();
    FrameMark mark{in.offset(), in.line(), frames_, {}, {}};
    const auto count = readCount(in);
    if (!count) return std::nullopt;
    const std::uint64_t countLine = in.line();
    std::string_view comment;
    if (!in.next(comment)) in.fail("the file ends before the comment line; it was cut off");
    readTimes(comment, mark.time, mark.step);
    const std::uint64_t rows = in.skip(*count);
    if (rows < *count)
      in.fail(fmt::format("the file ends after {} rows of the {} that line {} promises; it was cut off", rows,
                          *count, countLine));
    std::string_view line;
    while (in.peek(line) && cellsOf(line).empty())
      in.next(line);
    if (in.peek(line)) {
      const auto cells = cellsOf(line);
      if (cells.size() != 1 || !wholeNumberIn(cells[0])) {
        in.next(line);
        in.fail(
            fmt::format("found {}, but the number of grains of the next frame is due after the {} rows that "
                        "line {} promises",
                        shownText(line), *count, countLine));
      }
    }
    ++frames_;
    return mark;
  }

  RawFrame read(const FrameMark& mark) override {
    LineReader& in = jumper(mark);
    RawFrame frame;
    const std::uint64_t count = readCount(in).value_or(0);
    std::string_view line;
    if (!in.next(line)) in.fail("the file has changed since it was opened");
    readTimes(line, frame.time, frame.step);
    const auto pairs = pairsOf(line);
    readBox(in, pairs, frame);
    std::vector<std::string> names;
    if (const auto properties = pairs.find("properties"); properties != pairs.end()) {
      names = columnsOf(in, properties->second);
    } else {
      names = {"species", "x", "y", "z"};
      if (count > 0 && in.peek(line)) {
        const std::size_t cells = cellsOf(line).size();
        if (cells == 3) names.erase(names.begin());
        for (std::size_t k = 4; k < cells; ++k)
          names.push_back(fmt::format("column {}", k + 1));
        if (cells > 4)
          frame.remarks.push_back(
              "columns beyond 'name x y z' have no names; they are called 'column 5' and so "
              "on, and --columns gives them a meaning");
      }
    }
    nameColumns(frame, names);
    frame.firstLine = in.line() + 1;
    RowParser parser(in, frame);
    parser.expect(count, bytesLeft(in));
    for (std::uint64_t k = 0; k < count; ++k) {
      if (!in.next(line)) in.fail("the file ends before the last row; it has changed since it was opened");
      parser.add(line);
    }
    return frame;
  }

private:
  static std::optional<std::uint64_t> readCount(LineReader& in) {
    std::string_view line;
    do {
      if (!in.next(line)) return std::nullopt;
    } while (cellsOf(line).empty());
    const auto count = wholeNumberIn(line);
    if (!count || *count < 0)
      in.fail(fmt::format("found {}, but the number of grains is due", shownText(line)));
    return static_cast<std::uint64_t>(*count);
  }

  static void readTimes(std::string_view comment, std::optional<double>& time,
                        std::optional<std::int64_t>& step) {
    const auto pairs = pairsOf(comment);
    const auto number = [&](const char* key) {
      const auto it = pairs.find(key);
      const auto value = it == pairs.end() ? std::optional<double>{} : numberIn(it->second);
      return value && std::isfinite(*value) ? value : std::optional<double>{};
    };
    time = number("time");
    step = stepIn(comment);
    for (const char* key : {"timestep", "step"})
      if (const auto it = pairs.find(key); !step && it != pairs.end()) step = wholeNumberIn(it->second);
  }

  static void readBox(LineReader& in, const std::map<std::string, std::string>& pairs, RawFrame& frame) {
    const auto numbers = [&](const char* key, std::size_t due) {
      std::vector<double> values;
      const auto it = pairs.find(key);
      if (it == pairs.end()) return values;
      for (const auto& cell : cellsOf(it->second)) {
        const auto value = numberIn(cell);
        if (!value || !std::isfinite(*value)) break;
        values.push_back(*value);
      }
      if (values.size() != due || cellsOf(it->second).size() != due)
        in.fail(fmt::format("found {}=\"{}\", but {} numbers are due", key, it->second.substr(0, 60), due));
      return values;
    };
    const auto lattice = numbers("lattice", 9);
    if (lattice.empty()) return;
    if (lattice[1] != 0 || lattice[2] != 0 || lattice[5] != 0)
      in.fail("the first edge of the box is not along x, or the second one not in the plane of x and y; turn "
              "box and grains so that they are, as LAMMPS has them");
    frame.tilt = {lattice[3], lattice[6], lattice[7]};
    Domain box;
    const auto origin = numbers("origin", 3);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<int>(k);
      if (lattice[4 * k] < 0) in.fail("the box has an edge below 0");
      box.lower[axis] = origin.empty() ? 0 : origin[k];
      box.upper[axis] = box.lower[axis] + lattice[4 * k];
    }
    // Without pbc a box counts as periodic, as in ASE and OVITO.
    const auto pbc = pairs.find("pbc");
    const std::string text = pbc == pairs.end() ? "T T T" : pbc->second;
    const auto flags = cellsOf(text);
    for (std::size_t k = 0; k < 3; ++k) {
      if (flags.size() != 3) in.fail(fmt::format("found pbc=\"{}\", but three of T and F are due", text));
      const char c = flags[k].front();
      box.periodic[k] = c == 'T' || c == 't' || c == '1';
    }
    frame.box = box;
  }

  /// "species:S:1:pos:R:3:radius:R:1"
  static std::vector<std::string> columnsOf(LineReader& in, const std::string& properties) {
    std::vector<std::string> parts, names;
    for (std::size_t from = 0;;) {
      const std::size_t colon = properties.find(':', from);
      parts.push_back(properties.substr(from, colon - from));
      if (colon == std::string::npos) break;
      from = colon + 1;
    }
    const auto bad = [&] {
      in.fail(fmt::format("found Properties={}, but triples NAME:TYPE:COUNT are due, such as "
                          "species:S:1:pos:R:3",
                          properties.substr(0, 80)));
    };
    if (parts.size() % 3 != 0) bad();
    for (std::size_t k = 0; k < parts.size(); k += 3) {
      const auto count = wholeNumberIn(parts[k + 2]);
      if (!count || *count < 1 || *count > 1000 || parts[k].empty()) bad();
      if (*count == 1) names.push_back(parts[k]);
      for (std::int64_t c = 0; *count > 1 && c < *count; ++c)
        names.push_back(*count <= 4 ? parts[k] + "." + "xyzw"[c] : fmt::format("{}.{}", parts[k], c + 1));
    }
    return names;
  }

  std::uint64_t frames_ = 0;
};

} // namespace

ReaderKind xyz() {
  return {"XYZ, extended XYZ", "a line with the number of grains alone (XYZ)",
          [](std::string_view head) {
            const std::size_t end = head.find('\n');
            if (end == std::string_view::npos) return false;
            const auto cells = cellsOf(head.substr(0, end));
            return cells.size() == 1 && wholeNumberIn(cells[0]).has_value();
          },
          [](const ImportFile& file, const ImportSettings& settings) -> std::unique_ptr<FrameFormat> {
            return std::make_unique<Xyz>(file, settings);
          }};
}

} // namespace sandglass
