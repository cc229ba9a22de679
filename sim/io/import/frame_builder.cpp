#include "sim/io/import/frame_builder.h"

#include "sim/base/error.h"
#include "sim/io/import/column_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <tuple>

namespace sandglass {

namespace {

/// Volume of |x/a|.. as in GrainShape: 2 a b c e1 e2 B(e1/2 + 1, e1) B(e2/2, e2/2), from Jaklic, Leonardis
/// and Solina, "Segmentation and Recovery of Superquadrics" (2000), doi:10.1007/978-94-015-9456-1, eq. 2.60.
double shapeVolume(const GrainShape& s) {
  return 2 * s.semiAxes.prod() * s.e1 * s.e2 * std::beta(s.e1 / 2 + 1, s.e1) * std::beta(s.e2 / 2, s.e2 / 2);
}

class Builder {
public:
  Builder(RawFrame&& raw, std::size_t index, const ImportSettings& settings, const std::string& file,
          std::vector<std::string>& remarks)
      : raw_(std::move(raw)), index_(index), settings_(settings), file_(file), remarks_(remarks) {}

  Frame build() {
    for (const auto& remark : raw_.remarks)
      note(remark);
    frame_.time = importTime(raw_.time, raw_.step, index_, settings_);
    frame_.step = raw_.step.value_or(static_cast<std::int64_t>(index_));
    nameColumns();
    box();
    ids();
    positions();
    checkPositions();
    species();
    sizes();
    orientations();
    vectors();
    scalars();
    domain();
    sortById();
    return std::move(frame_);
  }

private:
  [[noreturn]] void fail(const std::string& sentence) const {
    throw InputError(fmt::format("{}: frame {}: {}", file_, index_, sentence));
  }
  [[noreturn]] void failAt(std::size_t row, const std::string& sentence) const {
    if (raw_.firstLine > 0) throw InputError(fmt::format("{}:{}: {}", file_, raw_.firstLine + row, sentence));
    fail(fmt::format("row {}: {}", row + 1, sentence));
  }
  void note(const std::string& remark) {
    if (std::find(remarks_.begin(), remarks_.end(), remark) == remarks_.end()) remarks_.push_back(remark);
  }

  void nameColumns() {
    for (auto& column : raw_.columns) {
      const std::string quantity = quantityOfColumn(column.name, settings_);
      if (quantity.empty() || column.numbers.size() != raw_.rows) continue;
      if (named_.contains(quantity)) // x and xu, type and element: the first counts
        named_.emplace(column.name, &column);
      else
        named_[quantity] = &column;
    }
    for (const auto& [quantity, column] : settings_.columns)
      if (!column.empty() && std::none_of(raw_.columns.begin(), raw_.columns.end(),
                                          [&name = column](const RawColumn& c) { return c.name == name; })) {
        std::string names;
        for (const auto& c : raw_.columns)
          names += (names.empty() ? "" : ", ") + c.name;
        fail(fmt::format("there is no column '{}', from which '{}' is to come; there are: {}", column,
                         quantity, names));
      }
  }

  /// A column of numbers, marked as used; null when there is none.
  const std::vector<double>* take(const std::string& quantity, bool finite = true) {
    const auto it = named_.find(quantity);
    if (it == named_.end()) return nullptr;
    const RawColumn& column = *it->second;
    named_.erase(it);
    if (!column.words.empty()) failAt(0, fmt::format("'{}' holds words, but numbers are due", column.name));
    if (finite)
      for (std::size_t k = 0; k < column.numbers.size(); ++k)
        if (!std::isfinite(column.numbers[k]))
          failAt(k, fmt::format("found {} in the column '{}', but a finite number is due", column.numbers[k],
                                column.name));
    return &column.numbers;
  }
  bool all(const std::string& base) const {
    return named_.contains(base + ".x") && named_.contains(base + ".y") && named_.contains(base + ".z");
  }
  std::vector<Vec3> triple(const std::string& base, double unit, bool finite = true) {
    std::vector<Vec3> values(raw_.rows);
    for (int k = 0; k < 3; ++k) {
      const auto* numbers = take(base + "." + "xyz"[k], finite);
      for (std::size_t i = 0; i < values.size(); ++i)
        values[i][k] = (*numbers)[i] * unit;
    }
    return values;
  }

