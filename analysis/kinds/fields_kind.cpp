// Coarse-grained fields on a grid, averaged over time, and profiles taken from them.

#include "analysis/coarse_graining.h"
#include "analysis/flow_profiles.h"
#include "analysis/free_surface.h"
#include "analysis/grain_sizes.h"
#include "analysis/kinds/kinds.h"
#include "analysis/kinds/knob_specs.h"
#include "analysis/shell_cutoff.h"
#include "sim/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace sandglass::analysis {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

class FieldAnalysis : public Analysis {
public:
  FieldAnalysis(const Parameters& knobs, const AnalysisContext& context) : knobs_(knobs), context_(context) {}

  void add(const Frame& frame) override {
    if (frames_ == 0) begin(frame);
    const double d = context_.diameter;
    const CoarseGrainer grainer(frame, knobs_.number("width") * d, d, density());
    contacts_ = contacts_ || grainer.hasContacts();
    const auto averages = grainer.at(nodes_);
    for (std::size_t k = 0; k < nodes_.size(); ++k)
      sum_[k] += averages[k];
    profiles_->add(grainer);
    ++frames_;
  }

  Results results() const override {
    if (frames_ == 0) throw InputError("fields need at least one frame");
    Results results;
    Field field = field_;
    field.frames = frames_;
    field.definition = definition();
    const double d = context_.diameter, n = static_cast<double>(frames_);
    // Where less than a hundredth of the usual mass is, there is nothing to average.
    double most = 0;
    for (const auto& s : sum_)
      most = std::max(most, s.mass);
    auto& rho = field.scalars["density"];
    auto& phi = field.scalars["packing_fraction"];
    auto& temperature = field.scalars["granular_temperature"];
    auto& shear = field.scalars["shear_rate"];
    auto& pressure = field.scalars["pressure"];
    auto& inertial = field.scalars["inertial_number"];
    auto& velocity = field.vectors["velocity"];
    auto& vorticity = field.vectors["vorticity"];
    auto& kinetic = field.tensors["kinetic_stress"];
    auto& strain = field.tensors["strain_rate"];
    for (const auto& s : sum_) {
      const bool there = s.mass > 0.01 * most;
      const Eigen::Matrix3d none = Eigen::Matrix3d::Constant(nan);
      rho.push_back(s.mass / n);
      phi.push_back(s.volume / n);
      velocity.push_back(there ? s.velocity() : Vec3::Constant(nan));
      temperature.push_back(there ? s.temperature() : nan);
      shear.push_back(there ? s.shearRate() : nan);
      vorticity.push_back(there ? s.vorticity() : Vec3::Constant(nan));
      strain.push_back(there ? s.strainRate() : none);
      kinetic.push_back(there ? Eigen::Matrix3d(s.kineticStress() / n) : none);
      const double p = there ? s.pressure() / n : nan;
      pressure.push_back(p);
      const double solid = s.volume > 0 ? s.mass / s.volume : nan;
      inertial.push_back(p > 0 ? s.shearRate() * d * std::sqrt(solid / p) : nan);
      if (contacts_) field.tensors["contact_stress"].push_back(s.contactStress / n);
    }
    if (!contacts_) { // without forces the pressure is a part of it only
      field.scalars.erase("pressure");
      field.scalars.erase("inertial_number");
    }
    field.units = {{"density", "kg/m^3"},    {"granular_temperature", "m^2/s^2"},
                   {"shear_rate", "1/s"},    {"pressure", "Pa"},
                   {"velocity", "m/s"},      {"vorticity", "1/s"},
                   {"kinetic_stress", "Pa"}, {"strain_rate", "1/s"},
                   {"contact_stress", "Pa"}};
    byHeight(field, results);
    for (auto& curve : profiles_->curves(field.definition))
      results.curves.push_back(std::move(curve));
    results.sentences.push_back(fmt::format("fields: {} x {} x {} nodes, kernel width {:.3g} d, {} frame{}",
                                            field.count[0], field.count[1], field.count[2],
                                            knobs_.number("width"), frames_, frames_ == 1 ? "" : "s"));
    if (const auto missing = profiles_->emptyLines(); !missing.empty()) results.sentences.push_back(missing);
    results.fields.push_back(std::move(field));
    return results;
  }

private:
  double density() const { return context_.facts.grainDensity > 0 ? context_.facts.grainDensity : 1; }

