#include "analysis/vortex/vortex_states.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sandglass::analysis {

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t never = std::numeric_limits<std::size_t>::max();

/// Which of VortexGrainThresholds::factors act: 1 is the threshold as it is.
struct GrainFactors {
  std::size_t rise = 1, riser = 1;
};

/// Sums of everything that a window asks for, so that a window anywhere costs nothing.
class Windows {
public:
  Windows(const VortexMeasures& measures, const VortexRules& rules, GrainFactors factors = {})
      : measures_(measures), rules_(rules), samples_(measures.samples()) {
    const double interval = measures.interval();
    perUnit_ = rules.sliding && interval > 0 ? 1 / interval : 1;
    const VortexTank& tank = measures.tank();
    const double r = measures.radius(), n = static_cast<double>(measures.grains());
    const double core = rules.pinnedAtWall
                            ? tank.radius - rules.pinnedCore * r
                            : std::max(rules.pinnedCore * r, rules.pinnedCoreShare * tank.radius);
    // The source's tank is 20/3 of its radius high; walls may be drawn higher to keep what flies.
    const double highest =
        tank.floor + (rules.heightLimit > 0 ? rules.heightLimit
                                            : std::min(tank.top - tank.floor, 20.0 / 3.0 * tank.radius));
    least_ = rules.spoutLeast < 1 ? rules.spoutLeast * n : rules.spoutLeast;
    small_ = rules.spoutSmall * n;
    large_ = rules.spoutLarge * n;
    const auto count = samples_.size() + 1;
    for (auto* sum : {&fluid_, &pinned_, &spout_, &smallSpout_, &risers_, &core_, &drift_, &energy_, &high_})
      sum->assign(count, 0.0);
    const double wanted = measures.bins() - 1 - rules.fluidViolations;
    for (std::size_t k = 0; k < samples_.size(); ++k) {
      const VortexSample& s = samples_[k];
      const double c = rules.sliding ? s.speedRisers[factors.riser] : s.stepRisers[factors.riser];
      const double lower = rules.spoutsApart ? small_ : least_;
      add(fluid_, k, s.rises[factors.rise] >= wanted);
      add(pinned_, k, s.core > core);
      add(smallSpout_, k, c >= least_ && c < small_);
      add(spout_, k, c >= lower && c < large_);
      add(risers_, k, c);
      add(core_, k, s.core / tank.radius);
      add(energy_, k, s.aboveFloor);
      add(high_, k, s.highest >= highest || !s.sound);
      add(drift_, k,
          k == 0 ? 0 : std::abs((s.energy - samples_[k - 1].energy) / (1 + samples_[k - 1].energy)));
      exploded_ = exploded_ || !s.sound;
    }
    findSettled();
  }

  std::size_t frames(double window) const {
    return std::max<std::size_t>(1, static_cast<std::size_t>(std::llround(window * perUnit_)));
  }
  static double mean(const std::vector<double>& sum, std::size_t from, std::size_t to) {
    return (sum[to] - sum[from]) / static_cast<double>(to - from);
  }
  bool exploded() const { return exploded_; }
  /// First frame of the first settled window, and the frame from which the bed is looked at: its middle.
  std::size_t settled() const { return settled_; }
  std::size_t begin() const { return settled_ + frames(rules_.settleWindow) / 2; }
  /// A settled bed is known as such at the end of the window.
  bool knownAt(std::size_t end) const {
    return settled_ != never && settled_ + frames(rules_.settleWindow) <= end;
  }

  /// Change of energy in the window: of a frame on the average (source), or between the halves (own).
  double drift(std::size_t from, std::size_t to) const {
    if (!rules_.sliding) return mean(drift_, from, to);
    const std::size_t middle = from + (to - from) / 2;
    const double first = mean(energy_, from, middle), second = mean(energy_, middle, to);
    return std::abs(second - first) / std::max(std::abs(first), std::abs(second));
  }

  /// The window [from, to) that a rule looks at when the run ends at `end`; false: too few frames.
  bool window(double length, std::size_t end, std::size_t& from) const {
    const std::size_t whole = frames(length);
    // The source's windows are whole. Ours may still be growing, up from one half.
    if (end < begin() + (rules_.sliding ? (whole + 1) / 2 : whole)) return false;
    from = end - std::min(whole, end - begin());
    return true;
  }