  void box() {
    if (raw_.box) {
      const Domain& b = *raw_.box;
      if (!b.lower.allFinite() || !b.upper.allFinite() || !(b.lower.array() <= b.upper.array()).all())
        fail("its box has an upper end below the lower one, or ends that are no numbers");
      box_ = b;
      box_->lower *= settings_.length;
      box_->upper *= settings_.length;
    }
    if (settings_.lower) {
      if (!box_) box_.emplace();
      box_->lower = *settings_.lower;
      box_->upper = *settings_.upper;
    }
    if (!settings_.periodic) return;
    const auto& periodic = *settings_.periodic;
    if (!box_ && (periodic[0] || periodic[1] || periodic[2]))
      fail("directions are to repeat, but the file says no box: give one (--box, or [box] in the file of "
           "--columns)");
    if (box_) box_->periodic = periodic;
  }

  void ids() {
    frame_.id.resize(raw_.rows);
    std::iota(frame_.id.begin(), frame_.id.end(), std::int64_t{1});
    frame_.persistentIds = raw_.orderIsIdentity;
    const auto* numbers = take("id");
    if (!numbers) return;
    constexpr double most = 9007199254740992.0; // 2^53: up to here a double counts
    for (std::size_t k = 0; k < raw_.rows; ++k) {
      const double id = (*numbers)[k];
      if (id != std::floor(id) || std::abs(id) > most)
        failAt(k, fmt::format("found the id {}, but a whole number is due", id));
      frame_.id[k] = static_cast<std::int64_t>(id);
    }
    frame_.persistentIds = true;
  }

  void positions() {
    auto& x = frame_.position;
    x.resize(raw_.rows);
    for (int k = 0; k < 3; ++k) {
      const std::string axis(1, "xyz"[k]);
      if (const auto* numbers = take(axis)) {
        for (std::size_t i = 0; i < x.size(); ++i)
          x[i][k] = (*numbers)[i] * settings_.length;
        named_.erase(axis + "_scaled");
      } else if (const auto* scaled = take(axis + "_scaled")) {
        if (!box_) fail(fmt::format("positions are shares of a box along {}, but there is no box", axis));
        for (std::size_t i = 0; i < x.size(); ++i)
          x[i][k] = box_->lower[k] + (*scaled)[i] * (box_->upper[k] - box_->lower[k]);
      } else {
        std::string names;
        for (const auto& column : raw_.columns)
          names += (names.empty() ? "" : ", ") + column.name;
        fail(fmt::format("no column holds the position along {}; there are: {}; name it under [columns] in "
                         "the file of --columns",
                         axis, names));
      }
    }
  }

  void checkPositions() {
    for (std::size_t i = 0; i < frame_.position.size(); ++i)
      if (!frame_.position[i].allFinite())
        failAt(i, "found a position that is no finite number in metres; check the units and the box");
  }

  void species() {
    const auto it = named_.find("species");
    if (it == named_.end()) return;
    const RawColumn& column = *it->second;
    if (!column.words.empty()) {
      // The same word has the same number in every frame that holds the same set of words.
      std::vector<std::string> sorted = column.words;
      std::sort(sorted.begin(), sorted.end());
      std::vector<double> rank(column.words.size());
      for (std::size_t w = 0; w < rank.size(); ++w)
        rank[w] = static_cast<double>(std::lower_bound(sorted.begin(), sorted.end(), column.words[w]) -
                                      sorted.begin());
      auto& values = frame_.scalars[quantity::species];
      values.reserve(raw_.rows);
      for (const double word : column.numbers)
        values.push_back(rank[static_cast<std::size_t>(word)]);
      frame_.speciesNames = std::move(sorted);
      named_.erase(it);
      return;
    }
    const auto& numbers = *take("species");
    constexpr double most = 1000;
    double largest = 0;
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      if (numbers[k] != std::floor(numbers[k]) || numbers[k] < 0 || numbers[k] > most)
        failAt(k,
               fmt::format("found the species {}, but a whole number from 0 to {} is due; map the column to "
                           "another name with --columns",
                           numbers[k], most));
      largest = std::max(largest, numbers[k]);
    }
    // Types count from 1 in LAMMPS and LIGGGHTS; names keep the file's number.
    nameSpecies(numbers);
    const bool fromOne = std::find(numbers.begin(), numbers.end(), 0.0) == numbers.end() && !numbers.empty();
    for (int s = fromOne ? 1 : 0; s <= largest; ++s)
      frame_.speciesNames.push_back(elements_.contains(s) ? elements_[s] : std::to_string(s));
    auto& values = frame_.scalars[quantity::species] = numbers;
    if (fromOne)
      for (double& value : values)
        value -= 1;
  }

