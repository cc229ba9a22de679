// <VTKFile type="Collection"><Collection>
//   <DataSet timestep="0.1" group="" part="0" file="run/0001.vtp"/> ...
// (https://www.paraview.org/Wiki/ParaView/Data_formats#PVD_File_Format). Paths count from the collection's
// folder.

#include "sim/io/import/pvd.h"

#include "sim/base/error.h"
#include "sim/io/import/reader_table.h"
#include "sim/io/import/row_parser.h"

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace sandglass {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t mostBytes = std::size_t{64} << 20;

/// How deep the elements of a text are nested: the parser calls itself for each level.
std::size_t nesting(std::string_view text) {
  std::size_t depth = 0, deepest = 0;
  const auto past = [&](std::string_view end, std::size_t from) {
    const std::size_t at = text.find(end, from);
    return at == std::string_view::npos ? text.size() : at + end.size();
  };
  for (std::size_t at = text.find('<'); at < text.size(); at = text.find('<', at)) {
    const std::string_view rest = text.substr(at);
    if (rest.starts_with("<!--") || rest.starts_with("<![CDATA[") || rest.starts_with("<?")) {
      at = past(rest[1] == '?' ? "?>" : rest[2] == '-' ? "-->" : "]]>", at);
      continue;
    }
    const bool closing = rest.starts_with("</");
    char quote = 0, before = 0;
    for (++at; at < text.size() && (quote || text[at] != '>'); ++at) {
      if (quote ? text[at] == quote : text[at] == '"' || text[at] == '\'') quote = quote ? 0 : text[at];
      before = text[at];
    }
    if (closing && depth > 0) --depth;
    if (!closing && before != '/') deepest = std::max(deepest, ++depth);
  }
  return deepest;
}

class Pvd final : public FrameFormat {
public:
  Pvd(const ImportFile& file, const ImportSettings& settings) : name_(file.name()), settings_(settings) {
    folder_ = file.path().parent_path();
    std::string text = file.head(mostBytes + 1);
    if (text.size() > mostBytes)
      throw InputError(fmt::format("{}: byte {}: a larger collection is not read", name_, mostBytes));
    constexpr std::size_t deepest = 50;
    if (nesting(text) > deepest)
      throw InputError(fmt::format(
          "{}: byte 0: its elements are nested deeper than {}; this is no collection", name_, deepest));
    boost::property_tree::ptree tree;
    try {
      std::istringstream in(text);
      boost::property_tree::read_xml(in, tree);
    } catch (const boost::property_tree::xml_parser_error& e) {
      throw InputError(
          fmt::format("{}:{}: the collection is no XML that can be read: {}", name_, e.line(), e.message()));
    }
    const auto list = tree.get_child_optional("VTKFile.Collection");
    if (!list) throw InputError(fmt::format("{}: byte 0: there is no <Collection> in it", name_));
    for (const auto& [tag, entry] : *list)
      if (tag == "DataSet") add(entry, ++entries_);
  }

  std::optional<FrameMark> next() override {
    if (at_ == files_.end()) return std::nullopt;
    FrameMark mark;
    mark.offset = mark.index = frames_++;
    mark.time = at_->first;
    for (const auto& part : at_->second)
      if (!fs::is_regular_file(part.path))
        failAt(part.entry, fmt::format("there is no file '{}'", part.path.string()));
    times_.push_back(at_->first);
    ++at_;
    return mark;
  }

  RawFrame read(const FrameMark& mark) override {
    RawFrame all;
    bool first = true;
    for (const auto& [path, entry] : files_.at(times_.at(mark.index))) {
      RawFrame part = readFile(path);
      if (first)
        all = std::move(part);
      else
        append(all, std::move(part), entry);
      first = false;
    }
    all.firstLine = 0; // messages name the collection
    return all;
  }

private:
  struct Part {
    fs::path path;
    std::size_t entry; // number in the collection, from 1
  };

  [[noreturn]] void failAt(std::size_t entry, const std::string& sentence) const {
    throw InputError(fmt::format("{}: entry {}: {}", name_, entry, sentence));
  }

  void add(const boost::property_tree::ptree& entry, std::size_t number) {
    const auto text = [&](const char* key) {
      return entry.get<std::string>(std::string("<xmlattr>.") + key, "");
    };
    const std::string file = text("file"), time = text("timestep");
    const auto value = numberIn(time);
    if (!time.empty() && (!value || !std::isfinite(*value)))
      failAt(number, fmt::format("found timestep={}, but a number is due", shownText(time)));
    if (file.empty()) failAt(number, "it names no file");
    const fs::path path = folder_ / file;
    if (path.extension() == ".pvd")
      failAt(number, fmt::format("it names another collection, {}; open that one", shownText(file)));
    files_[value.value_or(0)].push_back({path, number});
    at_ = files_.begin();
  }

  RawFrame readFile(const fs::path& path) const {
    const ImportFile file(path);
    const auto format = readerFor(file).open(file, settings_);
    const auto mark = format->next();
    if (!mark) throw InputError(fmt::format("{}: there are no frames in it", path.string()));
    return format->read(*mark);
  }

  /// Columns that both parts have.
  void append(RawFrame& all, RawFrame part, std::size_t entry) const {
    if (all.rows + part.rows > mostNumbersInFrame / std::max<std::size_t>(1, all.columns.size()))
      failAt(entry, "the parts of its time hold too many grains");
    std::erase_if(all.columns, [&](RawColumn& column) {
      for (auto& other : part.columns)
        if (other.name == column.name && other.words.empty() && column.words.empty()) {
          column.numbers.insert(column.numbers.end(), other.numbers.begin(), other.numbers.end());
          return false;
        }
      return true;
    });
    all.rows += part.rows;
  }

  std::string name_;
  fs::path folder_;
  ImportSettings settings_;
  std::map<double, std::vector<Part>> files_; ///< by time
  std::map<double, std::vector<Part>>::const_iterator at_ = files_.end();
  std::vector<double> times_;
  std::uint64_t frames_ = 0;
  std::size_t entries_ = 0;
};

} // namespace

ReaderKind pvd() {
  return {"ParaView collection (PVD)", "'<VTKFile type=\"Collection\"' (.pvd)",
          [](std::string_view head) {
            const std::size_t at = head.find("<VTKFile");
            constexpr std::size_t most = 1024, none = std::string_view::npos;
            if (at >= most) return false;
            const std::string_view element = head.substr(at, head.find('>', at) - at);
            return element.find("Collection") != none && element.find("PartitionedDataSet") == none;
          },
          [](const ImportFile& file, const ImportSettings& settings) -> std::unique_ptr<FrameFormat> {
            return std::make_unique<Pvd>(file, settings);
          }};
}

} // namespace sandglass
