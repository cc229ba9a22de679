// CSV with a line of names (comma, semicolon or tab between), and rows such as `id x y z` with white space
// between, with or without names, in a comment (# x y z r) or on the first line. Several frames in a file are
// told apart by a column of times or steps whose value changes, in rows also by an empty line, a comment, or
// the return of the first id where a column is named so.

#include "sim/io/import/table_text.h"

#include "sim/io/import/column_names.h"
#include "sim/io/import/row_parser.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sandglass {

namespace {

bool isComment(std::string_view line) {
  return !line.empty() && line.front() == '#';
}
bool isEmpty(std::string_view line) {
  return line.find_first_not_of(" \t\r") == std::string_view::npos;
}

/// The separator of a line that holds one, else white space (0).
char separatorOf(std::string_view line) {
  for (const char c : {',', ';', '\t'})
    if (line.find(c) != std::string_view::npos) return c;
  return 0;
}

bool anyWord(const std::vector<std::string_view>& cells) {
  return std::any_of(cells.begin(), cells.end(),
                     [](std::string_view cell) { return !cell.empty() && !numberIn(cell); });
}

std::string_view cellAt(std::string_view line, std::size_t index, char separator) {
  if (!separator || line.find('"') != std::string_view::npos) {
    const auto cells = cellsOf(line, separator);
    return index < cells.size() ? cells[index] : std::string_view();
  }
  for (; index > 0; --index) {
    const std::size_t at = line.find(separator);
    if (at == std::string_view::npos) return {};
    line.remove_prefix(at + 1);
  }
  return line.substr(0, line.find(separator));
}

/// "# time = 0.5", "# t: 0.5", "# time 0.5 s"; likewise step.
void readComment(std::string_view comment, FrameMark& mark) {
  std::string plain(comment.substr(1));
  for (char& c : plain)
    if (c == '=' || c == ':' || c == ',') c = ' ';
  const auto cells = cellsOf(plain);
  for (std::size_t k = 0; k + 1 < cells.size(); ++k) {
    if (cells[k] == "time" || cells[k] == "Time" || cells[k] == "t") {
      if (const auto value = numberIn(cells[k + 1]); value && std::isfinite(*value)) mark.time = value;
    } else if (cells[k] == "step" || cells[k] == "timestep" || cells[k] == "Timestep") {
      if (const auto value = wholeNumberIn(cells[k + 1])) mark.step = value;
    }
  }
}

/// Names in a comment: "# x y z r", and Yade's "#format x_y_z_r".
std::vector<std::string> namesIn(std::string_view comment) {
  std::string plain(comment.substr(1));
  auto cells = cellsOf(plain);
  if (cells.size() == 2 && cells[0] == "format") {
    for (char& c : plain)
      if (c == '_') c = ' ';
    cells = cellsOf(plain);
    cells.erase(cells.begin());
  }
  return {cells.begin(), cells.end()};
}

class TableText final : public TextFormat {
public:
  TableText(const ImportFile& file, const ImportSettings& settings, bool spaced)
      : TextFormat(file, settings) {
    readStart(walker(), spaced);
    for (std::size_t c = 0; c < names_.size(); ++c) {
      const std::string quantity = quantityOfColumn(names_[c], settings);
      if (quantity == "time") timeColumn_ = c;
      if (quantity == "step") stepColumn_ = c;
      if (quantity == "id" && named_) idColumn_ = c;
    }
  }