  /// Words beside the numbers (LAMMPS: element beside type) name them.
  void nameSpecies(const std::vector<double>& numbers) {
    const auto it = named_.find("element");
    if (it == named_.end() || it->second->words.empty()) return;
    for (std::size_t k = 0; k < numbers.size(); ++k)
      elements_.try_emplace(static_cast<int>(numbers[k]),
                            it->second->words[static_cast<std::size_t>(it->second->numbers[k])]);
  }

  void sizes() {
    shapes();
    const bool shaped = sized_;
    if (const auto* numbers = take("radius")) setRadii(*numbers, settings_.length, "radius", shaped);
    if (const auto* numbers = take("diameter")) setRadii(*numbers, settings_.length / 2, "diameter", shaped);
    if (!sized_) suppliedRadii();
    if (sized_) frame_.scalars[quantity::radius] = std::move(radius_);
    if (const auto* numbers = take("mass")) {
      auto& mass = frame_.scalars[quantity::mass] = *numbers;
      for (double& m : mass)
        m *= settings_.mass;
    }
  }
  /// Grains of other shapes keep the radius of their volume; what the file calls radius is kept beside it.
  void setRadii(const std::vector<double>& numbers, double unit, const char* what, bool fromShapes) {
    if (!fromShapes && sized_) return; // radius and diameter: the first counts
    std::vector<double> radius(numbers.size());
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      radius[k] = numbers[k] * unit;
      if (!(numbers[k] > 0))
        failAt(k, fmt::format("found the {} {}, but a size is above 0", what, numbers[k]));
    }
    if (fromShapes && same(radius)) return;
    if (fromShapes)
      frame_.scalars["file_radius"] = std::move(radius);
    else
      radius_ = std::move(radius);
    sized_ = true;
  }
  bool same(const std::vector<double>& radius) const {
    constexpr double rounding = 1e-9;
    for (std::size_t k = 0; k < radius.size(); ++k)
      if (std::abs(radius[k] - radius_[k]) > rounding * radius_[k]) return false;
    return true;
  }
  void suppliedRadii() {
    if (!settings_.radiusOf.empty()) {
      const auto it = frame_.scalars.find(quantity::species);
      if (it == frame_.scalars.end()) fail("radii are given by species, but no column holds the species");
      for (const double s : it->second) {
        const auto& name = frame_.speciesNames[static_cast<std::size_t>(s)];
        const auto radius = settings_.radiusOf.find(name);
        if (radius == settings_.radiusOf.end() && !settings_.radius)
          fail(fmt::format("no radius is given for the species '{}'", name));
        radius_.push_back(radius == settings_.radiusOf.end() ? *settings_.radius : radius->second);
      }
      sized_ = true;
    } else if (settings_.radius) {
      radius_.assign(raw_.rows, *settings_.radius);
      sized_ = true;
    } else {
      note("the file holds no radii; give one with --radius, or by species in the file of --columns");
    }
  }

