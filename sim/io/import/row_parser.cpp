#include "sim/io/import/row_parser.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>

namespace sandglass {

namespace {

constexpr std::size_t mostWords = 65536;

bool isBlank(char c) {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f' || c == '\r';
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && isBlank(text.front()))
    text.remove_prefix(1);
  while (!text.empty() && isBlank(text.back()))
    text.remove_suffix(1);
  return text;
}

/// Reads a number at `at` that ends at a blank or at `end`; null when there is none.
const char* readNumber(const char* at, const char* end, double& value) {
  if (at != end && *at == '+') {
    ++at;
    if (at != end && *at == '-') return nullptr;
  }
  const auto [stop, fault] = std::from_chars(at, end, value);
  return fault == std::errc() && (stop == end || isBlank(*stop)) ? stop : nullptr;
}

/// The cell at the start of `rest`, and what follows its separator.
std::string_view cutCell(std::string_view& rest, char separator, bool& last) {
  std::size_t end = 0;
  std::string_view cell;
  const std::string_view start = trimmed(rest);
  if (!start.empty() && start.front() == '"') {
    const std::size_t open = rest.find('"');
    const std::size_t close = rest.find('"', open + 1);
    if (close != std::string_view::npos) {
      cell = rest.substr(open + 1, close - open - 1);
      end = rest.find(separator, close);
      last = end == std::string_view::npos;
      rest.remove_prefix(last ? rest.size() : end + 1);
      return cell;
    }
  }
  end = rest.find(separator);
  last = end == std::string_view::npos;
  cell = trimmed(rest.substr(0, end));
  rest.remove_prefix(last ? rest.size() : end + 1);
  return cell;
}

} // namespace

std::optional<double> numberIn(std::string_view text) {
  double value = 0;
  text = trimmed(text);
  const char* end = text.data() + text.size();
  if (text.empty() || readNumber(text.data(), end, value) != end) return std::nullopt;
  return value;
}

std::optional<std::int64_t> wholeNumberIn(std::string_view text) {
  text = trimmed(text);
  std::int64_t value = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  constexpr std::int64_t most = std::int64_t{1} << 53;
  if (fault != std::errc() || end != text.data() + text.size() || value > most || value < -most)
    return std::nullopt;
  return value;
}

std::vector<std::string_view> cellsOf(std::string_view line, char separator) {
  std::vector<std::string_view> cells;
  if (separator) {
    for (bool last = false; !last;)
      cells.push_back(cutCell(line, separator, last));
    return cells;
  }
  for (std::size_t at = 0;;) {
    while (at < line.size() && isBlank(line[at]))
      ++at;
    if (at == line.size()) return cells;
    const std::size_t from = at;
    while (at < line.size() && !isBlank(line[at]))
      ++at;
    cells.push_back(line.substr(from, at - from));
  }
}

RowParser::RowParser(LineReader& in, RawFrame& frame, char separator)
    : in_(in), frame_(frame), separator_(separator), words_(frame.columns.size()) {}

void RowParser::expect(std::uint64_t rows, std::optional<std::uint64_t> bytesLeft) {
  const std::uint64_t columns = std::max<std::size_t>(1, frame_.columns.size());
  if (rows > mostNumbersInFrame / columns)
    in_.fail(fmt::format("the frame has {} grains in {} columns, but a frame holds at most {} numbers; split "
                         "the file or leave columns out",
                         rows, columns, mostNumbersInFrame));
  if (!bytesLeft) return; // packed: what it unfolds to is not known, so memory grows with what comes
  rows = std::min(rows, *bytesLeft / (2 * columns) + 1); // a cell and a blank each
  for (auto& column : frame_.columns)
    column.numbers.reserve(rows);
}

void RowParser::addCell(std::size_t c, std::string_view cell) {
  RawColumn& column = frame_.columns[c];
  auto& known = words_[c];
  if (known.empty()) {
    if (const auto number = numberIn(cell)) {
      column.numbers.push_back(*number);
      return;
    }
    if (cell.empty() && separator_) { // a cell that was left empty
      column.numbers.push_back(std::numeric_limits<double>::quiet_NaN());
      return;
    }
    if (frame_.rows > 0)
      in_.fail(fmt::format("found {} in the column '{}', but a number is due", shownText(cell), column.name));
  }
  const auto it = known.find(cell);
  if (it != known.end()) {
    column.numbers.push_back(it->second);
    return;
  }
  if (known.size() >= mostWords)
    in_.fail(fmt::format("the column '{}' holds more than {} different words; name it under [columns] ignore "
                         "in the file of --columns",
                         column.name, mostWords));
  const double index = static_cast<double>(known.size());
  known.emplace(cell, index);
  column.words.emplace_back(cell);
  column.numbers.push_back(index);
}

void RowParser::wrongCount(std::size_t found) const {
  std::string names;
  for (const auto& column : frame_.columns)
    names += (names.empty() ? "" : " ") + column.name;
  in_.fail(fmt::format("found {} values, but {} are due ({})", found, frame_.columns.size(), names));
}

void RowParser::add(std::string_view line) {
  const std::size_t count = frame_.columns.size();
  if ((frame_.rows + 1) * count > mostNumbersInFrame)
    in_.fail(fmt::format("the frame holds more than {} numbers; split the file or leave columns out",
                         mostNumbersInFrame));
  if (separator_) {
    bool last = false;
    std::size_t c = 0;
    for (std::string_view rest = line; !last; ++c) {
      const std::string_view cell = cutCell(rest, separator_, last);
      if (c < count) addCell(c, cell);
    }
    if (c != count) wrongCount(c);
  } else {
    const char* at = line.data();
    const char* const end = at + line.size();
    for (std::size_t c = 0;; ++c) {
      while (at != end && isBlank(*at))
        ++at;
      if (at == end) {
        if (c != count) wrongCount(c);
        break;
      }
      if (c == count) wrongCount(cellsOf(line).size());
      double value = 0;
      if (const char* stop = words_[c].empty() ? readNumber(at, end, value) : nullptr) {
        frame_.columns[c].numbers.push_back(value);
        at = stop;
        continue;
      }
      const char* const from = at;
      while (at != end && !isBlank(*at))
        ++at;
      addCell(c, {from, static_cast<std::size_t>(at - from)});
    }
  }
  ++frame_.rows;
}

} // namespace sandglass
