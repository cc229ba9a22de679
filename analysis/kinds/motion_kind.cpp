// How grains wander: mean squared displacement, diffusion, and the correlation of velocities in space.
//
// Displacements are summed from Frame to Frame by the nearest image, so that grains must move by less than
// half a period between them. The mean displacement of all grains is taken away (knob `drift`). D from the
// slope of the later half of the curve: <r^2> = 6 D t. Where up is known and the grains sink, the diffusion
// length b of a flow: <s^2> = 2 b h for the displacement s along each level direction, less the mean, over
// the mean fall h (Rycroft 2007). C(r) = <v_i . v_j> / <v^2> over pairs at distance r, v less the mean of all
// (Rycroft 2007).

#include "analysis/cell_grid.h"
#include "analysis/free_surface.h"
#include "analysis/grain_sizes.h"
#include "analysis/kinds/kinds.h"
#include "analysis/kinds/knob_specs.h"
#include "analysis/neighbour_list.h"
#include "analysis/shell_cutoff.h"
#include "analysis/statistics.h"
#include "sim/base/error.h"

#include <fmt/format.h>

#include <cmath>
#include <unordered_map>

namespace sandglass::analysis {

namespace {

class MotionAnalysis : public Analysis {
public:
  MotionAnalysis(const Parameters& knobs, const AnalysisContext& context)
      : knobs_(knobs), context_(context) {}

  void add(const Frame& frame) override {
    if (context_.diameter <= 0) context_.diameter = meanDiameter(frame);
    Snapshot now{frame.time, {}};
    std::unordered_map<std::int64_t, Vec3> place;
    Vec3 drift = Vec3::Zero();
    double moved = 0;
    for (std::size_t i = 0; i < frame.size(); ++i) {
      Vec3 path = Vec3::Zero();
      if (const auto it = place_.find(frame.id[i]); it != place_.end()) {
        Vec3 step = frame.position[i] - it->second;
        for (int k = 0; k < 3; ++k)
          if (frame.domain.periodic[static_cast<std::size_t>(k)]) {
            const double length = frame.domain.upper[k] - frame.domain.lower[k];
            step[k] -= length * std::round(step[k] / length);
          }
        path = frames_.back().path.at(frame.id[i]) + step;
        drift += step;
        moved += 1;
      } else if (!frames_.empty()) {
        continue; // a newcomer has no path; neither has a grain after it was away
      }
      now.path.emplace(frame.id[i], path);
      place.emplace(frame.id[i], frame.position[i]);
    }
    now.drift =
        frames_.empty() || moved == 0 ? Vec3(Vec3::Zero()) : Vec3(frames_.back().drift + drift / moved);
    if (moved > 0 && knobs_.boolean("drift"))
      for (auto& [id, path] : now.path)
        path -= drift / moved;
    place_ = std::move(place);
    frames_.push_back(std::move(now));
    if (frame.has(quantity::velocity)) correlate(frame);
  }

  Results results() const override {
    if (frames_.size() < 2) throw InputError("displacements need at least two frames");
    Results results;
    Curve msd;
    msd.name = "mean_squared_displacement";
    msd.title = "Mean squared displacement";
    msd.definition = fmt::format(
        "<r^2> over grains and starting frames, steps by the nearest image{}; D: slope of the later "
        "half over 6; error: scatter of starting frames",
        knobs_.boolean("drift") ? ", less the mean displacement of all" : "");
    msd.x = {"time", "s"};
    msd.y = {"<r^2>", "m^2"};
    msd.frames = frames_.size();
    Series series{"", {}, {}, {}};
    for (std::size_t lag = 1; lag < frames_.size(); ++lag) {
      std::vector<double> each;
      double time = 0;
      for (std::size_t s = 0; s + lag < frames_.size(); ++s) {
        double sum = 0, n = 0;
        for (const auto& [id, path] : frames_[s + lag].path)
          if (const auto it = frames_[s].path.find(id); it != frames_[s].path.end())
            sum += (path - it->second).squaredNorm(), n += 1;
        if (n == 0) continue;
        each.push_back(sum / n);
        time += frames_[s + lag].time - frames_[s].time;
      }
      if (each.empty()) continue;
      series.x.push_back(time / static_cast<double>(each.size()));
      series.y.push_back(mean(each));
      series.error.push_back(each.size() >= 4 ? blockedStandardError(each) : 0);
    }
    std::string sentence = "displacements:";
    if (series.x.size() >= 4) {
      const std::size_t half = series.x.size() / 2;
      const Line line = fitLine(std::span(series.x).subspan(half), std::span(series.y).subspan(half));
      msd.numbers["diffusion"] = line.slope / 6;
      msd.numbers["diffusion_error"] = line.slopeError / 6;
      sentence += fmt::format(" D = {:.4g} +- {:.1g} m^2/s,", line.slope / 6, line.slopeError / 6);
    }
    if (!series.x.empty()) {
      sentence += fmt::format(" {:.3g} d after {:.4g} s,", std::sqrt(series.y.back()) / context_.diameter,
                              series.x.back());
      msd.series.push_back(std::move(series));
      results.curves.push_back(std::move(msd));
    }
    if (!sum_.empty()) {
      Curve c;
      c.name = "velocity_correlation";
      c.title = "Correlation of velocities in space";
      c.definition =
          "C(r) = <v_i . v_j> / <v^2> over pairs at distance r, v less the mean of all grains of the frame";
      c.x = {"r / d", ""};
      c.y = {"C", ""};
      c.frames = frames_.size();
      Series s{"", {}, {}, {}};
      for (std::size_t b = 0; b < sum_.size(); ++b)
        if (pairs_[b] > 0) {
          s.x.push_back((static_cast<double>(b) + 0.5) * 0.25);
          s.y.push_back(sum_[b] / pairs_[b]);
        }
      c.series.push_back(std::move(s));
      results.curves.push_back(std::move(c));
    }
    addDiffusionLength(results, sentence);
    if (sentence.ends_with(',')) sentence.pop_back();
    results.sentences.push_back(sentence);
    return results;
  }

private:
  struct Snapshot {
    double time;
    std::unordered_map<std::int64_t, Vec3> path;
    Vec3 drift = Vec3::Zero(); ///< mean displacement since the first
  };

