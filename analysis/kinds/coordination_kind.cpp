// Coordination numbers: contact, mechanical, first shell, Voronoi faces; rattlers.

#include "analysis/coordination.h"
#include "analysis/grain_sizes.h"
#include "analysis/kinds/grain_statistics.h"
#include "analysis/kinds/kinds.h"
#include "analysis/kinds/knob_specs.h"
#include "analysis/neighbours.h"
#include "analysis/shell_cutoff.h"
#include "analysis/voronoi.h"
#include "sim/base/error.h"

#include <fmt/format.h>

#include <limits>

namespace sandglass::analysis {

namespace {

class CoordinationAnalysis : public Analysis {
public:
  CoordinationAnalysis(const Parameters& knobs, const AnalysisContext& context)
      : knobs_(knobs), context_(context) {}

  void add(const Frame& frame) override {
    if (context_.diameter <= 0) context_.diameter = meanDiameter(frame);
    const double d = context_.diameter;
    if (cutoff_.distance <= 0) cutoff_ = shellCutoff(frame, knobs_.number("cutoff"), d, context_);
    const Region region(frame, grainRegion(context_, d));
    const auto& radius = frame.scalar(quantity::radius);
    const ContactCounts counts =
        contactCounts(frame, knobs_.number("gap"), static_cast<int>(knobs_.integer("least_contacts")),
                      knobs_.boolean("again"));
    contactText_ = counts.definition;
    const auto near = countNeighbours(frame.position, frame.domain, cutoff_.distance);
    VoronoiOptions options;
    options.diameter = d;
    options.up = context_.facts.up;
    const VoronoiCells cells = voronoiCells(frame, options);

    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const std::size_t n = frame.size();
    std::vector<char> used(n);
    std::vector<double> contact(n), mechanical(n), rattler(n), shell(n), faces(n), effective(n);
    for (std::size_t i = 0; i < n; ++i) {
      used[i] = region.containsGrain(frame.position[i], radius[i]);
      contact[i] = counts.contacts[i];
      rattler[i] = counts.rattler[i];
      mechanical[i] = counts.rattler[i] ? nan : counts.mechanical[i];
      shell[i] = near[i];
      double area = 0, squares = 0, number = 0;
      for (const auto& face : cells.faces(i))
        if (face.other >= 0) number += 1, area += face.area, squares += face.area * face.area;
      const bool whole = !cells.atBound[i] && !cells.atSurface[i] && number > 0;
      faces[i] = whole ? number : nan;
      effective[i] = whole ? area * area / squares : nan;
    }
    contact_.add(contact, used);
    mechanical_.add(mechanical, used);
    rattler_.add(rattler, used);
    shell_.add(shell, used);
    faces_.add(faces, used);
    effective_.add(effective, used);
    regionText_ = region.description();
    grains_ = {{"contacts", "", contactText_, std::move(contact)},
               {"rattler", "", contactText_, std::move(rattler), {{0, "carries"}, {1, "rattler"}}},
               {"first_shell", "", "centres within " + cutoff_.text, std::move(shell)},
               {"neighbour_faces", "", "faces of the Voronoi cell with grains", std::move(faces)}};
  }

  Results results() const override {
    if (contact_.count() == 0) throw InputError("coordination numbers found no grain in the region");
    Results results;
    const std::string w = "; grains in W: " + regionText_;
    results.curves.push_back(contact_.shares("coordination_contacts", "Contacts of a grain", {"contacts", ""},
                                             "Z(contact): " + contactText_ + w));
    if (mechanical_.count() > 0)
      results.curves.push_back(mechanical_.shares("coordination_mechanical", "Contacts without rattlers",
                                                  {"contacts", ""}, "Z(mechanical): " + contactText_ + w));
    results.curves.push_back(shell_.shares("coordination_first_shell", "Neighbours in the first shell",
                                           {"neighbours", ""},
                                           "Z(first shell): centres within " + cutoff_.text + w));
    if (faces_.count() > 0)
      results.curves.push_back(faces_.shares("coordination_faces", "Neighbours by Voronoi faces",
                                             {"neighbours", ""},
                                             "Z(faces): faces of radical Voronoi cells with grains" + w));
    Table table;
    table.name = "coordination";
    table.title = "Coordination numbers";
    table.definition = fmt::format("contacts: {}; first shell: {}{}", contactText_, cutoff_.text, w);
    table.rowTitle = "number";
    table.columns = {
        {"mean", ""}, {"standard error", ""}, {"standard deviation over grains", ""}, {"grains", ""}};
    for (const auto& [name, statistics] : {std::pair{"contact", &contact_},
                                           {"mechanical", &mechanical_},
                                           {"share of rattlers", &rattler_},
                                           {"first shell", &shell_},
                                           {"faces", &faces_},
                                           {"faces weighted by area", &effective_}}) {
      table.rowNames.push_back(name);
      table.rows.push_back({statistics->mean(), statistics->error(), statistics->deviation(),
                            static_cast<double>(statistics->count())});
    }
    results.tables.push_back(std::move(table));
    results.grains = grains_;
    results.sentences.push_back(fmt::format(
        "coordination: Z(contact) {}, Z(mechanical) {} with {:.3g} % rattlers, Z(first shell) {} within "
        "{:.4g} d, "
        "Z(faces) {}",
        withError(contact_.mean(), contact_.error()), withError(mechanical_.mean(), mechanical_.error()),
        100 * rattler_.mean(), withError(shell_.mean(), shell_.error()), cutoff_.distance / context_.diameter,
        withError(faces_.mean(), faces_.error())));
    return results;
  }

private:
  Parameters knobs_;
  AnalysisContext context_;
  ShellCutoff cutoff_;
  GrainStatistics contact_, mechanical_, rattler_, shell_, faces_, effective_;
  std::vector<GrainValues> grains_;
  std::string contactText_, regionText_;
};

} // namespace

AnalysisKind coordinationKind() {
  return {.name = "coordination",
          .title = "Coordination numbers",
          .description =
              "contacts with and without rattlers, first shell, Voronoi faces: three named numbers",
          .source = "definitions printed on the result",
          .needs = {.quantities = {quantity::radius}, .grains = 2},
          .knobs = {numberKnob("gap", 0.001, 0, 1,
                               "largest gap of a contact, in diameters, where the frame has no contacts"),
                    integerKnob("least_contacts", 4, 1, 20, "a grain with fewer is a rattler"),
                    switchKnob("again", false,
                               "whether those left with fewer are rattlers, too, again and again"),
                    numberKnob("cutoff", 0, 0, 100,
                               "first shell up to here, in diameters; 0: first minimum of g(r)")},
          .make = [](const Parameters& knobs, const AnalysisContext& context) -> std::unique_ptr<Analysis> {
            return std::make_unique<CoordinationAnalysis>(knobs, context);
          }};
}

} // namespace sandglass::analysis
