// Bond order: q_l, w_l, averaged, Minkowski-weighted; crystal-like grains and clusters; structure types.

#include "analysis/grain_sizes.h"
#include "analysis/kinds/grain_statistics.h"
#include "analysis/kinds/kinds.h"
#include "analysis/kinds/knob_specs.h"
#include "analysis/neighbour_list.h"
#include "analysis/shell_cutoff.h"
#include "analysis/steinhardt.h"
#include "analysis/structure_types.h"
#include "analysis/voronoi.h"
#include "sim/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

namespace sandglass::analysis {

namespace {

class OrderAnalysis : public Analysis {
public:
  OrderAnalysis(const Parameters& knobs, const AnalysisContext& context) : knobs_(knobs), context_(context) {
    for (const double l : knobs.numbers("l"))
      ls_.push_back(static_cast<int>(l));
    minkowski_ = knobs.text("neighbours") == "faces";
  }

  void add(const Frame& frame) override {
    if (context_.diameter <= 0) context_.diameter = meanDiameter(frame);
    const double d = context_.diameter;
    const Region region(frame, grainRegion(context_, d));
    const auto& radius = frame.scalar(quantity::radius);
    const std::size_t n = frame.size();
    std::vector<char> used(n);
    for (std::size_t i = 0; i < n; ++i)
      used[i] = region.containsGrain(frame.position[i], radius[i]);
    grains_.clear();
    regionText_ = region.description();

    if (minkowski_) {
      VoronoiOptions options;
      options.diameter = d;
      options.up = context_.facts.up;
      const VoronoiCells cells = voronoiCells(frame, options);
      NeighbourList list;
      list.start.push_back(0);
      std::vector<double> area;
      for (std::size_t i = 0; i < n; ++i) {
        for (const auto& face : cells.faces(i))
          if (face.other >= 0 && face.area > 0) {
            list.index.push_back(static_cast<std::uint32_t>(face.other));
            list.vector.push_back(face.vector);
            area.push_back(face.area);
          }
        list.start.push_back(list.index.size());
        if (cells.atBound[i] || cells.atSurface[i]) used[i] = 0;
      }
      neighbourText_ =
          "neighbours by faces of radical Voronoi cells, weighted by area (Minkowski structure metrics)";
      measure(frame, region, list, area, used);
    } else {
      if (cutoff_.distance <= 0) cutoff_ = shellCutoff(frame, knobs_.number("cutoff"), d, context_);
      neighbourText_ = "neighbours within " + cutoff_.text;
      measure(frame, region, neighboursWithin(frame.position, frame.domain, cutoff_.distance), {}, used);
    }
  }

  Results results() const override {
    if (frames_ == 0) throw InputError("bond order needs at least one frame");
    Results results;
    const std::string w = "; " + neighbourText_ + "; grains in W: " + regionText_;
    const int bins = static_cast<int>(knobs_.integer("bins"));
    Table table;
    table.name = "order";
    table.title = "Bond order";
    table.definition = "means over grains" + w;
    table.rowTitle = "quantity";
    table.columns = {
        {"mean", ""}, {"standard error", ""}, {"standard deviation over grains", ""}, {"grains", ""}};
    std::string sentence = "bond order:";
    for (const auto& [name, statistics] : statistics_) {
      if (statistics.count() == 0) continue;
      if (name != "solid_bonds" && name != "crystal_like" && name != "structure")
        results.curves.push_back(
            statistics.distribution(name, "Distribution of " + name, {name, ""}, name + w, bins));
      table.rowNames.push_back(name);
      table.rows.push_back({statistics.mean(), statistics.error(), statistics.deviation(),
                            static_cast<double>(statistics.count())});
      if (name[0] == 'q')
        sentence += fmt::format(" {} {}", name, withError(statistics.mean(), statistics.error()));
    }
    if (const auto it = statistics_.find("crystal_like"); it != statistics_.end())
      sentence += fmt::format("; {:.3g} % crystal-like, largest cluster {} grains", 100 * it->second.mean(),
                              largest_);
    results.tables.push_back(std::move(table));
    if (!shares_.empty()) {
      Table types;
      types.name = "structure_types";
      types.title = "Structure types";
      types.definition = structureText() + w;
      types.rowTitle = "type";
      types.columns = {{"share", ""}};
      double total = 0;
      for (const auto& [type, count] : shares_)
        total += count;
      for (const auto& [type, name] : structureNames()) {
        types.rowNames.push_back(name);
        types.rows.push_back({shares_.contains(type) ? shares_.at(type) / total : 0});
      }
      results.tables.push_back(std::move(types));
    }
    results.grains = grains_;
    results.sentences.push_back(sentence);
    return results;
  }

private:
  std::string structureText() const {
    return fmt::format(
        "ordered where averaged q6 > {}; sc: averaged q4 > {}; bcc: averaged w6 > 0; fcc: averaged w4 < "
        "0; hcp: the rest; wall layer: disordered with a gap to a wall below half a diameter",
        knobs_.number("ordered"), StructureThresholds{}.q4);
  }

  void keep(const std::string& name, std::vector<double> values, const std::vector<char>& used,
            const std::string& definition, std::map<int, std::string> classes = {}) {
    statistics_[name].add(values, used);
    grains_.push_back({name, "", definition, std::move(values), std::move(classes)});
  }

