#include "app/cli/analyze_options.h"

#include "sim/base/error.h"
#include "sim/scene/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace sandglass::cli {

namespace {

template <class Number> bool parse(std::string_view text, Number& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

double metres(const std::string& option, const std::string& text) {
  double value = 0;
  if (parse(text, value)) return value;
  try {
    return parseQuantity(text, "m");
  } catch (const InputError&) {
    throw InputError(
        fmt::format("{} is '{}', but must be a length such as \"12 mm\" or 0.012 (metres)", option, text));
  }
}

/// In diameters or in metres.
double place(const std::string& option, const std::string& text, double diameter) {
  double value = 0;
  const bool inDiameters = text.size() > 1 && text.back() == 'd' &&
                           parse(std::string_view(text).substr(0, text.size() - 1), value);
  return inDiameters ? value * diameter : metres(option, text);
}

} // namespace

std::vector<double> placesOption(const std::string& option, const std::string& text, double diameter) {
  std::vector<double> places;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t comma = std::min(text.find(',', from), text.size());
    const std::size_t start = std::min(text.find_first_not_of(' ', from), comma);
    places.push_back(place(option, text.substr(start, comma - start), diameter));
    from = comma + 1;
  }
  return places;
}

double lengthOption(const std::string& option, const std::string& text, double diameter) {
  const double value = place(option, text, diameter);
  if (!(value > 0)) throw InputError(fmt::format("{} is '{}', but must be above 0", option, text));
  return value;
}

void addLimits(const std::vector<std::string>& limits, analysis::RegionOptions& region) {
  for (const auto& limit : limits) {
    if (limit.size() < 3 || limit[0] < 'x' || limit[0] > 'z' || (limit[1] != '<' && limit[1] != '>'))
      throw InputError(fmt::format("--limit is '{}', but must read like x<0.01 or y>\"1 cm\"", limit));
    const double value = metres("--limit " + limit.substr(0, 2), limit.substr(2));
    double& bound = limit[1] == '<' ? region.upper[limit[0] - 'x'] : region.lower[limit[0] - 'x'];
    bound = limit[1] == '<' ? std::min(bound, value) : std::max(bound, value);
  }
}

Vec3 directionOption(const std::string& option, const std::string& text) {
  Vec3 direction = Vec3::Zero();
  std::size_t from = 0;
  bool good = true;
  for (int k = 0; k < 3 && good; ++k) {
    const std::size_t comma = k < 2 ? text.find(',', from) : text.size();
    good =
        comma != std::string::npos && parse(std::string_view(text).substr(from, comma - from), direction[k]);
    from = comma + 1;
  }
  if (!good || !(direction.norm() > 0) || !direction.allFinite())
    throw InputError(fmt::format("{} is '{}', but must be three numbers with commas between, such as 0,0,1",
                                 option, text));
  return direction.normalized();
}

std::pair<std::size_t, std::size_t> frameRange(const std::string& text, std::size_t count,
                                               const std::string& source) {
  const auto colon = text.find(':');
  const std::string first = text.substr(0, colon),
                    last = colon == std::string::npos ? first : text.substr(colon + 1);
  std::size_t a = 0, b = count - 1;
  if ((!first.empty() && !parse(first, a)) || (!last.empty() && !parse(last, b)))
    throw InputError(
        fmt::format("--frames is '{}', but must be two indices such as 10:20, 10:, :20, or one", text));
  b = std::min(b, count - 1);
  if (a > b)
    throw InputError(fmt::format("--frames {} leaves none of the {} frames of {}: indices begin with 0", text,
                                 count, source));
  return {a, b};
}

std::pair<double, double> shareRange(const std::string& text) {
  const auto colon = text.find(':');
  double a = 0, b = 0;
  if (colon == std::string::npos || !parse(std::string_view(text).substr(0, colon), a) ||
      !parse(std::string_view(text).substr(colon + 1), b) || !(a >= 0 && a < b && b <= 1))
    throw InputError(
        fmt::format("--range is '{}', but must be two ascending shares of the mass such as 0.1:0.5", text));
  return {a, b};
}

} // namespace sandglass::cli
