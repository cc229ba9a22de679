#include "sim/io/import/foreign_facts.h"

#include "sim/base/error.h"
#include "sim/io/import/column_set.h"
#include "sim/io/import/reader_table.h"
#include "sim/io/import/vtkhdf.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sandglass {

namespace fs = std::filesystem;

namespace {

ForeignColumn factsOf(const RawColumn& column, std::string quantity) {
  ForeignColumn facts{column.name, std::move(quantity), 0, 0, 0, {}};
  if (!column.words.empty()) {
    constexpr std::size_t most = 8;
    facts.words.assign(column.words.begin(), column.words.begin() + static_cast<std::ptrdiff_t>(
                                                                        std::min(most, column.words.size())));
    return facts;
  }
  double smallest = std::numeric_limits<double>::infinity(), largest = -smallest;
  for (const double value : column.numbers) {
    if (!std::isfinite(value)) {
      ++facts.notFinite;
      continue;
    }
    smallest = std::min(smallest, value);
    largest = std::max(largest, value);
  }
  if (smallest <= largest) {
    facts.smallest = smallest;
    facts.largest = largest;
  }
  return facts;
}

} // namespace

bool isForeign(const fs::path& path) {
  return !filesOfPattern(path.string()).empty() || (fs::is_regular_file(path) && !isOwnSegment(path));
}

ForeignFacts foreignFacts(const fs::path& path, const ImportSettings* settings) {
  const auto files = filesOfPattern(path.string());
  const fs::path chosen = files.empty() ? path : files.front();
  if (!fs::exists(chosen)) throw InputError(fmt::format("{}: there is no such file", path.string()));
  if (!isForeign(chosen))
    throw InputError(
        fmt::format("{}: this is a run of Sandglass, whose columns need no mapping", path.string()));
  const ImportSettings used = settings ? *settings : settingsBeside(chosen);
  const ImportFile file(chosen);
  const ReaderKind& kind = readerFor(file);
  const auto format = kind.open(file, used);
  auto mark = format->next();
  if (!mark) throw InputError(fmt::format("{}: there are no frames in it", chosen.string()));
  RawFrame raw = format->read(*mark);
  // Runs that pour their grains in begin with empty frames.
  constexpr std::uint64_t mostFrames = 1000;
  for (auto next = raw.rows == 0 ? format->next() : std::nullopt; next && next->index < mostFrames;
       next = format->next()) {
    mark = next;
    raw = format->read(*mark);
    if (raw.rows > 0) break;
  }
  ForeignFacts facts;
  facts.file = chosen.string();
  facts.format = kind.name;
  facts.frame = mark->index;
  facts.grains = raw.rows;
  facts.time = mark->time;
  facts.step = mark->step;
  facts.box = raw.box;
  facts.tilted = !raw.tilt.isZero(0);
  facts.remarks = raw.remarks;
  const auto quantities = quantitiesOf(raw, used);
  for (std::size_t k = 0; k < quantities.size(); ++k)
    facts.columns.push_back(factsOf(raw.columns[k], quantities[k]));
  return facts;
}

} // namespace sandglass
