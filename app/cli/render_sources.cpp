#include "app/cli/render_sources.h"

#include "sim/base/error.h"
#include "sim/io/import/reader_table.h"
#include "vis/picture_record.h"

#include <fmt/format.h>

#include <cmath>
#include <set>

namespace sandglass::cli {

namespace {

namespace fs = std::filesystem;

std::vector<std::string> expanded(const std::string& name) {
  if (fs::exists(name) || name.find_first_of("*?[") == std::string::npos) return {name};
  std::vector<std::string> names;
  bool foreign = true;
  for (const auto& file : filesOfPattern(name)) {
    foreign = foreign && fs::is_regular_file(file) && file.extension() != ".vtkhdf" && !vis::isPicture(file);
    names.push_back(file.string());
  }
  if (names.empty()) throw InputError(fmt::format("{}: nothing fits this pattern", name));
  return foreign ? std::vector<std::string>{name} : names;
}

RenderSource opened(const std::string& name, const ImportArguments& import) {
  RenderSource source;
  if (vis::isPicture(name)) {
    const vis::PictureRecord record = vis::readRecord(name);
    source.frames = openForCommand(vis::locateSource(record, name).string(), import);
    source.view = record.view;
    if (fs::path(name).extension() == ".png") {
      if (record.frame >= source.frames->size())
        throw InputError(fmt::format("{}: it shows frame {} of {}, which has {} frames now", name,
                                     record.frame, source.frames->name(), source.frames->size()));
      source.only = record.frame;
    }
  } else {
    source.frames = openForCommand(name, import);
  }
  fs::path given = source.frames->name();
  if (!given.has_filename()) given = given.parent_path(); // "run/"
  source.stem = given.stem().string();
  std::erase_if(source.stem, [](char c) { return c == '*' || c == '?' || c == '[' || c == ']'; });
  return source;
}

/// Runs of one name in different folders get a number behind it.
void tellApart(std::vector<RenderSource>& sources) {
  if (sources.size() == 1) {
    sources.front().stem = "frame";
    return;
  }
  std::set<std::string> taken;
  for (RenderSource& source : sources) {
    const std::string stem = source.stem;
    for (int number = 2; !taken.insert(source.stem).second; ++number)
      source.stem = fmt::format("{}-{}", stem, number);
  }
}

} // namespace

std::vector<RenderSource> openSources(const std::vector<std::string>& names, const ImportArguments& import) {
  std::vector<RenderSource> sources;
  std::vector<std::string> faults;
  for (const auto& name : names)
    try {
      for (const auto& path : expanded(name))
        sources.push_back(opened(path, import));
    } catch (const InputError& e) {
      faults.insert(faults.end(), e.sentences().begin(), e.sentences().end());
    }
  if (!faults.empty()) throw InputError(std::move(faults));
  tellApart(sources);
  return sources;
}

std::size_t nearestFrame(const FrameSource& frames, double time) {
  std::size_t best = 0;
  for (std::size_t k = 1; k < frames.size(); ++k)
    if (std::abs(frames.time(k) - time) < std::abs(frames.time(best) - time)) best = k;
  return best;
}

} // namespace sandglass::cli