  std::string definition() const {
    return fmt::format(
        "coarse-grained (Goldhirsch 2010) with Lucy's kernel of width w = {:.3g} d, cut at 2 w; averages "
        "of density, momentum and stress over {} frame{}, then ratios; pressure positive in compression, "
        "{}; T_g = <|v - u|^2> / 3; shear rate sqrt(2 D':D'); I = shear rate d sqrt(rho_s / P); d = {:.5g} m",
        knobs_.number("width"), frames_, frames_ == 1 ? "" : "s",
        contacts_ ? "kinetic and contact part" : "kinetic part alone, since the frames have no contacts",
        context_.diameter);
  }

  void begin(const Frame& frame) {
    if (context_.diameter <= 0) context_.diameter = meanDiameter(frame);
    const double d = context_.diameter, spacing = knobs_.number("spacing") * d;
    Vec3 lower = Vec3::Constant(std::numeric_limits<double>::infinity()), upper = -lower;
    for (const auto& x : frame.position)
      lower = lower.cwiseMin(x), upper = upper.cwiseMax(x);
    field_.name = "fields";
    field_.title = "Coarse-grained fields";
    double nodes = 1;
    for (int k = 0; k < 3; ++k) {
      const auto a = static_cast<std::size_t>(k);
      lower[k] = std::max(lower[k] - 0.5 * d, context_.limits.lower[k]);
      upper[k] = std::min(upper[k] + 0.5 * d, context_.limits.upper[k]);
      if (frame.domain.periodic[a]) lower[k] = frame.domain.lower[k], upper[k] = frame.domain.upper[k];
      const double length = std::max(upper[k] - lower[k], 1e-9 * d);
      field_.count[a] = std::max(1, static_cast<int>(std::lround(length / spacing)));
      field_.spacing[k] = length / field_.count[a];
      field_.origin[k] = lower[k] + 0.5 * field_.spacing[k]; // in the middle of cells
      nodes *= field_.count[a];
    }
    if (nodes > 5e7)
      throw InputError(fmt::format(
          "fields would have {:.3g} nodes, but 5e7 are the most: give a larger spacing or limits", nodes));
    for (int c = 0; c < field_.count[2]; ++c)
      for (int b = 0; b < field_.count[1]; ++b)
        for (int a = 0; a < field_.count[0]; ++a)
          nodes_.push_back(field_.node(a, b, c));
    sum_.resize(nodes_.size());
    profiles_.emplace(profileLines());
  }

  /// Averages over all nodes of a height, by mass where they are of grains.
  void byHeight(const Field& field, Results& results) const {
    const UpFrame axes(context_.facts.up.value_or(Vec3::UnitZ()));
    const double width = knobs_.number("spacing") * context_.diameter;
    std::map<long, std::vector<std::size_t>> slabs;
    for (std::size_t k = 0; k < nodes_.size(); ++k)
      slabs[std::lround(nodes_[k].dot(axes.up) / width)].push_back(k);
    const auto profile = [&](const std::string& name, const std::string& title, Axis y, auto&& value) {
      Curve curve;
      curve.name = name;
      curve.title = title;
      curve.definition = "mean over the nodes of a height, weighted by mass; " + field.definition;
      curve.x = {"height", "m"};
      curve.y = std::move(y);
      curve.frames = frames_;
      Series series;
      for (const auto& [slab, members] : slabs) {
        double sum = 0, mass = 0;
        for (const auto k : members)
          if (const double v = value(k); std::isfinite(v)) sum += v * sum_[k].mass, mass += sum_[k].mass;
        if (!(mass > 0)) continue;
        series.x.push_back(static_cast<double>(slab) * width);
        series.y.push_back(sum / mass);
      }
      curve.series.push_back(std::move(series));
      results.curves.push_back(std::move(curve));
    };
    const auto& u = field.vectors.at("velocity");
    profile("velocity_by_height", "Downward velocity by height", {"velocity against up", "m/s"},
            [&](std::size_t k) { return -u[k].dot(axes.up); });
    profile("temperature_by_height", "Granular temperature by height", {"T_g", "m^2/s^2"},
            [&](std::size_t k) { return field.scalars.at("granular_temperature")[k]; });
    profile("shear_rate_by_height", "Shear rate by height", {"shear rate", "1/s"},
            [&](std::size_t k) { return field.scalars.at("shear_rate")[k]; });
    if (contacts_)
      profile("pressure_by_height", "Pressure by height", {"P", "Pa"},
              [&](std::size_t k) { return field.scalars.at("pressure")[k]; });
  }

