#include "app/cli/analyze_kinds.h"

#include "app/cli/console.h"
#include "sim/base/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace sandglass::cli {

using namespace analysis;

namespace {

std::string textOf(const ParameterValue& value) {
  if (const auto* number = std::get_if<double>(&value)) return fmt::format("{}", *number);
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *whole);
  if (const auto* yes = std::get_if<bool>(&value)) return *yes ? "true" : "false";
  if (const auto* text = std::get_if<std::string>(&value)) return text->empty() ? "\"\"" : *text;
  if (const auto* numbers = std::get_if<std::vector<double>>(&value))
    return fmt::format("{}", fmt::join(*numbers, ","));
  return "";
}

/// Defaults, the older options of g(r), and every --knob of this analysis.
Parameters knobsFor(const AnalysisKind& kind, const AnalyzeOptions& options, double diameter) {
  Parameters knobs = defaultKnobs(kind);
  if (kind.name == "gr") {
    knobs.set("estimator", options.estimator);
    knobs.set("bins", static_cast<std::int64_t>(options.bins));
    knobs.set("r_max", lengthOption("--r-max", options.rMax, diameter) / diameter);
  }
  if (kind.name == "fields")
    for (const auto& [knob, text] : {std::pair{"heights", &options.heights}, {"radii", &options.radii}}) {
      if (text->empty()) continue;
      auto places = placesOption(fmt::format("--{}", knob), *text, diameter);
      for (double& x : places)
        x /= diameter;
      knobs.set(knob, std::move(places));
    }
  for (const auto& text : options.knobs) {
    const auto dot = text.find('.'), equals = text.find('=');
    if (dot == std::string::npos || equals == std::string::npos || dot > equals)
      throw InputError(fmt::format("--knob is '{}', but must read like gr.bins=400", text));
    if (analysisKind(text.substr(0, dot)).name == kind.name)
      setKnob(knobs, kind, text.substr(dot + 1, equals - dot - 1), text.substr(equals + 1));
  }
  return knobs;
}

/// One row per grain: id, position, and every value that analyses gave.
Table grainTable(const std::string& name, const std::vector<GrainValues>& grains, const Frame& frame) {
  Table table;
  table.name = name + "_grains";
  table.title = "Values of single grains";
  table.columns = {{"id", ""}, {"x", "m"}, {"y", "m"}, {"z", "m"}};
  for (const auto& values : grains) {
    table.columns.push_back({values.name, values.unit});
    table.definition += (table.definition.empty() ? "" : "; ") + values.name + ": " + values.definition;
    for (const auto& [number, meaning] : values.classes)
      table.definition += fmt::format(", {} = {}", number, meaning);
  }
  for (std::size_t i = 0; i < frame.size(); ++i) {
    std::vector<double> row{static_cast<double>(frame.id[i]), frame.position[i].x(), frame.position[i].y(),
                            frame.position[i].z()};
    for (const auto& values : grains)
      row.push_back(values.values[i]);
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table ballTable(const BallSet& set) {
  Table table;
  table.name = set.name;
  table.title = "Spheres, largest first";
  table.definition = set.definition;
  table.columns = {{"x", "m"}, {"y", "m"}, {"z", "m"}, {"radius", "m"}, {"at wall", ""}};
  for (const auto& ball : set.balls)
    table.rows.push_back(
        {ball.centre.x(), ball.centre.y(), ball.centre.z(), ball.radius, ball.atWall ? 1.0 : 0.0});
  return table;
}

} // namespace

std::string optionOf(const AnalysisKind& kind) {
  std::string option = "--" + kind.name;
  std::replace(option.begin(), option.end(), '_', '-');
  return option;
}

void printAnalysisKinds() {
  for (const auto& kind : analysisKinds()) {
    fmt::print("{}\n  {} ({})\n", optionOf(kind), kind.description, kind.source);
    std::vector<std::string> needs(kind.needs.quantities);
    if (kind.needs.contacts) needs.push_back("contacts");
    if (kind.needs.persistentIds) needs.push_back("ids that persist");
    if (kind.needs.up) needs.push_back("gravity or --up");
    if (kind.needs.frames > 1) needs.push_back(fmt::format("{} frames or more", kind.needs.frames));
    if (!needs.empty()) fmt::print("  needs {}\n", fmt::join(needs, ", "));
    for (const auto& knob : kind.knobs) {
      fmt::print("    {}.{} = {}  {}", kind.name, knob.name, textOf(knob.fallback.value_or(std::string())),
                 knob.description);
      if (!knob.choices.empty()) fmt::print(" ({})", fmt::join(knob.choices, ", "));
      fmt::print("\n");
    }
  }
}

void analyzeKind(const AnalysisKind& kind, const Source& source, const AnalyzeOptions& options,
                 ResultFiles& files) {
  auto [from, to] = framesFor(source, options);
  if (kind.needs.frames > 1 && options.frames.empty()) from = 0, to = source.frames->size() - 1;
  // Runs often begin empty and are poured into.
  while (kind.needs.frames > 1 && options.frames.empty() && from < to &&
         source.frames->load(from)->size() == 0)
    ++from;
  if (to - from + 1 < kind.needs.frames)
    throw InputError(
        fmt::format("{} needs at least {} frames, but has {}", kind.title, kind.needs.frames, to - from + 1));
  const FramePtr first = source.frames->load(from);
  AnalysisContext context;
  context.facts = source.facts;
  if (!options.diameter.empty() || first->has(quantity::radius))
    context.diameter = diameterFor(options, *first);
  context.limits = limitsFor(source, options, context.diameter);
  const Parameters knobs = knobsFor(kind, options, context.diameter);
  if (const auto why = reasonAgainst(kind, *first, context); !why.empty())
    throw InputError(fmt::format("{}: {}", source.path.string(), why));

  const auto work = makeAnalysis(kind, knobs, context);
  ProgressBar bar(kind.title);
  FramePtr last = first;
  for (std::size_t f = from; f <= to; ++f) {
    last = f == from ? first : source.frames->load(f);
    work->add(*last);
    bar.update(static_cast<double>(f - from + 1) / static_cast<double>(to - from + 1), -1,
               fmt::format("frame {}", f));
  }
  bar.finish();
  Results results = work->results();

  std::vector<Table> tables = std::move(results.tables);
  if (!results.grains.empty()) tables.push_back(grainTable(kind.name, results.grains, *last));
  for (const auto& set : results.balls)
    tables.push_back(ballTable(set));
  const auto finish = [&](auto& result) {
    result.provenance["frame_indices"] = fmt::format("{}:{}", from, to);
    for (const auto& [knob, value] : knobs.all())
      result.provenance["knob " + knob] = textOf(value);
    stamp(result, source, *first);
    files.write(result, source.prefix);
  };
  for (auto& curve : results.curves)
    finish(curve);
  for (auto& table : tables)
    finish(table);
  for (auto& field : results.fields)
    finish(field);
  for (const auto& sentence : results.sentences)
    fmt::print("{}{}\n", source.prefix, sentence);
}

} // namespace sandglass::cli
