// Clumps: grains joined by small gaps or by contacts.

#include "analysis/grain_sizes.h"
#include "analysis/kinds/kinds.h"
#include "analysis/kinds/knob_specs.h"
#include "analysis/neighbour_list.h"
#include "analysis/shell_cutoff.h"
#include "sim/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <unordered_map>

namespace sandglass::analysis {

namespace {

/// Grains that share a contact of the frame, gaps across which a law acts (liquid bridges) included. Walls
/// join nothing.
NeighbourList joinedByContacts(const Frame& frame) {
  std::unordered_map<std::int64_t, std::uint32_t> index;
  for (std::size_t i = 0; i < frame.size(); ++i)
    index.emplace(frame.id[i], static_cast<std::uint32_t>(i));
  std::vector<std::vector<std::uint32_t>> partners(frame.size());
  for (const auto& contact : frame.contacts) {
    const auto a = index.find(contact.a), b = index.find(contact.b);
    if (a == index.end() || b == index.end()) continue;
    partners[a->second].push_back(b->second);
    partners[b->second].push_back(a->second);
  }
  NeighbourList list;
  list.start.push_back(0);
  for (const auto& own : partners) {
    list.index.insert(list.index.end(), own.begin(), own.end());
    list.start.push_back(list.index.size());
  }
  return list;
}

class ClumpAnalysis : public Analysis {
public:
  ClumpAnalysis(const Parameters& knobs, const AnalysisContext& context) : knobs_(knobs), context_(context) {}

  void add(const Frame& frame) override {
    if (context_.diameter <= 0) context_.diameter = meanDiameter(frame);
    const bool byContacts = knobs_.text("links") == "contacts";
    if (byContacts && frame.contacts.empty() && frame.size() > 1) ++withoutContacts_;
    // Limits choose grains; walls, gates and surfaces do not: clumps below the outlet are what one looks for.
    const auto inside = [&](std::size_t i) {
      return (frame.position[i].array() >= context_.limits.lower.array()).all() &&
             (frame.position[i].array() <= context_.limits.upper.array()).all();
    };
    const bool whole = knobs_.boolean("whole");
    const auto list = byContacts ? joinedByContacts(frame) : joinedByGaps(frame);
    auto clump = components(
        list, [&](std::size_t i) { return whole || inside(i); },
        [](std::size_t, std::size_t) { return true; });
    if (whole) {
      std::set<int> reachingOut;
      for (std::size_t i = 0; i < clump.size(); ++i)
        if (!inside(i)) reachingOut.insert(clump[i]);
      for (int& c : clump)
        if (reachingOut.contains(c)) c = -1;
    }
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
        fmt::format("grains joined by {}, connected; a lone grain is a clump of one{}",
                    knobs_.text("links") == "contacts"
                        ? std::string("contacts of the frame, bridges across gaps included")
                        : fmt::format("gaps of at most {:.3g} d", knobs_.number("gap")),
                    knobs_.boolean("whole") ? "; clumps with grains beyond the limits left out" : "");
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
    results.grains = {{"clump", "", definition + "; -1: in none", number_},
                      {"clump_size", "", definition, size_}};
    results.sentences.push_back(
        fmt::format("clumps at {:.4g} s: largest {:.0f} grains", times_.back(), largest_.back()));
    if (withoutContacts_ > 0)
      results.sentences.push_back(fmt::format("clumps: {} of {} frames hold no contacts, so that all their "
                                              "grains stand alone: set contacts = true in "
                                              "[output] of the scene, or links = gaps",
                                              withoutContacts_, times_.size()));
    return results;
  }

private:
  NeighbourList joinedByGaps(const Frame& frame) const {
    std::vector<double> reach;
    for (const double r : frame.scalar(quantity::radius))
      reach.push_back(r + 0.5 * knobs_.number("gap") * context_.diameter);
    return neighboursByGap(frame.position, reach, frame.domain, 1);
  }

  Parameters knobs_;
  AnalysisContext context_;
  std::map<double, double> counts_;
  std::vector<double> times_, largest_, number_, size_;
  double grains_ = 0;
  std::size_t withoutContacts_ = 0; ///< frames
};

} // namespace

AnalysisKind clumpsKind() {
  return {.name = "clumps",
          .title = "Clumps",
          .description = "connected groups of grains: sizes, the largest against time",
          .source = "connected components",
          .needs = {.quantities = {quantity::radius}, .grains = 1},
          .knobs = {numberKnob("gap", 0.01, 0, 10, "largest gap that joins two grains, in diameters"),
                    choiceKnob("links", "gaps", {"gaps", "contacts"},
                               "what joins: small gaps, or contacts and bridges of the frame"),
                    switchKnob("whole", false,
                               "whether only clumps count that lie within the limits as a whole")},
          .make = [](const Parameters& knobs, const AnalysisContext& context) -> std::unique_ptr<Analysis> {
            return std::make_unique<ClumpAnalysis>(knobs, context);
          }};
}

} // namespace sandglass::analysis
