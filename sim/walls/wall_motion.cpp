#include "sim/walls/wall_motion.h"

#include "sim/base/error.h"
#include "sim/math/turns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sandglass {

namespace {

constexpr double turn = 2.0 * std::numbers::pi;

WallPose shifted(const Vec3& by) {
  WallPose pose;
  pose.translation = by;
  return pose;
}

class Translation final : public WallMotion {
public:
  Translation(MotionClock clock, const Vec3& velocity) : WallMotion(std::move(clock)), velocity_(velocity) {}
  WallPose pose(double elapsed) const override { return shifted(elapsed * velocity_); }
  WallVelocity velocity(double elapsed, const Vec3& reference) const override {
    return {reference + elapsed * velocity_, velocity_, Vec3::Zero()};
  }
  double topSpeed(double) const override { return velocity_.norm(); }

private:
  Vec3 velocity_;
};

/// From where the scene puts it to `by` further, starting and ending without a jerk: 3 u^2 - 2 u^3 of the way
/// after a share u of the duration.
class Slide final : public WallMotion {
public:
  Slide(MotionClock clock, const Vec3& by)
      : WallMotion(std::move(clock)), by_(by), duration_(this->clock().duration) {}
  WallPose pose(double elapsed) const override { return shifted(way(elapsed) * by_); }
  WallVelocity velocity(double elapsed, const Vec3& reference) const override {
    const double u = elapsed / duration_;
    return {reference + way(elapsed) * by_, 6.0 * u * (1.0 - u) / duration_ * by_, Vec3::Zero()};
  }
  double topSpeed(double) const override { return 1.5 / duration_ * by_.norm(); }

private:
  double way(double elapsed) const {
    const double u = elapsed / duration_;
    return u >= 1.0 ? 1.0 : u * u * (3.0 - 2.0 * u);
  }
  Vec3 by_;
  double duration_;
};

class Oscillation final : public WallMotion {
public:
  Oscillation(MotionClock clock, const Vec3& amplitude, double frequency, double phase)
      : WallMotion(std::move(clock)), amplitude_(amplitude), frequency_(frequency), phase_(phase / turn) {}
  WallPose pose(double elapsed) const override { return shifted(at(elapsed).sine * amplitude_); }
  WallVelocity velocity(double elapsed, const Vec3& reference) const override {
    const SineCosine now = at(elapsed);
    return {reference + now.sine * amplitude_, turn * frequency_ * now.cosine * amplitude_, Vec3::Zero()};
  }
  double topSpeed(double) const override { return turn * frequency_ * amplitude_.norm(); }

private:
  SineCosine at(double elapsed) const { return sineCosineOfTurns(frequency_ * elapsed + phase_); }
  Vec3 amplitude_;
  double frequency_, phase_; ///< [1/s], [turns]
};

class Rotation final : public WallMotion {
public:
  Rotation(MotionClock clock, const Vec3& point, const Vec3& axis, double angularVelocity)
      : WallMotion(std::move(clock)), point_(point), axis_(axis.normalized()), rate_(angularVelocity) {}
  WallPose pose(double elapsed) const override {
    const auto [s, c] = sineCosineOfTurns(rate_ / turn * elapsed);
    // Rodrigues: R = c 1 + s [a]x + (1 - c) a a^T
    WallPose pose;
    pose.turned = true;
    const Vec3& a = axis_;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        pose.rotation(i, j) = (1.0 - c) * a[i] * a[j] + (i == j ? c : 0.0);
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      pose.rotation(k, j) += s * a[i];
      pose.rotation(j, k) -= s * a[i];
    }
    pose.translation = point_ - pose.rotation * point_;
    return pose;
  }
  WallVelocity velocity(double, const Vec3&) const override { return {point_, Vec3::Zero(), rate_ * axis_}; }
  bool ownReference(Vec3& reference) const override {
    reference = point_;
    return true;
  }
  double topSpeed(double radius) const override { return std::abs(rate_) * radius; }

private:
  Vec3 point_, axis_;
  double rate_; ///< [rad/s]
};

MotionClock clockOf(const Parameters& p) {
  MotionClock clock;
  if (p.has("stage")) clock.stage = p.text("stage");
  if (p.has("until_stage")) clock.untilStage = p.text("until_stage");
  clock.start = p.number("start");
  if (p.has("duration")) clock.duration = p.number("duration");
  return clock;
}

ParameterSpec vector(const char* name, const char* unit, const char* description) {
  return {.name = name, .type = ParameterType::vector, .unit = unit, .description = description};
}