  /// Spread along the level directions against the mean fall; nothing where the grains do not sink.
  void addDiffusionLength(Results& results, std::string& sentence) const {
    if (!context_.facts.up) return;
    const UpFrame axes(*context_.facts.up);
    const double d = context_.diameter;
    Curve curve;
    curve.name = "diffusion_length";
    curve.title = "Spread of falling grains";
    curve.x = {"mean fall / d", ""};
    curve.y = {"<s^2> / d^2", ""};
    curve.frames = frames_.size();
    for (const auto& [name, axis] : {std::pair("first", axes.e1), {"second", axes.e2}}) {
      // + 0.0: no minus before a zero
      const std::string direction =
          fmt::format("{:.3g} {:.3g} {:.3g}", axis.x() + 0.0, axis.y() + 0.0, axis.z() + 0.0);
      Series series{fmt::format("{} level direction ({})", name, direction), {}, {}, {}};
      for (std::size_t f = 1; f < frames_.size(); ++f) {
        double sum = 0, squares = 0, n = 0;
        for (const auto& [id, path] : frames_[f].path)
          if (const auto it = frames_[0].path.find(id); it != frames_[0].path.end()) {
            const double s = axis.dot(path - it->second);
            sum += s, squares += s * s, n += 1;
          }
        const double fall = -axes.up.dot(frames_[f].drift);
        if (n < 2 || !(fall > 0)) continue;
        series.x.push_back(fall / d);
        series.y.push_back((squares / n - sum * sum / (n * n)) / (d * d));
      }
      constexpr double leastFall = 1; // diameters; less is rattling in the cage
      if (series.x.size() < 4 || series.x.back() < leastFall) continue;
      const std::size_t half = series.x.size() / 2;
      const Line line = fitLine(std::span(series.x).subspan(half), std::span(series.y).subspan(half));
      const std::string key = std::string("b_") + name;
      curve.numbers[key] = line.slope / 2;
      curve.numbers[key + "_error"] = line.slopeError / 2;
      sentence +=
          fmt::format(" b = {:.3g} +- {:.1g} d along ({}),", line.slope / 2, line.slopeError / 2, direction);
      curve.series.push_back(std::move(series));
    }
    if (curve.series.empty()) return;
    curve.definition =
        "variance of the displacement from the first frame over the grains, against their mean fall; "
        "b: slope of the later half over 2, in diameters";
    results.curves.push_back(std::move(curve));
  }

  void correlate(const Frame& frame) {
    const auto& v = frame.vector(quantity::velocity);
    Vec3 average = Vec3::Zero();
    for (const auto& u : v)
      average += u / static_cast<double>(v.size());
    double square = 0;
    for (const auto& u : v)
      square += (u - average).squaredNorm() / static_cast<double>(v.size());
    if (!(square > 0)) return;
    const double d = context_.diameter;
    const NeighbourList list = neighboursWithin(frame.position, frame.domain, knobs_.number("r_max") * d);
    const auto bins = static_cast<std::size_t>(std::ceil(knobs_.number("r_max") * 4));
    sum_.resize(bins);
    pairs_.resize(bins);
    for (std::size_t i = 0; i < list.size(); ++i) {
      const auto near = list.indices(i);
      const auto vectors = list.vectors(i);
      for (std::size_t k = 0; k < near.size(); ++k) {
        const auto b = static_cast<std::size_t>(vectors[k].norm() / d * 4);
        if (b >= bins) continue;
        sum_[b] += (v[i] - average).dot(v[near[k]] - average) / square;
        pairs_[b] += 1;
      }
    }
  }

  Parameters knobs_;
  AnalysisContext context_;
  std::unordered_map<std::int64_t, Vec3> place_;
  std::vector<Snapshot> frames_;
  std::vector<double> sum_, pairs_;
};

} // namespace

AnalysisKind motionKind() {
  return {.name = "motion",
          .title = "Displacements and velocity correlation",
          .description = "mean squared displacement, diffusion, diffusion length of a flow, correlation of "
                         "velocities in space",
          .source = "Rycroft 2007",
          .needs = {.quantities = {quantity::radius}, .persistentIds = true, .grains = 2, .frames = 2},
          .knobs = {switchKnob("drift", true, "whether the mean displacement is taken away"),
                    numberKnob("r_max", 5, 0, 50, "largest distance of the correlation, in diameters", true)},
          .make = [](const Parameters& knobs, const AnalysisContext& context) -> std::unique_ptr<Analysis> {
            return std::make_unique<MotionAnalysis>(knobs, context);
          }};
}

} // namespace sandglass::analysis