  VortexState state(std::size_t end) const {
    if (exploded_ || !knownAt(end)) return VortexState::unresolved;
    if (rules_.sliding) {
      std::size_t from;
      if (!window(std::max({rules_.fluidWindow, rules_.pinnedWindow, rules_.spoutWindow}), end, from))
        return VortexState::unresolved;
    }
    if (large(end) != never) return VortexState::largeSpout;
    if (small(end) != never) return VortexState::smallSpout;
    if (pinned(end) != never) return VortexState::pinned;
    if (fluid(end) != never) return VortexState::fluid;
    return VortexState::flat;
  }

  // Each: first frame of the window in which the rule holds, or never.
  std::size_t fluid(std::size_t end) const {
    std::size_t from;
    return window(rules_.fluidWindow, end, from) && mean(fluid_, from, end) >= rules_.fluidShare - 1e-12
               ? from
               : never;
  }
  std::size_t pinned(std::size_t end) const {
    std::size_t from;
    if (rules_.sliding)
      return window(rules_.pinnedWindow, end, from) && mean(pinned_, from, end) >= rules_.pinnedShare - 1e-12
                 ? from
                 : never;
    const double enough = rules_.pinnedShare * rules_.pinnedWindow;
    if (rules_.pinnedAddsUp) // its counter is never cleared
      return pinned_[end] - pinned_[begin()] >= enough ? begin() : never;
    return first(pinned_, rules_.pinnedWindow, enough, end);
  }
  std::size_t small(std::size_t end) const {
    if (!rules_.sliding) return first(smallSpout_, rules_.spoutWindow, rules_.spoutWindow, end);
    const std::size_t from = spouting(end);
    return from != never && mean(risers_, from, end) < small_ ? from : never;
  }
  std::size_t large(std::size_t end) const {
    if (!rules_.sliding) return first(spout_, rules_.spoutWindow, rules_.spoutWindow, end);
    const std::size_t from = spouting(end);
    return from != never && mean(risers_, from, end) >= small_ ? from : never;
  }

  double share(const std::vector<double>& sum, double length, std::size_t end) const {
    std::size_t from;
    if (!knownAt(end) || !window(length, end, from)) return unknown;
    return mean(sum, from, end);
  }
  double longest(const std::vector<double>& sum, std::size_t end) const {
    if (!knownAt(end)) return unknown;
    std::size_t run = 0, best = 0;
    for (std::size_t k = begin(); k < end; ++k) {
      run = sum[k + 1] > sum[k] ? run + 1 : 0;
      best = std::max(best, run);
    }
    return static_cast<double>(best);
  }
  const std::vector<double>& fluidSum() const { return fluid_; }
  const std::vector<double>& pinnedSum() const { return pinned_; }
  const std::vector<double>& spoutSum() const { return spout_; }
  const std::vector<double>& smallSum() const { return smallSpout_; }
  const std::vector<double>& coreSum() const { return core_; }

private:
  static void add(std::vector<double>& sum, std::size_t k, double value) { sum[k + 1] = sum[k] + value; }

  std::size_t spouting(std::size_t end) const {
    std::size_t from;
    return window(rules_.spoutWindow, end, from) && mean(spout_, from, end) >= rules_.spoutShare - 1e-12 &&
                   mean(core_, from, end) >= rules_.spoutCore
               ? from
               : never;
  }

  /// First window of the source's length with at least `enough` frames that pass, looked at from begin().
  std::size_t first(const std::vector<double>& sum, double length, double enough, std::size_t end) const {
    const std::size_t whole = frames(length);
    for (std::size_t from = begin(); from + whole <= end; ++from)
      if (sum[from + whole] - sum[from] >= enough) return from;
    return never;
  }

  void findSettled() {
    const std::size_t whole = frames(rules_.settleWindow);
    // The source begins with the second frame, the first that has a difference.
    for (std::size_t from = 1; from + whole <= samples_.size(); ++from)
      if (high_[from + whole] == high_[from] && drift(from, from + whole) <= rules_.settleDrift) {
        settled_ = from;
        return;
      }
  }