  void shapes() {
    std::vector<Vec3> axes;
    if (all("shape"))
      axes = triple("shape", settings_.length);
    else if (all("shape_diameter"))
      axes = triple("shape_diameter", settings_.length / 2);
    else if (all("shape_unknown")) {
      // LIGGGHTS' own columns are semi-axes and come with quat1 or blockiness1; LAMMPS computes whole axes.
      bool liggghts = false;
      for (const auto& column : raw_.columns)
        liggghts =
            liggghts || column.name == "quat1" || column.name == "blockiness1" || column.name == "roundness1";
      const bool semi = settings_.shape.empty() ? liggghts : settings_.shape == "semi-axes";
      if (settings_.shape.empty())
        note(
            fmt::format("shapex, shapey and shapez are taken for {}; [grains] shape in the file of --columns "
                        "says otherwise",
                        semi ? "semi-axes, as LIGGGHTS writes them" : "whole axes, as LAMMPS writes them"));
      axes = triple("shape_unknown", semi ? settings_.length : settings_.length / 2);
    }
    const auto exponent = [&](const char* e, const char* n) {
      std::vector<double> values(raw_.rows, 1.0);
      if (const auto* given = take(e))
        values = *given;
      else if (const auto* blockiness = take(n))
        for (std::size_t k = 0; k < values.size(); ++k)
          values[k] = 2 / (*blockiness)[k];
      return values;
    };
    const std::vector<double> e1 = exponent("e1", "blockiness1"), e2 = exponent("e2", "blockiness2");
    if (axes.empty()) return; // no shapes, or no grains
    std::map<std::tuple<double, double, double, double, double>, double> known;
    std::vector<double> number(raw_.rows);
    radius_.resize(raw_.rows);
    sized_ = true;
    bool anyShape = false;
    for (std::size_t k = 0; k < raw_.rows; ++k) {
      const GrainShape shape{axes[k], e1[k], e2[k]};
      if (!(axes[k].minCoeff() > 0))
        failAt(k, fmt::format("found the semi-axes {} {} {}, but all are above 0", axes[k].x(), axes[k].y(),
                              axes[k].z()));
      if (!(shape.e1 > 0 && shape.e1 <= 2 && shape.e2 > 0 && shape.e2 <= 2))
        failAt(k, fmt::format("found a shape with the exponents {} and {}, but those of a convex grain are "
                              "above 0 and at most 2 (blockiness at least 1)",
                              shape.e1, shape.e2));
      radius_[k] = std::cbrt(shapeVolume(shape) * 3 / (4 * std::numbers::pi));
      if (!(radius_[k] > 0 && std::isfinite(radius_[k])))
        failAt(k, "its shape has no volume that can be told");
      const bool sphere =
          shape.e1 == 1 && shape.e2 == 1 && axes[k].x() == axes[k].y() && axes[k].y() == axes[k].z();
      if (sphere) radius_[k] = axes[k].x();
      anyShape = anyShape || !sphere;
      const auto next = static_cast<double>(frame_.shapes.size());
      const auto [it, fresh] =
          sphere ? std::pair(known.end(), false)
                 : known.try_emplace({axes[k].x(), axes[k].y(), axes[k].z(), shape.e1, shape.e2}, next);
      if (fresh) frame_.shapes.push_back(shape);
      number[k] = sphere ? -1 : it->second;
    }
    if (anyShape) frame_.scalars[quantity::shape] = std::move(number);
  }

  void orientations() {
    if (!all(quantity::orientation) || !named_.contains("orientation.w")) return;
    const auto& w = *take("orientation.w");
    const auto v = triple(quantity::orientation, 1);
    for (std::size_t k = 0; k < raw_.rows; ++k) {
      Eigen::Quaterniond q(w[k], v[k].x(), v[k].y(), v[k].z());
      const double norm = q.norm();
      // Six digits as text leave 1e-5 or so; far from 1 it is another convention or no quaternion.
      if (!(std::abs(norm - 1) < 0.01))
        failAt(k,
               fmt::format("found an orientation of length {}, but a quaternion of length 1 is due", norm));
      frame_.orientation.push_back(q.normalized());
    }
  }

  void vectors() {
    const double l = settings_.length, t = settings_.time, m = settings_.mass;
    const std::map<std::string, double> units{{quantity::velocity, l / t},
                                              {quantity::spin, 1 / t},
                                              {quantity::force, m * l / (t * t)},
                                              {"torque", m * l * l / (t * t)}};
    std::vector<std::string> bases;
    for (const auto& [name, column] : named_)
      if (name.size() > 2 && name.ends_with(".x")) bases.push_back(name.substr(0, name.size() - 2));
    for (const auto& base : bases) {
      if (!all(base)) continue;
      const bool words = !named_[base + ".x"]->words.empty() || !named_[base + ".y"]->words.empty() ||
                         !named_[base + ".z"]->words.empty();
      if (words) continue;
      const auto unit = units.find(base);
      frame_.vectors[base] = triple(base, unit == units.end() ? 1 : unit->second, unit != units.end());
    }
  }

