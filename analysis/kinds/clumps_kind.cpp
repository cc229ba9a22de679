// Clumps: grains joined by small gaps or by contacts.

#include "analysis/grain_sizes.h"
#include "analysis/kinds/kinds.h"
#include "analysis/kinds/knob_specs.h"
#include "analysis/neighbour_list.h"
#include "analysis/shell_cutoff.h"
#include "sim/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace sandglass::analysis {

namespace {

class ClumpAnalysis : public Analysis {
public:
  ClumpAnalysis(const Parameters& knobs, const AnalysisContext& context) : knobs_(knobs), context_(context) {}

  void add(const Frame& frame) override {
    if (context_.diameter <= 0) context_.diameter = meanDiameter(frame);
    const auto& radius = frame.scalar(quantity::radius);
    std::vector<double> reach;
    for (const double r : radius)
      reach.push_back(r + 0.5 * knobs_.number("gap") * context_.diameter);
    // Limits choose grains; walls, gates and surfaces do not: clumps below the outlet are what one looks for.
    const auto inside = [&](std::size_t i) {
      return (frame.position[i].array() >= context_.limits.lower.array()).all() &&
             (frame.position[i].array() <= context_.limits.upper.array()).all();
    };
    const auto list = neighboursByGap(frame.position, reach, frame.domain, 1);
    const auto clump = components(list, inside, [](std::size_t, std::size_t) { return true; });
    std::map<int, double> size;
    for (const int c : clump)
      if (c >= 0) size[c] += 1;
    double largest = 0;
    for (const auto& [c, n] : size) {
      largest = std::max(largest, n);
      counts_[n] += 1;
      grains_ += n;
    }
    times_.push_back(frame.time);
    largest_.push_back(largest);
    number_.assign(clump.begin(), clump.end());
    size_.clear();
    for (const int c : clump)
      size_.push_back(c >= 0 ? size[c] : std::numeric_limits<double>::quiet_NaN());
  }

  Results results() const override {
    if (times_.empty()) throw InputError("clumps need at least one frame");
    Results results;
    const std::string definition =
        fmt::format("grains joined by gaps of at most {:.3g} d, connected; a lone grain is a clump of one",
                    knobs_.number("gap"));
    Curve sizes;
    sizes.name = "clump_sizes";
    sizes.title = "Clumps by size";
    sizes.definition = "share of the grains that are in clumps of this size, all frames; " + definition;
    sizes.x = {"grains in the clump", ""};
    sizes.y = {"share of the grains", ""};
    sizes.frames = times_.size();
    Series share{"", {}, {}, {}};
    for (const auto& [n, count] : counts_) {
      share.x.push_back(n);
      share.y.push_back(n * count / grains_);
    }
    sizes.series.push_back(std::move(share));
    Curve largest = sizes;
    largest.name = "largest_clump";
    largest.title = "Largest clump";
    largest.definition = definition;
    largest.x = {"time", "s"};
    largest.y = {"grains", ""};
    largest.series = {{"", times_, largest_, {}}};
    results.curves = {std::move(sizes), std::move(largest)};
    results.grains = {{"clump", "", definition + "; -1: outside the limits", number_},
                      {"clump_size", "", definition, size_}};
    results.sentences.push_back(
        fmt::format("clumps at {:.4g} s: largest {:.0f} grains", times_.back(), largest_.back()));
    return results;
  }

private:
  Parameters knobs_;
  AnalysisContext context_;
  std::map<double, double> counts_;
  std::vector<double> times_, largest_, number_, size_;
  double grains_ = 0;
};

} // namespace

AnalysisKind clumpsKind() {
  return {.name = "clumps",
          .title = "Clumps",
          .description = "connected groups of grains: sizes, the largest against time",
          .source = "connected components",
          .needs = {.quantities = {quantity::radius}, .grains = 1},
          .knobs = {numberKnob("gap", 0.01, 0, 10, "largest gap that joins two grains, in diameters")},
          .make = [](const Parameters& knobs, const AnalysisContext& context) -> std::unique_ptr<Analysis> {
            return std::make_unique<ClumpAnalysis>(knobs, context);
          }};
}

} // namespace sandglass::analysis