  std::optional<FrameMark> next() override {
    LineReader& in = walker();
    FrameMark mark;
    std::string_view line;
    while (in.peek(line) && (isEmpty(line) || isComment(line))) {
      if (isComment(line)) readComment(line, mark);
      in.next(line);
    }
    mark.offset = in.offset();
    mark.line = in.line();
    mark.index = frames_;
    if (!in.peek(line)) {
      if (frames_ == 0) in.fail("the file ends before the first row");
      return std::nullopt;
    }
    if (separator_ == 0 && names_.size() < 3) {
      in.next(line);
      in.fail(fmt::format("found {}, but at least three columns are due (x y z)", shownText(line)));
    }
    const std::string time(timeColumn_ ? cellAt(line, *timeColumn_, separator_) : std::string_view());
    const std::string step(stepColumn_ ? cellAt(line, *stepColumn_, separator_) : std::string_view());
    const std::string first(idColumn_ ? cellAt(line, *idColumn_, separator_) : std::string_view());
    if (timeColumn_) mark.time = number(in, time, *timeColumn_);
    if (stepColumn_ && !(mark.step = wholeNumberIn(step))) number(in, step, *stepColumn_);
    for (in.next(line); in.peek(line) && !endsFrame(line, time, step, first);)
      in.next(line);
    ++frames_;
    return mark;
  }

  RawFrame read(const FrameMark& mark) override {
    LineReader& in = jumper(mark);
    RawFrame frame;
    frame.time = mark.time;
    frame.step = mark.step;
    frame.firstLine = mark.line + 1;
    nameColumns(frame, names_);
    std::string_view line;
    std::string time, step, first;
    RowParser parser(in, frame, separator_);
    while (in.next(line)) {
      if (frame.rows == 0) {
        if (timeColumn_) time = cellAt(line, *timeColumn_, separator_);
        if (stepColumn_) step = cellAt(line, *stepColumn_, separator_);
        if (idColumn_) first = cellAt(line, *idColumn_, separator_);
      }
      parser.add(line);
      if (in.peek(line) && endsFrame(line, time, step, first)) break;
    }
    if (!named_) meanUnnamed(frame);
    return frame;
  }

private:
  double number(LineReader& in, std::string_view cell, std::size_t column) const {
    const auto value = numberIn(cell);
    if (value && std::isfinite(*value)) return *value;
    std::string_view line;
    in.next(line);
    in.fail(fmt::format("found {} in the column '{}', but a number is due", shownText(cell), names_[column]));
  }

  bool endsFrame(std::string_view line, const std::string& time, const std::string& step,
                 const std::string& first) const {
    if (isEmpty(line) || isComment(line)) return true;
    if (timeColumn_ && cellAt(line, *timeColumn_, separator_) != time) return true;
    if (stepColumn_ && cellAt(line, *stepColumn_, separator_) != step) return true;
    return idColumn_ && !timeColumn_ && !stepColumn_ && cellAt(line, *idColumn_, separator_) == first;
  }

  /// Names and the separator; leaves the reader before the first row.
  void readStart(LineReader& in, bool spaced) {
    std::string_view line;
    std::vector<std::string> commented;
    while (in.peek(line) && (isEmpty(line) || isComment(line))) {
      if (isComment(line)) commented = namesIn(line);
      if (isComment(line) && anyTime(line)) break; // belongs to the first frame
      in.next(line);
    }
    std::vector<std::string_view> cells;
    if (isComment(line) || !in.peek(line)) { // look beyond the comment of the first frame
      LineReader& ahead = jumper({in.offset(), in.line(), 0, {}, {}});
      while (ahead.next(line) && (isEmpty(line) || isComment(line)))
        if (isComment(line) && !anyTime(line)) commented = namesIn(line);
      if (isEmpty(line) || isComment(line)) in.fail("the file holds no rows");
    }
    separator_ = spaced ? '\0' : separatorOf(line);
    cells = cellsOf(line, separator_);
    if (commented.size() == cells.size() && !cells.empty() && !anyWord(cells)) {
      names_ = commented;
      named_ = true;
      return;
    }
    if (anyWord(cells) && std::none_of(cells.begin(), cells.end(), [](auto c) { return numberIn(c); })) {
      for (const auto& cell : cells)
        names_.emplace_back(cell.empty() ? fmt::format("column {}", names_.size() + 1) : std::string(cell));
      named_ = true;
      while (in.next(line) && (isEmpty(line) || isComment(line))) { // up to and with the line of names
      }
      return;
    }
    for (std::size_t c = 0; c < cells.size(); ++c)
      names_.push_back(fmt::format("column {}", c + 1));
    named_ = !settings().columns.empty(); // the settings name them by their place
  }

