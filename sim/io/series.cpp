#include "sim/io/series.h"

#include "sim/base/error.h"
#include "sim/io/atomic_file.h"

#include <fmt/format.h>

#include <charconv>
#include <string_view>

namespace sandglass {

namespace {

std::vector<std::string_view> cells(std::string_view line) {
  std::vector<std::string_view> list;
  for (;;) {
    const auto comma = line.find(',');
    list.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return list;
    line.remove_prefix(comma + 1);
  }
}

} // namespace

SeriesWriter::SeriesWriter(const std::filesystem::path& file, std::vector<std::string> columns,
                           std::uint64_t keepBytes)
    : file_(file), columns_(std::move(columns)) {
  std::error_code fault;
  if (keepBytes > 0) {
    const auto found = std::filesystem::file_size(file, fault);
    if (fault || found < keepBytes)
      throw RunError(
          fmt::format("{}: the file is shorter than the checkpoint says ({} of {} bytes); run from the "
                      "start",
                      file.string(), fault ? 0 : found, keepBytes));
    std::filesystem::resize_file(file, keepBytes);
    bytes_ = keepBytes;
    out_.open(file, std::ios::binary | std::ios::app);
  } else {
    out_.open(file, std::ios::binary | std::ios::trunc);
    std::string header = "time,step";
    for (const auto& column : columns_)
      header += "," + column;
    write(header + "\n");
  }
}

void SeriesWriter::row(double time, std::int64_t step, const std::map<std::string, double>& values) {
  std::string line = fmt::format("{},{}", time, step);
  for (const auto& column : columns_) {
    const auto it = values.find(column);
    line += it == values.end() ? std::string(",") : fmt::format(",{}", it->second);
  }
  write(line + "\n");
}

void SeriesWriter::write(const std::string& line) {
  out_ << line << std::flush; // a run is watched while it goes on
  bytes_ += line.size();
  if (!out_)
    throw RunError(fmt::format("{}: cannot be written; check the folder and the free space", file_.string()));
}

std::uint64_t SeriesWriter::sync() {
  syncFile(file_);
  return bytes_;
}

std::map<std::string, SeriesColumn> readSeries(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InputError(fmt::format("{}: the file cannot be opened", file.string()));
  const std::string content{std::istreambuf_iterator<char>(in), {}};
  std::string_view rest(content);
  const auto line = [&](std::string_view& text) { // whole lines only
    const auto end = rest.find('\n');
    if (end == std::string_view::npos) return false;
    text = rest.substr(0, end);
    rest.remove_prefix(end + 1);
    return true;
  };
  std::string_view text;
  if (!line(text) || !text.starts_with("time,step"))
    throw InputError(fmt::format("{}:1: a series begins with the line 'time,step,...'", file.string()));
  const std::vector<std::string_view> names = cells(text);
  std::vector<SeriesColumn> columns(names.size());
  for (int number = 2; line(text); ++number) {
    const auto row = cells(text);
    if (row.size() != names.size())
      throw InputError(fmt::format("{}:{}: the line has {} cells and the header {}", file.string(), number,
                                   row.size(), names.size()));
    double time = 0;
    for (std::size_t c = 0; c < row.size(); ++c) {
      if (row[c].empty()) continue;
      double value = 0;
      const auto [end, fault] = std::from_chars(row[c].data(), row[c].data() + row[c].size(), value);
      if (fault != std::errc{} || end != row[c].data() + row[c].size())
        throw InputError(fmt::format("{}:{}: '{}' in the column '{}' is not a number", file.string(), number,
                                     row[c], names[c]));
      if (c == 0) time = value;
      columns[c].time.push_back(time);
      columns[c].value.push_back(value);
    }
  }
  std::map<std::string, SeriesColumn> series;
  for (std::size_t c = 1; c < names.size(); ++c)
    series[std::string(names[c])] = std::move(columns[c]);
  return series;
}

} // namespace sandglass