  void scalars() {
    for (const char* used : {"time", "step"})
      named_.erase(used);
    for (const auto& [name, column] : named_)
      if (column->words.empty() && !frame_.scalars.contains(name)) frame_.scalars[name] = column->numbers;
  }

  void domain() {
    frame_.domain = box_.value_or(Domain{});
    auto& d = frame_.domain;
    const auto& x = frame_.position;
    for (int k = 0; k < 3; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      const double period = d.upper[k] - d.lower[k];
      if (d.periodic[axis]) {
        if (!(period > 0)) fail(fmt::format("its box repeats along {} but has no extent there", "xyz"[k]));
        constexpr double mostPeriods = 1e9; // farther away the place in the box is rounding
        for (std::size_t i = 0; i < frame_.position.size(); ++i) { // dumps may lag behind, or be unwrapped
          double& p = frame_.position[i][k];
          const double shift = std::floor((p - d.lower[k]) / period);
          if (!(std::abs(shift) < mostPeriods))
            failAt(i, fmt::format("found a grain at {} along {}, farther than {} periods from its box", p,
                                  "xyz"[k], mostPeriods));
          if (shift != 0) p -= shift * period;
          if (!(p >= d.lower[k] && p < d.upper[k])) p = d.lower[k];
        }
      } else if (!box_ && !x.empty()) {
        d.lower[k] = d.upper[k] = x[0][k];
        const auto r = frame_.scalars.find(quantity::radius);
        for (std::size_t i = 0; i < x.size(); ++i) {
          const double half = r == frame_.scalars.end() ? 0 : r->second[i];
          d.lower[k] = std::min(d.lower[k], x[i][k] - half);
          d.upper[k] = std::max(d.upper[k], x[i][k] + half);
        }
      }
    }
  }

  void sortById() {
    auto& id = frame_.id;
    if (!std::is_sorted(id.begin(), id.end())) {
      std::vector<std::size_t> order(id.size());
      std::iota(order.begin(), order.end(), std::size_t{0});
      std::stable_sort(order.begin(), order.end(),
                       [&](std::size_t a, std::size_t b) { return id[a] < id[b]; });
      const auto permute = [&](auto& values) {
        auto sorted = values;
        for (std::size_t k = 0; k < order.size(); ++k)
          sorted[k] = values[order[k]];
        values = std::move(sorted);
      };
      permute(id);
      permute(frame_.position);
      if (!frame_.orientation.empty()) permute(frame_.orientation);
      for (auto& [name, values] : frame_.scalars)
        permute(values);
      for (auto& [name, values] : frame_.vectors)
        permute(values);
    }
    const auto twice = std::adjacent_find(id.begin(), id.end());
    if (twice != id.end())
      fail(fmt::format("the id {} occurs twice; if the column does not tell grains apart, leave it out with "
                       "id = \"\" under [columns] in the file of --columns",
                       *twice));
  }

  RawFrame raw_;
  std::size_t index_;
  const ImportSettings& settings_;
  const std::string& file_;
  std::vector<std::string>& remarks_;
  Frame frame_;
  std::optional<Domain> box_;
  std::map<std::string, const RawColumn*> named_;
  std::map<int, std::string> elements_; ///< names of species by number
  std::vector<double> radius_;
  bool sized_ = false; ///< radius_ is known, if only of no grain
};

} // namespace

bool timeIsKnown(const std::optional<double>& time, const std::optional<std::int64_t>& step,
                 const ImportSettings& settings) {
  return time || (step && settings.timeStep) || settings.frameInterval;
}

double importTime(const std::optional<double>& time, const std::optional<std::int64_t>& step,
                  std::size_t index, const ImportSettings& settings) {
  if (time) return *time * settings.time;
  if (step && settings.timeStep) return static_cast<double>(*step) * *settings.timeStep;
  if (settings.frameInterval) return static_cast<double>(index) * *settings.frameInterval;
  return step ? static_cast<double>(*step) : static_cast<double>(index);
}

Frame buildFrame(RawFrame&& raw, std::size_t index, const ImportSettings& settings, const std::string& file,
                 std::vector<std::string>& remarks) {
  return Builder(std::move(raw), index, settings, file, remarks).build();
}

} // namespace sandglass