  static bool anyTime(std::string_view comment) {
    FrameMark mark;
    readComment(comment, mark);
    return mark.time || mark.step;
  }

  static void meanUnnamed(RawFrame& frame) {
    static const std::vector<std::string> three{"x", "y", "z"}, sized{"x", "y", "z", "radius"},
        counted{"id", "x", "y", "z"}, all{"id", "x", "y", "z", "radius"};
    const std::size_t count = frame.columns.size();
    const std::vector<std::string>* names = count == 3 ? &three : count == 5 ? &all : nullptr;
    if (count == 4) {
      std::vector<double> first = frame.columns[0].numbers;
      std::sort(first.begin(), first.end());
      const bool ids = std::all_of(first.begin(), first.end(), [](double v) { return v == std::floor(v); }) &&
                       std::adjacent_find(first.begin(), first.end()) == first.end();
      names = ids ? &counted : &sized;
    }
    if (!names) return; // they stay "column 1" and so on, and who builds the frame says what is missing
    std::string list;
    for (std::size_t c = 0; c < count; ++c) {
      frame.columns[c].name = (*names)[c];
      list += (c ? " " : "") + (*names)[c];
    }
    frame.remarks.push_back(fmt::format("the columns have no names and are taken for {}", list));
  }

  char separator_ = 0;
  std::vector<std::string> names_;
  bool named_ = false;
  std::optional<std::size_t> timeColumn_, stepColumn_, idColumn_;
  std::uint64_t frames_ = 0;
};

/// The first line that is neither empty nor a comment; the second such too.
std::pair<std::string_view, std::string_view> firstRows(std::string_view head) {
  std::string_view first, second;
  if (head.starts_with("\xef\xbb\xbf")) head.remove_prefix(3);
  while (!head.empty() && second.empty()) {
    const std::size_t end = head.find('\n');
    std::string_view line = head.substr(0, end);
    head.remove_prefix(end == std::string_view::npos ? head.size() : end + 1);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    if (isEmpty(line) || isComment(line)) continue;
    (first.empty() ? first : second) = line;
  }
  return {first, second};
}

bool isText(std::string_view head) {
  return std::none_of(head.begin(), head.end(), [](char c) { return c >= 0 && c < 9; });
}

} // namespace

ReaderKind csv() {
  return {"CSV table with names of columns", "a line of names with commas, semicolons or tabs between (CSV)",
          [](std::string_view head) {
            const auto [first, second] = firstRows(head);
            const char separator = separatorOf(first);
            if (!separator || !isText(head)) return false;
            return cellsOf(first, separator).size() >= 3 &&
                   !anyWord(cellsOf(second, separator).size() >= 3 ? std::vector<std::string_view>{}
                                                                   : cellsOf(second));
          },
          [](const ImportFile& file, const ImportSettings& settings) -> std::unique_ptr<FrameFormat> {
            return std::make_unique<TableText>(file, settings, false);
          }};
}

ReaderKind pointRows() {
  return {"rows of id x y z as text", "rows of three or more numbers (id x y z)",
          [](std::string_view head) {
            const auto [first, second] = firstRows(head);
            if (!isText(head) || separatorOf(first) == ',' || separatorOf(first) == ';') return false;
            const auto one = cellsOf(first), two = cellsOf(second);
            if (one.size() < 3) return false;
            const bool names = std::none_of(one.begin(), one.end(), [](auto c) { return numberIn(c); });
            return names ? two.size() == one.size() && numberIn(two.back()).has_value() : !anyWord(one);
          },
          [](const ImportFile& file, const ImportSettings& settings) -> std::unique_ptr<FrameFormat> {
            return std::make_unique<TableText>(file, settings, true);
          }};
}

} // namespace sandglass