  /// Lines at the given heights (none: three) and radii.
  ProfileOptions profileLines() const {
    ProfileOptions lines;
    const double d = context_.diameter;
    lines.axes = UpFrame(context_.facts.up.value_or(Vec3::UnitZ()));
    lines.step = knobs_.number("spacing") * d;
    lines.diameter = d;
    lines.lower = Vec3::Constant(std::numeric_limits<double>::infinity()), lines.upper = -lines.lower;
    for (const auto& x : nodes_)
      for (const double side : {-0.5, 0.5}) {
        const Vec3 corner = x + side * field_.spacing;
        const Vec3 at(corner.dot(lines.axes.e1), corner.dot(lines.axes.e2), corner.dot(lines.axes.up));
        lines.lower = lines.lower.cwiseMin(at), lines.upper = lines.upper.cwiseMax(at);
      }
    const Vec3 middle = 0.5 * (lines.lower + lines.upper);
    lines.axis = context_.facts.outletCentre.value_or(
        middle.x() * lines.axes.e1 + middle.y() * lines.axes.e2 + middle.z() * lines.axes.up);
    const std::string across = knobs_.text("across");
    if (across == "auto" && context_.facts.slot) lines.across = context_.facts.slot->across;
    if (across == "x" || across == "y" || across == "z") {
      Vec3 n = Vec3::Zero();
      n[across[0] - 'x'] = 1;
      n -= n.dot(lines.axes.up) * lines.axes.up;
      if (n.norm() < 1e-3)
        throw InputError(
            fmt::format("fields.across is {}, but that is the direction of up: choose another", across));
      lines.across = n.normalized();
    }
    for (const double h : knobs_.numbers("heights"))
      lines.heights.push_back(h * d);
    if (lines.heights.empty())
      for (const double share : {0.25, 0.5, 0.75})
        lines.heights.push_back(lines.lower.z() + share * (lines.upper.z() - lines.lower.z()));
    for (const double r : knobs_.numbers("radii"))
      lines.radii.push_back(r * d);
    return lines;
  }

  Parameters knobs_;
  AnalysisContext context_;
  Field field_;
  std::vector<Vec3> nodes_;
  std::vector<CoarseAverage> sum_;
  std::optional<FlowProfiles> profiles_;
  std::size_t frames_ = 0;
  bool contacts_ = false;
};

} // namespace

AnalysisKind fieldsKind() {
  const auto numbers = [](std::string name, std::vector<double> fallback, std::string description) {
    return ParameterSpec{.name = std::move(name),
                         .type = ParameterType::numbers,
                         .unit = "1",
                         .description = std::move(description),
                         .fallback = std::move(fallback)};
  };
  return {
      .name = "fields",
      .title = "Fields",
      .description =
          "coarse-grained density, velocity, granular temperature, stress, strain rate, vorticity; as VTK "
          "image data, and profiles",
      .source = "Goldhirsch 2010; Weinhart et al. 2012",
      .needs = {.quantities = {quantity::radius, quantity::velocity}, .grains = 1},
      .knobs =
          {numberKnob("width", 1, 0, 1000, "w of the kernel, in diameters; it ends at 2 w", true),
           numberKnob("spacing", 1, 0, 1000, "of the grid and of the profiles' stations, in diameters", true),
           numbers("heights", {},
                   "of the profiles across the flow, along up from the origin, in diameters; none: three"),
           numbers("radii", {0},
                   "of the profiles up the flow: distances from the axis (the outlet's, else the middle), in "
                   "diameters"),
           choiceKnob("across", "auto", {"auto", "axis", "x", "y", "z"},
                      "distances from the axis, or beside the plane through it with this normal; auto: "
                      "across a slot, else from the axis")},
      .make = [](const Parameters& knobs, const AnalysisContext& context) -> std::unique_ptr<Analysis> {
        return std::make_unique<FieldAnalysis>(knobs, context);
      }};
}

} // namespace sandglass::analysis