  const VortexMeasures& measures_;
  const VortexRules& rules_;
  const std::vector<VortexSample>& samples_;
  double perUnit_ = 1, least_ = 0, small_ = 0, large_ = 0;
  std::vector<double> fluid_, pinned_, spout_, smallSpout_, risers_, core_, drift_, energy_, high_;
  std::size_t settled_ = never;
  bool exploded_ = false;
};

double timeOf(const VortexMeasures& measures, std::size_t frame) {
  return frame == never || frame >= measures.samples().size() ? unknown : measures.samples()[frame].time;
}

double confidence(const VortexMeasures& measures, const VortexRules& rules, VortexState state) {
  const std::size_t end = measures.samples().size();
  double same = 0, all = 0;
  const auto judge = [&](const VortexRules& changed, GrainFactors factors) {
    same += Windows(measures, changed, factors).state(end) == state;
    all += 1;
  };
  const auto limit = [](double value) { return std::min(value, 1.0); };
  for (const double factor : {0.8, 1.2}) {
    for (const auto member : {&VortexRules::settleDrift, &VortexRules::pinnedShare, &VortexRules::pinnedCore,
                              &VortexRules::pinnedCoreShare, &VortexRules::spoutLeast,
                              &VortexRules::spoutSmall, &VortexRules::spoutLarge, &VortexRules::spoutCore,
                              &VortexRules::fluidShare, &VortexRules::spoutShare}) {
      VortexRules changed = rules;
      if (changed.*member == 0) continue;
      changed.*member *= factor;
      if (member == &VortexRules::fluidShare || member == &VortexRules::spoutShare)
        changed.*member = limit(changed.*member);
      judge(changed, {});
    }
    const std::size_t at = factor < 1 ? 0 : 2;
    judge(rules, {at, 1});
    judge(rules, {1, at});
  }
  return same / all;
}

} // namespace

VortexVerdict vortexVerdict(const VortexMeasures& measures, const VortexRules& rules) {
  VortexVerdict verdict;
  const std::size_t end = measures.samples().size();
  verdict.start = verdict.settled = unknown;
  if (end < 2) return verdict;
  const Windows w(measures, rules);
  verdict.state = w.state(end);
  verdict.settled = timeOf(measures, w.settled());
  verdict.confidence = confidence(measures, rules, verdict.state);
  const bool settled = w.knownAt(end) && !w.exploded();
  const auto since = [&](std::size_t (Windows::*rule)(std::size_t) const) {
    return settled ? (w.*rule)(end) : never;
  };
  const auto note = [&](const char* rule, std::size_t from, double found, double needed,
                        std::string measure) {
    verdict.evidence.push_back(
        {rule, from != never, found, needed, std::move(measure), timeOf(measures, from)});
  };
  const std::size_t whole = w.frames(rules.settleWindow);
  note("settled", settled ? w.settled() : never,
       settled            ? w.drift(w.settled(), w.settled() + whole)
       : whole + 1 <= end ? w.drift(end - whole, end)
                          : unknown,
       rules.settleDrift,
       rules.sliding ? "change of the mean energy from one half of the window to the other"
                     : "mean |dE| / (1 + E) of a frame");
  note("fluid", since(&Windows::fluid), w.share(w.fluidSum(), rules.fluidWindow, end), rules.fluidShare,
       "share of frames whose surface rises outwards");
  if (rules.pinnedAddsUp)
    note("pinned", since(&Windows::pinned), settled ? w.pinnedSum()[end] - w.pinnedSum()[w.begin()] : unknown,
         rules.pinnedShare * rules.pinnedWindow, "frames with an empty core since the bed settled");
  else
    note(
        "pinned", since(&Windows::pinned), w.share(w.pinnedSum(), rules.pinnedWindow, end), rules.pinnedShare,
        rules.sliding ? "share of frames with an empty core" : "share of frames with all grains at the wall");
  if (rules.sliding) {
    std::size_t from = never;
    const std::string measure = fmt::format("share of frames with {:.4g} to {:.4g} of the grains rising",
                                            rules.spoutLeast, rules.spoutLarge);
    note("small spout", since(&Windows::small), w.share(w.spoutSum(), rules.spoutWindow, end),
         rules.spoutShare, measure);
    note("large spout", since(&Windows::large), w.share(w.spoutSum(), rules.spoutWindow, end),
         rules.spoutShare, measure);
    const double core = w.share(w.coreSum(), rules.spoutWindow, end);
    note("open core", core >= rules.spoutCore && w.window(rules.spoutWindow, end, from) ? from : never, core,
         rules.spoutCore, "mean radius of the empty core of a spout, in tank radii");
  } else {
    note("small spout", since(&Windows::small), w.longest(w.smallSum(), end), rules.spoutWindow,
         "longest run of frames with as many rising grains");
    note("large spout", since(&Windows::large), w.longest(w.spoutSum(), end), rules.spoutWindow,
         "longest run of frames with as many rising grains");
  }
  switch (verdict.state) {
  case VortexState::unresolved:
    break;
  case VortexState::flat:
    verdict.start = verdict.settled;
    break;
  default:
    for (const auto& e : verdict.evidence)
      if (e.holds && e.rule == nameOf(verdict.state)) verdict.start = e.since;
  }
  if (rules.sliding && verdict.state != VortexState::unresolved) {
    std::size_t last = end; // back through the run for as long as the state was the same
    while (last > 1 && w.state(last - 1) == verdict.state)
      --last;
    std::size_t from = 0;
    if (w.window(std::max({rules.fluidWindow, rules.pinnedWindow, rules.spoutWindow}), last, from))
      verdict.start = timeOf(measures, from);
  }
  return verdict;
}

