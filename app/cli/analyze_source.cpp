#include "app/cli/analyze_source.h"

#include "analysis/grain_sizes.h"
#include "sim/base/error.h"
#include "sim/scene/scene.h"

#include <fmt/format.h>

#include <algorithm>

namespace sandglass::cli {

using namespace analysis;

namespace fs = std::filesystem;

namespace {

bool gatesClosed(const Frame& frame) {
  return std::all_of(frame.walls.begin(), frame.walls.end(), [](const FrameWall& w) { return w.active; });
}

} // namespace

Source openSource(const std::string& text, bool several, const AnalyzeOptions& options) {
  Source source;
  source.path = text;
  source.frames = openForCommand(text, options.import);
  if (source.frames->size() == 0) throw InputError(fmt::format("{}: there are no frames yet", text));
  if (const std::string scene = source.frames->sceneText(); !scene.empty())
    source.facts = factsOf(parseScene(scene, text + " (scene inside)"));
  if (!options.up.empty()) source.facts.up = directionOption("--up", options.up);
  fs::path name = source.path;
  if (!name.has_filename()) name = name.parent_path(); // "run/"
  if (several) {
    source.prefix = name.stem().string() + "_";
    std::erase_if(source.prefix, [](char c) { return c == '*' || c == '?' || c == '[' || c == ']'; });
  }
  return source;
}

/// Gates open once, so closed frames come first.
std::size_t settledFrame(const Source& source) {
  std::size_t closed = 0, beyond = source.frames->size();
  while (closed + 1 < beyond) {
    const std::size_t middle = (closed + beyond) / 2;
    (gatesClosed(*source.frames->load(middle)) ? closed : beyond) = middle;
  }
  return closed;
}

std::pair<std::size_t, std::size_t> framesFor(const Source& source, const AnalyzeOptions& options) {
  if (!options.frames.empty()) return frameRange(options.frames, source.frames->size(), source.path.string());
  const std::size_t settled = settledFrame(source);
  return {settled, settled};
}

RegionOptions limitsFor(const Source& source, const AnalyzeOptions& options, double diameter) {
  RegionOptions region;
  region.up = source.facts.up;
  region.gates = source.facts.gates;
  if (!options.margin.empty()) region.surfaceMargin = lengthOption("--margin", options.margin, diameter);
  addLimits(options.limits, region);
  return region;
}

double diameterFor(const AnalyzeOptions& options, const Frame& frame) {
  return options.diameter.empty() ? meanDiameter(frame) : lengthOption("--diameter", options.diameter, 0);
}

} // namespace sandglass::cli
