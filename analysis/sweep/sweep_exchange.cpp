// What leaves the table of a sweep as text, and what it takes over from another.

#include "analysis/csv_cell.h"
#include "analysis/sweep/sweep_table.h"
#include "sim/base/error.h"

#include <fmt/format.h>

#include <cmath>

namespace sandglass::analysis {

double SweepRow::number(std::size_t column) const {
  const auto* x = std::get_if<double>(&values.at(column));
  return x ? *x : std::nan("");
}

std::string SweepRow::text(std::size_t column) const {
  const SweepValue& v = values.at(column);
  if (const auto* text = std::get_if<std::string>(&v)) return *text;
  return std::holds_alternative<double>(v) ? fmt::format("{}", std::get<double>(v)) : "";
}

std::size_t SweepTable::merge(const SweepTable& other) {
  if (other.info("sweep") != info("sweep") || other.info("scene") != info("scene"))
    throw InputError(
        fmt::format("{}: this table is of another sweep than {}", other.file().string(), file().string()));
  std::size_t taken = 0;
  const auto theirs = other.rows();
  const auto ours = rows();
  for (const auto& row : theirs) {
    const auto index = static_cast<std::size_t>(row.run) - 1;
    if (row.status == SweepStatus::waiting || index >= ours.size() ||
        ours[index].status != SweepStatus::waiting)
      continue;
    SweepOutcome outcome;
    outcome.status = row.status;
    outcome.fault = row.fault;
    for (std::size_t c = 0; c < other.columns().size(); ++c)
      if (other.columns()[c].role == SweepRole::result)
        outcome.results.emplace_back(other.columns()[c], row.values[c]);
    outcome.curves = other.curves(row.run);
    outcome.last = other.lastFrame(row.run);
    outcome.seconds = other.seconds(row.run);
    record(row.run, outcome);
    ++taken;
  }
  return taken;
}

std::string SweepTable::csv(bool withBlobs) const {
  std::string text = "run,point,replicate,level,seed,status,fault";
  for (const auto& column : columns())
    text +=
        "," + csvCell(column.unit.empty() ? column.name : fmt::format("{} [{}]", column.name, column.unit));
  text += withBlobs ? ",blobs\n" : "\n";
  for (const auto& row : rows()) {
    text += fmt::format("{},{},{},{},{},{},{}", row.run, row.point, row.replicate, row.level, row.seed,
                        nameOf(row.status), csvCell(row.fault));
    for (std::size_t k = 0; k < row.values.size(); ++k)
      text += "," + csvCell(row.text(k));
    if (withBlobs) {
      text += fmt::format(",{:016x}", blobHash(row.run));
    }
    text += '\n';
  }
  return text;
}

} // namespace sandglass::analysis
