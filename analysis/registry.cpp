#include "analysis/registry.h"

#include "analysis/kinds/kinds.h"
#include "analysis/whole_circle.h"
#include "sim/base/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace sandglass::analysis {

namespace {

class WedgeAnalysis final : public Analysis {
public:
  WedgeAnalysis(std::unique_ptr<Analysis> work, const Sector& sector)
      : work_(std::move(work)), circle_(sector) {}

  void add(const Frame& frame) override {
    grains_ = frame.size();
    work_->add(circle_.add(frame));
  }

  Results results() const override {
    Results results = work_->results();
    const std::string remark = fmt::format(
        "of a wedge: its grains and their {} images, which errors count as independent, so that they "
        "are up to {:.2g} times larger",
        circle_.sector().count() - 1, std::sqrt(circle_.sector().count()));
    const auto say = [&](auto& list) {
      for (auto& result : list)
        result.definition += (result.definition.empty() ? "" : "; ") + remark;
    };
    say(results.curves);
    say(results.tables);
    say(results.fields);
    for (auto& values : results.grains)
      values.values.resize(std::min(values.values.size(), grains_));
    results.sentences.push_back(remark);
    return results;
  }

private:
  std::unique_ptr<Analysis> work_;
  WholeCircle circle_;
  std::size_t grains_ = 0;
};

} // namespace

std::unique_ptr<Analysis> makeAnalysis(const AnalysisKind& kind, const Parameters& knobs,
                                       const AnalysisContext& context) {
  auto work = kind.make(knobs, context);
  if (context.facts.sector.whole()) return work;
  return std::make_unique<WedgeAnalysis>(std::move(work), context.facts.sector);
}

const std::vector<AnalysisKind>& analysisKinds() {
  static const std::vector<AnalysisKind> kinds{
      pairCorrelationKind(), bondAngleKind(), voidsKind(),        voronoiKind(), orderKind(),
      coordinationKind(),    stateKind(),     fieldsKind(),       motionKind(),  mixingKind(),
      clumpsKind(),          forcesKind(),    surfaceAngleKind(), vortexKind(),
  };
  return kinds;
}

const AnalysisKind& analysisKind(const std::string& name) {
  std::vector<std::string> names;
  for (const auto& kind : analysisKinds()) {
    if (kind.name == name) return kind;
    names.push_back(kind.name);
  }
  throw InputError(fmt::format("there is no analysis '{}'; there are {}", name, fmt::join(names, ", ")));
}

Parameters defaultKnobs(const AnalysisKind& kind) {
  Parameters knobs;
  for (const auto& spec : kind.knobs)
    if (spec.fallback) knobs.set(spec.name, *spec.fallback);
  return knobs;
}

std::string reasonAgainst(const AnalysisKind& kind, const Frame& frame, const AnalysisContext& context) {
  const AnalysisNeeds& needs = kind.needs;
  for (const auto& quantity : needs.quantities)
    if (!frame.has(quantity) && !(quantity == quantity::radius && context.diameter > 0))
      return fmt::format("{} needs the quantity '{}', which the frame does not have{}", kind.title, quantity,
                         quantity == quantity::radius ? ": give a diameter" : "");
  if (frame.size() < needs.grains)
    return fmt::format("{} needs at least {} grains, but the frame has {}", kind.title, needs.grains,
                       frame.size());
  if (needs.contacts && frame.contacts.empty())
    return fmt::format("{} needs contacts, which the frame does not have: write them with contacts = true in "
                       "the scene's [output]",
                       kind.title);
  if (needs.persistentIds && !frame.persistentIds)
    return fmt::format("{} follows grains from frame to frame, but the ids of these frames do not persist",
                       kind.title);
  if (needs.up && !context.facts.up)
    return fmt::format("{} needs to know where up is, but there is no gravity: give --up", kind.title);
  return {};
}

Results analyze(const AnalysisKind& kind, const Parameters& knobs, const AnalysisContext& context,
                const std::vector<FramePtr>& frames) {
  if (frames.size() < kind.needs.frames)
    throw InputError(fmt::format("{} needs at least {} frames, but there {} {}", kind.title,
                                 kind.needs.frames, frames.size() == 1 ? "is" : "are", frames.size()));
  if (const auto why = reasonAgainst(kind, *frames.front(), context); !why.empty()) throw InputError(why);
  const auto work = makeAnalysis(kind, knobs, context);
  for (const auto& frame : frames)
    work->add(*frame);
  return work->results();
}

} // namespace sandglass::analysis