MotionKind kind(const char* name, const char* description, std::vector<ParameterSpec> parameters,
                std::function<std::shared_ptr<const WallMotion>(const Parameters&)> make,
                bool durationDue = false) {
  using enum ParameterType;
  parameters.push_back({.name = "stage",
                        .type = text,
                        .unit = "1",
                        .description = "the wall's clock starts as this stage begins (with the run)",
                        .optional = true});
  parameters.push_back({.name = "start",
                        .type = number,
                        .unit = "s",
                        .description = "the wall stands still before this time on its clock",
                        .fallback = 0.0,
                        .minimum = 0});
  parameters.push_back(
      {.name = "duration",
       .type = number,
       .unit = "s",
       .description = durationDue ? "that the way takes" : "the wall stands still after moving this long",
       .optional = !durationDue,
       .minimum = 0,
       .openMinimum = true});
  parameters.push_back({.name = "until_stage",
                        .type = text,
                        .unit = "1",
                        .description = "the wall stops for good as this stage begins",
                        .optional = true});
  return {name, description, std::move(parameters), std::move(make)};
}

} // namespace

/// Time on the clock at pace 1 and without an end by itself.
double WallMotion::passed(double time, const MotionMarks& marks) const {
  const double began = clock_.stage.empty() ? 0.0 : marks.began;
  if (!(time > began)) return 0.0;
  return std::max(std::min(time, marks.ended) - began - clock_.start, 0.0);
}

double WallMotion::elapsed(double time, const MotionMarks& marks) const {
  // At pace 1 from the beginning this is passed(), to the bit.
  const double way = marks.pace * (passed(time, marks) - passed(marks.changed, marks));
  return std::clamp(marks.shown + way, 0.0, clock_.duration);
}

void WallMotion::setPace(MotionMarks& marks, double pace, double time) const {
  marks.shown = elapsed(time, marks);
  marks.changed = time;
  marks.pace = pace;
}

bool WallMotion::running(double time, const MotionMarks& marks) const {
  const double began = clock_.stage.empty() ? 0.0 : marks.began;
  if (!(time >= began) || time >= marks.ended || marks.pace == 0.0) return false;
  return time - began - clock_.start >= 0.0 && elapsed(time, marks) < clock_.duration;
}

const std::vector<MotionKind>& motionKinds() {
  static const std::vector<MotionKind> kinds{
      kind("translate", "moves straight on",
           {{.name = "velocity",
             .type = ParameterType::vector,
             .unit = "m/s",
             .description = "constant",
             .minimum = -1e6,
             .maximum = 1e6}},
           [](const Parameters& p) {
             return std::make_shared<Translation>(clockOf(p), p.vector("velocity"));
           }),
      kind("rotate", "turns about an axis",
           {vector("point", "m", "any point of the axis; torque is reported about it"),
            vector("axis", "1", "direction of the axis"),
            {.name = "angular_velocity",
             .type = ParameterType::number,
             .unit = "rad/s",
             .description = "constant, right-handed about the axis",
             .minimum = -1e6,
             .maximum = 1e6}},
           [](const Parameters& p) {
             if (p.vector("axis").norm() == 0.0) throw InputError("the axis must not be zero");
             return std::make_shared<Rotation>(clockOf(p), p.vector("point"), p.vector("axis"),
                                               p.number("angular_velocity"));
           }),
      kind("oscillate", "moves to and fro about where the scene puts it, as a sine of time",
           {vector("amplitude", "m", "largest displacement"),
            {.name = "frequency",
             .type = ParameterType::number,
             .unit = "1/s",
             .description = "oscillations per time",
             .minimum = 0,
             .maximum = 1e6,
             .openMinimum = true},
            {.name = "phase",
             .type = ParameterType::number,
             .unit = "rad",
             .description = "of the sine at the start",
             .fallback = 0.0}},
           [](const Parameters& p) {
             return std::make_shared<Oscillation>(clockOf(p), p.vector("amplitude"), p.number("frequency"),
                                                  p.number("phase"));
           }),
      kind(
          "slide", "a gate: slides to another place, smoothly, and stays there",
          {vector("by", "m", "from where the scene puts it to where it ends")},
          [](const Parameters& p) { return std::make_shared<Slide>(clockOf(p), p.vector("by")); }, true),
  };
  return kinds;
}

std::shared_ptr<const WallMotion> makeMotion(const std::string& name, const Parameters& parameters) {
  if (name.empty()) return nullptr;
  for (const MotionKind& kind : motionKinds())
    if (kind.name == name) return kind.make(parameters);
  throw InputError(fmt::format("there is no motion '{}'", name));
}

} // namespace sandglass
