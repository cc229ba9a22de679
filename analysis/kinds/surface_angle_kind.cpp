// The slope of a free surface (Rycroft 2007): bins at x_j = (2.5 j - 1.25) d from the middle, j = 1 to 10, in
// each the highest centre with ||x| - x_j| < 1.25 d, and the slope of the line through them. x is the
// distance from a plane through the middle of the outlet, or from its axis. Positive where the surface rises
// outwards.

#include "analysis/free_surface.h"
#include "analysis/grain_sizes.h"
#include "analysis/kinds/kinds.h"
#include "analysis/kinds/knob_specs.h"
#include "analysis/statistics.h"
#include "sim/base/error.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace sandglass::analysis {

namespace {

constexpr double degrees = 180 / std::numbers::pi;

class SurfaceAngle final : public Analysis {
public:
  SurfaceAngle(const Parameters& knobs, const AnalysisContext& context) : knobs_(knobs), context_(context) {}

  void add(const Frame& frame) override {
    if (context_.diameter <= 0) context_.diameter = meanDiameter(frame);
    const UpFrame axes(*context_.facts.up);
    const Vec3 middle = context_.facts.outletCentre.value_or(0.5 * (frame.domain.lower + frame.domain.upper));
    const double bin = knobs_.number("bin") * context_.diameter;
    const auto bins = static_cast<std::size_t>(knobs_.integer("bins"));
    const bool round = knobs_.text("distance") == "axis";
    const Vec3 across = acrossOf(axes);
    constexpr double empty = -std::numeric_limits<double>::infinity();
    std::vector<double> top(bins, empty);
    for (const Vec3& x : frame.position) {
      const Vec3 d = x - middle;
      const double away = round ? (d - axes.up.dot(d) * axes.up).norm() : std::abs(d.dot(across));
      const auto b = static_cast<std::size_t>(away / bin);
      if (b < bins) top[b] = std::max(top[b], d.dot(axes.up));
    }
    Series tops{"", {}, {}, {}};
    for (std::size_t b = 0; b < bins; ++b)
      if (top[b] != empty) {
        tops.x.push_back((static_cast<double>(b) + 0.5) * bin);
        tops.y.push_back(top[b]);
      }
    constexpr std::size_t least = 3;
    if (tops.x.size() < least)
      throw InputError(
          fmt::format("at {:.6g} s only {} bins hold grains, but a slope needs {}; take narrower bins",
                      frame.time, tops.x.size(), least));
    const Line line = fitLine(tops.x, tops.y);
    times_.push_back(frame.time);
    angles_.push_back(std::atan(line.slope) * degrees);
    errors_.push_back(line.slopeError / (1 + line.slope * line.slope) * degrees);
    last_ = std::move(tops);
    line_ = {
        "line", {last_.x.front(), last_.x.back()}, {line.at(last_.x.front()), line.at(last_.x.back())}, {}};
  }

  Results results() const override {
    if (times_.empty()) throw InputError("the surface's angle needs a frame");
    const std::string definition = fmt::format(
        "highest centre in bins of {:.3g} d by the distance from {}; least-squares line; positive where "
        "the surface rises outwards",
        knobs_.number("bin"), knobs_.text("distance") == "axis" ? "the axis" : "the middle plane");
    Curve profile;
    profile.name = "surface_profile";
    profile.title = "Highest grains";
    profile.definition = definition;
    profile.x = {"distance from the middle", "m"};
    profile.y = {"height", "m"};
    profile.frames = 1;
    profile.numbers = {{"angle", angles_.back()}, {"angle_error", errors_.back()}};
    profile.series = {last_, line_};
    Results results;
    if (times_.size() > 1) {
      Curve course = profile;
      course.name = "surface_angle";
      course.title = "Angle of the surface";
      course.x = {"time", "s"};
      course.y = {"angle", "deg"};
      course.frames = times_.size();
      course.series = {{"", times_, angles_, errors_}};
      results.curves.push_back(std::move(course));
    }
    results.curves.push_back(std::move(profile));
    results.sentences.push_back(fmt::format("surface angle: {:.3g} +- {:.2g} deg at {:.4g} s", angles_.back(),
                                            errors_.back(), times_.back()));
    return results;
  }

private:
  Vec3 acrossOf(const UpFrame& axes) const {
    const std::string name = knobs_.text("across");
    if (name != "auto") {
      const Vec3 axis = Vec3::Unit(name[0] - 'x');
      const Vec3 level = axis - axes.up.dot(axis) * axes.up;
      if (!(level.norm() > 0.5)) throw InputError(fmt::format("across is '{}', which is not level", name));
      return level.normalized();
    }
    return context_.facts.slot ? context_.facts.slot->across : axes.e1;
  }

  Parameters knobs_;
  AnalysisContext context_;
  std::vector<double> times_, angles_, errors_;
  Series last_, line_;
};

} // namespace

AnalysisKind surfaceAngleKind() {
  return {.name = "surface_angle",
          .title = "Angle of the surface",
          .description = "slope of the free surface about an outlet or an axis, against time",
          .source = "Rycroft 2007",
          .needs = {.quantities = {quantity::radius}, .up = true, .grains = 10},
          .knobs = {choiceKnob("distance", "plane", {"plane", "axis"},
                               "whether bins lie beside a plane through the middle or around an axis"),
                    choiceKnob("across", "auto", {"auto", "x", "y", "z"},
                               "normal of the plane; auto: across the slot, else the first level direction"),
                    numberKnob("bin", 2.5, 0, 100, "width of the bins, in diameters", true),
                    integerKnob("bins", 10, 3, 1000, "bins from the middle outwards")},
          .make = [](const Parameters& knobs, const AnalysisContext& context) -> std::unique_ptr<Analysis> {
            return std::make_unique<SurfaceAngle>(knobs, context);
          }};
}

} // namespace sandglass::analysis
