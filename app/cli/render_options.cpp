#include "app/cli/render_options.h"

#include "sim/base/error.h"
#include "sim/scene/units.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>

namespace sandglass::cli {

namespace {

template <class Number> std::optional<Number> parsed(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// "A:B" with either side empty.
template <class Number> struct Pair { std::optional<Number> first, second; };
template <class Number> std::optional<Pair<Number>> parsedPair(const std::string& text, char separator) {
  const auto at = text.find(separator);
  if (at == std::string::npos) return std::nullopt;
  const std::string a = text.substr(0, at), b = text.substr(at + 1);
  const Pair<Number> pair{parsed<Number>(a), parsed<Number>(b)};
  if ((!a.empty() && !pair.first) || (!b.empty() && !pair.second)) return std::nullopt;
  return pair;
}

vis::ClipPlane clipOf(const std::string& text) {
  const bool good = text.size() > 2 && text[0] >= 'x' && text[0] <= 'z' && (text[1] == '<' || text[1] == '>');
  double place = std::numeric_limits<double>::quiet_NaN();
  if (good) {
    const std::string length = text.substr(2);
    if (const auto metres = parsed<double>(length))
      place = *metres;
    else
      try {
        place = parseQuantity(length, "m");
      } catch (const InputError&) { // not a length: the sentence below
      }
  }
  if (!std::isfinite(place))
    throw InputError(
        fmt::format("--clip {}: this is no clip plane; write the side to keep as axis, < or >, and a "
                    "length, such as y<0 or \"x>1 cm\"",
                    text));
  vis::ClipPlane plane;
  plane.normal = Vec3::Unit(text[0] - 'x') * (text[1] == '>' ? 1 : -1);
  plane.point = Vec3::Unit(text[0] - 'x') * place;
  return plane;
}

void setRange(vis::Colouring& colouring, const std::string& text) {
  if (text == "frame")
    colouring.range = vis::ColourRange::frame;
  else if (text == "run")
    colouring.range = vis::ColourRange::run;
  else {
    const auto pair = parsedPair<double>(text, ':');
    if (!pair || !pair->first || !pair->second || !(*pair->second > *pair->first))
      throw InputError(fmt::format("--range {}: write frame, run, or LOW:HIGH with LOW below HIGH", text));
    colouring.range = vis::ColourRange::fixed;
    colouring.low = *pair->first;
    colouring.high = *pair->second;
  }
}

struct Size {
  int width, height;
};

Size sizeOf(const std::string& text) {
  if (text == "720p") return {1280, 720};
  if (text == "1080p") return {1920, 1080};
  if (text == "4k") return {3840, 2160};
  const auto pair = parsedPair<int>(text, 'x');
  if (!pair || !pair->first || !pair->second)
    throw InputError(
        fmt::format("--size {}: write WIDTHxHEIGHT in pixels, such as 1280x720, or 720p, 1080p, 4k", text));
  return {*pair->first, *pair->second};
}

} // namespace

vis::View viewOf(const RenderOptions& options, const vis::View& base) {
  vis::View view = options.viewFile.empty() ? base : vis::readView(options.viewFile);
  std::vector<std::string> faults;
  const auto attempt = [&](auto apply) {
    try {
      apply();
    } catch (const InputError& e) {
      faults.insert(faults.end(), e.sentences().begin(), e.sentences().end());
    }
  };
  if (!options.camera.empty()) view.camera.preset = options.camera;
  if (options.orthographic) view.camera.orthographic = true;
  if (!options.colour.empty()) view.colouring.quantity = options.colour == "none" ? "" : options.colour;
  if (!options.map.empty()) view.colouring.map = options.map;
  if (options.transparent) view.transparentBackground = true;
  if (!options.range.empty()) attempt([&] { setRange(view.colouring, options.range); });
  if (!options.size.empty())
    attempt([&] {
      const auto [width, height] = sizeOf(options.size);
      view.width = width;
      view.height = height;
    });
  if (options.supersample > 0) view.supersampling = options.supersample;
  if (!options.select.empty()) view.selection = {options.select, vis::Selection::Use::only, {}};
  if (!options.arrows.empty()) view.arrows.vector = options.arrows;
  if (options.forceChains) {
    view.forceChains.shown = true;
    constexpr double small = 0.25; // grains that let the chains be seen
    if (options.viewFile.empty()) view.grainScale = small;
  }
  if (!options.field.empty() || !options.slice.empty()) view.slice.shown = true;
  if (!options.slice.empty()) view.slice.quantity = options.slice;
  if (!options.tracks.empty()) view.tracks = {options.tracks, options.trackDuration};
  for (const auto& clip : options.clips)
    attempt([&] { view.clips.push_back(clipOf(clip)); });
  // The same checks as for a file: size, preset, map.
  attempt([&] { vis::parseView(vis::writeView(view), "the options of render"); });
  if (!faults.empty()) throw InputError(std::move(faults));
  return view;
}

std::vector<std::size_t> chosenFrames(const RenderOptions& options, const std::vector<double>& times,
                                      const std::string& source) {
  std::vector<std::size_t> chosen;
  if (times.empty())
    throw InputError(fmt::format("{}: there are no frames in it; let the run write one first", source));
  if (options.at) {
    std::size_t best = 0;
    for (std::size_t k = 1; k < times.size(); ++k)
      if (std::abs(times[k] - *options.at) < std::abs(times[best] - *options.at)) best = k;
    return {best};
  }
  std::size_t first = 0, last = times.size() - 1;
  if (!options.frames.empty()) {
    const auto pair = parsedPair<std::size_t>(options.frames, ':');
    const auto single = parsed<std::size_t>(options.frames);
    if (!pair && !single)
      throw InputError(fmt::format("--frames {}: write A:B (both drawn, either may be left out) or one index",
                                   options.frames));
    first = pair ? pair->first.value_or(0) : *single;
    last = pair ? pair->second.value_or(last) : *single;
    if (first > last || first >= times.size())
      throw InputError(
          fmt::format("--frames {}: {} has the frames 0 to {}", options.frames, source, times.size() - 1));
  }
  for (std::size_t k = first; k <= last && k < times.size(); k += static_cast<std::size_t>(options.every))
    chosen.push_back(k);
  return chosen;
}

vis::GlBackend backendOf(const std::string& name) {
  if (name == "osmesa") return vis::GlBackend::osmesa;
  if (name == "egl") return vis::GlBackend::egl;
  return vis::GlBackend::automatic;
}

} // namespace sandglass::cli