  void measure(const Frame& frame, const Region& region, const NeighbourList& list,
               const std::vector<double>& area, const std::vector<char>& used) {
    ++frames_;
    const Bonds bonds{list.start, list.index, list.vector, area};
    std::map<std::pair<char, int>, std::vector<double>> mean; // averaged, for the structure types
    for (const int l : ls_) {
      const BondOrder order = bondOrder(bonds, l);
      const BondOrder smooth = averaged(order, bonds);
      mean[{'q', l}] = magnitudes(smooth);
      if (l == 4 || l == 6) mean[{'w', l}] = thirdOrder(smooth);
      keep(fmt::format("q{}", l), magnitudes(order), used, neighbourText_);
      if (l == 4 || l == 6) keep(fmt::format("w{}", l), thirdOrder(order), used, neighbourText_);
      keep(fmt::format("q{}_averaged", l), mean[{'q', l}], used,
           "over the grain and its neighbours; " + neighbourText_);
      if (l == 6) crystals(order, list, bonds, used);
    }
    if (ls_.end() == std::find(ls_.begin(), ls_.end(), 4) ||
        ls_.end() == std::find(ls_.begin(), ls_.end(), 6))
      return;
    std::vector<double> type(frame.size());
    for (std::size_t i = 0; i < frame.size(); ++i) {
      const double gap = wallGap(frame, i);
      const auto kind =
          structureType(mean[{'q', 4}][i], mean[{'q', 6}][i], mean[{'w', 4}][i], mean[{'w', 6}][i],
                        gap < 0.5 * context_.diameter, {knobs_.number("ordered"), StructureThresholds{}.q4});
      type[i] = static_cast<int>(kind);
      if (region.containsGrain(frame.position[i], frame.scalar(quantity::radius)[i]))
        shares_[static_cast<int>(kind)] += 1;
    }
    grains_.push_back({"structure", "", structureText(), std::move(type), structureNames()});
  }

  static double wallGap(const Frame& frame, std::size_t i) {
    double gap = std::numeric_limits<double>::infinity();
    for (const auto& wall : frame.walls)
      if (wall.active) gap = std::min(gap, wall.shape->signedDistance(frame.position[i]));
    return gap - frame.scalar(quantity::radius)[i];
  }

  /// Bonds with aligned q6, grains with enough of them, and their clusters (ten Wolde et al. 1995).
  void crystals(const BondOrder& order, const NeighbourList& list, const Bonds& bonds,
                const std::vector<char>& used) {
    const auto s = alignment(order, bonds);
    const double limit = knobs_.number("solid_alignment");
    std::vector<double> solid(list.size()), like(list.size());
    for (std::size_t i = 0; i < list.size(); ++i) {
      for (std::size_t k = list.start[i]; k < list.start[i + 1]; ++k)
        solid[i] += s[k] > limit;
      like[i] = solid[i] >= static_cast<double>(knobs_.integer("solid_bonds"));
    }
    const auto cluster = components(
        list, [&](std::size_t i) { return like[i] > 0; },
        [&](std::size_t, std::size_t k) { return s[k] > limit; });
    std::map<int, std::size_t> size;
    for (const int c : cluster)
      if (c >= 0) ++size[c];
    largest_ = 0;
    for (const auto& [c, grains] : size)
      largest_ = std::max(largest_, grains);
    const std::string text = fmt::format("bonds with s_ij > {} of q6", limit);
    keep("solid_bonds", std::move(solid), used, text);
    keep("crystal_like", std::move(like), used,
         fmt::format("{} {} or more", text, knobs_.integer("solid_bonds")),
         {{0, "disordered"}, {1, "crystal-like"}});
    grains_.push_back({"crystal_cluster", "", "connected crystal-like grains, -1: none",
                       std::vector<double>(cluster.begin(), cluster.end())});
  }

  Parameters knobs_;
  AnalysisContext context_;
  std::vector<int> ls_;
  bool minkowski_ = false;
  ShellCutoff cutoff_;
  std::map<std::string, GrainStatistics> statistics_;
  std::map<int, double> shares_;
  std::vector<GrainValues> grains_;
  std::string neighbourText_, regionText_;
  std::size_t frames_ = 0, largest_ = 0;
};

} // namespace

AnalysisKind orderKind() {
  ParameterSpec l{.name = "l",
                  .type = ParameterType::numbers,
                  .unit = "1",
                  .description = "which q_l, with commas between",
                  .fallback = std::vector<double>{4, 6},
                  .minimum = 2,
                  .maximum = 12};
  return {
      .name = "order",
      .title = "Bond order",
      .description = "Steinhardt's q_l and w_l, averaged, crystal-like grains and clusters, structure types",
      .source = "Steinhardt et al. 1983; Lechner & Dellago 2008; Mickel et al. 2013; ten Wolde et al. 1995",
      .needs = {.quantities = {quantity::radius}, .grains = 2},
      .knobs = {std::move(l),
                choiceKnob("neighbours", "shell", {"shell", "faces"},
                           "within the first shell, or by Voronoi faces weighted by area"),
                numberKnob("cutoff", 0, 0, 100,
                           "first shell up to here, in diameters; 0: first minimum of g(r)"),
                numberKnob("solid_alignment", 0.7, 0, 1, "a bond is aligned above this s_ij"),
                integerKnob("solid_bonds", 7, 1, 20, "a grain with so many aligned bonds is crystal-like"),
                numberKnob("ordered", 0.35, 0, 1, "averaged q6 above which a structure type is looked for"),
                integerKnob("bins", 100, 1, 100000, "bins of the distributions")},
      .make = [](const Parameters& knobs, const AnalysisContext& context) -> std::unique_ptr<Analysis> {
        return std::make_unique<OrderAnalysis>(knobs, context);
      }};
}

} // namespace sandglass::analysis
