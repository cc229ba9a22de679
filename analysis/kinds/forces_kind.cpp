// Fabric, force chains and how long contacts last.

#include "analysis/force_network.h"
#include "analysis/kinds/kinds.h"
#include "analysis/kinds/knob_specs.h"
#include "analysis/statistics.h"
#include "sim/base/error.h"

#include <fmt/format.h>

#include <limits>
#include <map>
#include <numbers>
#include <tuple>

namespace sandglass::analysis {

namespace {

class ForceAnalysis : public Analysis {
public:
  ForceAnalysis(const Parameters& knobs, const AnalysisContext&) : knobs_(knobs) {}

  void add(const Frame& frame) override {
    times_.push_back(frame.time);
    geometric_.push_back(anisotropy(fabric(frame, false)));
    mechanical_.push_back(anisotropy(fabric(frame, true)));
    sum_ += fabric(frame, false);
    const auto chains = forceChains(frame, knobs_.number("angle") * std::numbers::pi / 180);
    chain_.assign(frame.size(), -1);
    double inChains = 0;
    for (std::size_t c = 0; c < chains.size(); ++c) {
      lengths_[chains[c].grains.size()] += 1;
      for (const auto i : chains[c].grains)
        chain_[i] = static_cast<double>(c), inChains += 1;
    }
    share_.push_back(inChains / static_cast<double>(frame.size()));
    // A contact lasts from the first Frame that shows it to the last one in a row.
    std::map<Key, double> now;
    for (const auto& c : frame.contacts) {
      if (c.overlap < 0 || c.b < 0) continue;
      const Key key{c.a, c.b, c.image[0], c.image[1], c.image[2]};
      const auto it = since_.find(key);
      now.emplace(key, it != since_.end() ? it->second : frame.time);
    }
    if (times_.size() > 1)
      for (const auto& [key, start] : since_)
        if (!now.contains(key) && start > times_.front())
          durations_.push_back(times_[times_.size() - 2] - start);
    since_ = std::move(now);
  }

  Results results() const override {
    if (times_.empty()) throw InputError("the force network needs at least one frame");
    Results results;
    const auto n = static_cast<double>(times_.size());
    Curve curve;
    curve.name = "fabric_anisotropy";
    curve.title = "Anisotropy of the fabric";
    curve.definition =
        "sqrt(3/2) |F - I/3|, F = <n n> over contacts between grains (Satake 1982); the second weighted by "
        "normal force";
    curve.x = {"time", "s"};
    curve.y = {"anisotropy", ""};
    curve.frames = times_.size();
    curve.series = {{"contacts", times_, geometric_, {}}, {"forces", times_, mechanical_, {}}};
    Table tensor;
    tensor.name = "fabric_tensor";
    tensor.title = "Fabric tensor";
    tensor.definition = "F = <n n> over contacts between grains, mean of the frames";
    tensor.columns = {{"x", ""}, {"y", ""}, {"z", ""}};
    tensor.rowTitle = "row";
    tensor.rowNames = {"x", "y", "z"};
    for (int k = 0; k < 3; ++k)
      tensor.rows.push_back({sum_(k, 0) / n, sum_(k, 1) / n, sum_(k, 2) / n});
    Curve chains;
    chains.name = "force_chains";
    chains.title = "Force chains by length";
    chains.definition =
        fmt::format("grains of more than mean principal stress that touch along their principal directions "
                    "within {:.3g} degrees, three or more (Peters et al. 2005); chains a frame",
                    knobs_.number("angle"));
    chains.x = {"grains in the chain", ""};
    chains.y = {"chains a frame", ""};
    chains.frames = times_.size();
    chains.numbers["share_in_chains"] = mean(share_);
    Series lengths{"", {}, {}, {}};
    for (const auto& [length, count] : lengths_) {
      lengths.x.push_back(static_cast<double>(length));
      lengths.y.push_back(count / n);
    }
    results.sentences.push_back(
        fmt::format("force network: anisotropy {:.3g} (contacts) and {:.3g} (forces), {:.3g} % of the "
                    "grains in chains",
                    mean(geometric_), mean(mechanical_), 100 * mean(share_)));
    results.grains = {{"force_chain", "", chains.definition + "; -1: none", chain_}};
    if (!lengths.x.empty()) {
      chains.series.push_back(std::move(lengths));
      results.curves.push_back(std::move(chains));
    }
    results.curves.push_back(std::move(curve));
    results.tables.push_back(std::move(tensor));
    if (!durations_.empty()) {
      Table durations;
      durations.name = "contact_durations";
      durations.title = "How long contacts last";
      durations.definition =
          "contacts that began and ended within the frames, from the first to the last frame that shows "
          "them: shorter than true by up to two frame intervals, and those that last longer than the "
          "frames are left out";
      durations.columns = {{"contacts", ""}, {"mean", "s"}, {"standard deviation", "s"}};
      durations.rows = {
          {static_cast<double>(durations_.size()), mean(durations_), std::sqrt(variance(durations_))}};
      results.tables.push_back(std::move(durations));
    }
    return results;
  }

private:
  using Key = std::tuple<std::int64_t, std::int64_t, int, int, int>;
  Parameters knobs_;
  std::vector<double> times_, geometric_, mechanical_, share_, chain_, durations_;
  Eigen::Matrix3d sum_ = Eigen::Matrix3d::Zero();
  std::map<std::size_t, double> lengths_;
  std::map<Key, double> since_;
};

} // namespace

AnalysisKind forcesKind() {
  return {.name = "forces",
          .title = "Force network",
          .description = "fabric tensor and its anisotropy, force chains, how long contacts last",
          .source = "Satake 1982; Peters et al. 2005",
          .needs = {.quantities = {}, .contacts = true, .grains = 2},
          .knobs = {numberKnob("angle", 45, 0, 90,
                               "between a chain's links and the principal directions, in degrees")},
          .make = [](const Parameters& knobs, const AnalysisContext& context) -> std::unique_ptr<Analysis> {
            return std::make_unique<ForceAnalysis>(knobs, context);
          }};
}

} // namespace sandglass::analysis