std::vector<VortexState> vortexHistory(const VortexMeasures& measures, const VortexRules& rules) {
  std::vector<VortexState> states;
  if (measures.samples().size() < 2) return states;
  const Windows w(measures, rules);
  // The source's rules look for a window from the start each time: not at every frame.
  const std::size_t every = rules.sliding ? 1 : std::max<std::size_t>(1, measures.samples().size() / 200);
  for (std::size_t end = 1; end <= measures.samples().size(); ++end)
    states.push_back(end % every == 0 || end == measures.samples().size() || states.empty() ? w.state(end)
                                                                                            : states.back());
  return states;
}

std::optional<double> bouncePeriod(const VortexMeasures& measures, std::size_t frames) {
  const auto& samples = measures.samples();
  const std::size_t n = std::min(frames, samples.size()), from = samples.size() - n;
  double mean = 0;
  for (std::size_t k = from; k < samples.size(); ++k)
    mean += samples[k].meanHeight / static_cast<double>(n);
  std::vector<double> rising, falling;
  for (std::size_t k = from + 1; k < samples.size(); ++k) {
    const double a = samples[k - 1].meanHeight - mean, b = samples[k].meanHeight - mean;
    if ((a < 0) == (b < 0)) continue;
    const double at = samples[k - 1].time + a / (a - b) * (samples[k].time - samples[k - 1].time);
    (a < 0 ? rising : falling).push_back(at);
  }
  if (rising.size() + falling.size() < 4) return std::nullopt;
  double sum = 0, count = 0;
  for (const auto* crossings : {&rising, &falling})
    if (crossings->size() > 1) {
      sum += crossings->back() - crossings->front();
      count += static_cast<double>(crossings->size() - 1);
    }
  return sum / count;
}

double coreRadius(const VortexMeasures& measures, std::size_t frames) {
  const auto& samples = measures.samples();
  const std::size_t n = std::min(frames, samples.size());
  if (n == 0) return unknown;
  std::vector<double> cores;
  for (std::size_t k = samples.size() - n; k < samples.size(); ++k)
    cores.push_back(samples[k].core);
  const auto middle = cores.begin() + static_cast<std::ptrdiff_t>(n / 2);
  std::nth_element(cores.begin(), middle, cores.end());
  return *middle;
}

double bedRotation(const VortexMeasures& measures, std::size_t frames) {
  const auto& samples = measures.samples();
  const std::size_t n = std::min(frames, samples.size());
  double sum = 0;
  for (std::size_t k = samples.size() - n; k < samples.size(); ++k)
    sum += samples[k].rotation;
  return n ? sum / static_cast<double>(n) : unknown;
}

} // namespace sandglass::analysis
