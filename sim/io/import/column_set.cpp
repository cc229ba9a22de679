#include "sim/io/import/column_set.h"

#include "sim/base/error.h"
#include "sim/io/import/column_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace sandglass {

void FramePlace::fail(const std::string& sentence) const {
  throw InputError(fmt::format("{}: frame {}: {}", file, index, sentence));
}

void FramePlace::failAt(std::size_t row, const std::string& sentence) const {
  if (firstLine > 0) throw InputError(fmt::format("{}:{}: {}", file, firstLine + row, sentence));
  fail(fmt::format("row {}: {}", row + 1, sentence));
}

std::vector<std::string> quantitiesOf(const RawFrame& raw, const ImportSettings& settings) {
  std::vector<std::string> quantities;
  std::set<std::string> given;
  for (const auto& column : raw.columns) {
    std::string quantity = quantityOfColumn(column.name, settings);
    if (column.numbers.size() != raw.rows) quantity.clear();
    if (!quantity.empty() && !given.insert(quantity).second)
      quantity = given.insert(column.name).second ? column.name : "";
    quantities.push_back(quantity);
  }
  return quantities;
}

ColumnSet::ColumnSet(const RawFrame& raw, const ImportSettings& settings, const FramePlace& place)
    : raw_(raw), place_(place) {
  const auto quantities = quantitiesOf(raw, settings);
  for (std::size_t k = 0; k < quantities.size(); ++k)
    if (!quantities[k].empty()) named_.emplace(quantities[k], &raw.columns[k]);
  for (const auto& [quantity, column] : settings.columns)
    if (!column.empty() && std::none_of(raw.columns.begin(), raw.columns.end(),
                                        [&name = column](const RawColumn& c) { return c.name == name; }))
      place.fail(fmt::format("there is no column '{}', from which '{}' is to come; there are: {}", column,
                             quantity, names()));
}

bool ColumnSet::hasTriple(const std::string& base) const {
  return has(base + ".x") && has(base + ".y") && has(base + ".z");
}

const RawColumn* ColumnSet::find(const std::string& quantity) const {
  const auto it = named_.find(quantity);
  return it == named_.end() ? nullptr : it->second;
}

const std::vector<double>* ColumnSet::take(const std::string& quantity, bool finite) {
  const RawColumn* column = find(quantity);
  if (!column) return nullptr;
  drop(quantity);
  if (!column->words.empty())
    place_.failAt(0, fmt::format("'{}' holds words, but numbers are due", column->name));
  for (std::size_t k = 0; finite && k < column->numbers.size(); ++k)
    if (!std::isfinite(column->numbers[k]))
      place_.failAt(k, fmt::format("found {} in the column '{}', but a finite number is due",
                                   column->numbers[k], column->name));
  return &column->numbers;
}

std::vector<Vec3> ColumnSet::takeTriple(const std::string& base, double unit, bool finite) {
  std::vector<Vec3> values(raw_.rows);
  for (int k = 0; k < 3; ++k) {
    const auto& numbers = *take(base + "." + "xyz"[k], finite);
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i][k] = numbers[i] * unit;
  }
  return values;
}

std::string ColumnSet::names() const {
  std::vector<std::string> list;
  for (const auto& column : raw_.columns)
    list.push_back(column.name);
  return fmt::format("{}", fmt::join(list, ", "));
}

} // namespace sandglass
