#include "sim/io/import/frame_builder.h"

#include "sim/base/error.h"
#include "sim/io/import/column_set.h"
#include "sim/io/import/frame_domain.h"
#include "sim/io/import/frame_order.h"
#include "sim/io/import/grain_shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sandglass {

namespace {

class Builder {
public:
  Builder(const RawFrame& raw, std::size_t index, const ImportSettings& settings, const std::string& file,
          std::vector<std::string>& remarks)
      : raw_(raw), settings_(settings), place_{file, index, raw.firstLine}, remarks_(remarks),
        columns_(raw, settings, place_) {}

  Frame build() {
    for (const auto& remark : raw_.remarks)
      note(remark);
    frame_.time = importTime(raw_.time, raw_.step, place_.index, settings_);
    frame_.step = raw_.step.value_or(static_cast<std::int64_t>(place_.index));
    box();
    ids();
    positions();
    species();
    sizes();
    takeOrientations(columns_, place_, frame_);
    vectors();
    scalars();
    fitDomain(frame_, box_, place_);
    sortById();
    return std::move(frame_);
  }

private:
  void note(const std::string& remark) {
    if (std::find(remarks_.begin(), remarks_.end(), remark) == remarks_.end()) remarks_.push_back(remark);
  }

  void box() {
    if (raw_.box) {
      const Domain& b = *raw_.box;
      if (!b.lower.allFinite() || !b.upper.allFinite() || !(b.lower.array() <= b.upper.array()).all())
        place_.fail("its box has an upper end below the lower one, or ends that are no numbers");
      box_ = b;
      box_->lower *= settings_.length;
      box_->upper *= settings_.length;
      tilt_ = raw_.tilt * settings_.length;
    }
    if (settings_.lower) {
      if (!box_) box_.emplace();
      box_->lower = *settings_.lower;
      box_->upper = *settings_.upper;
      tilt_ = Vec3::Zero(); // the user's box is upright
    }
    if (!settings_.periodic) return;
    const auto& periodic = *settings_.periodic;
    if (!box_ && (periodic[0] || periodic[1] || periodic[2]))
      place_.fail("directions are to repeat, but the file says no box: give one (--box, or [box] in the file "
                  "of --columns)");
    if (box_) box_->periodic = periodic;
  }

  void ids() {
    frame_.id.resize(raw_.rows);
    std::iota(frame_.id.begin(), frame_.id.end(), std::int64_t{1});
    frame_.persistentIds = raw_.orderIsIdentity;
    const auto* numbers = columns_.take("id");
    if (!numbers) return;
    constexpr double most = 9007199254740992.0; // 2^53: up to here a double counts
    for (std::size_t k = 0; k < raw_.rows; ++k) {
      const double id = (*numbers)[k];
      if (id != std::floor(id) || std::abs(id) > most)
        place_.failAt(k, fmt::format("found the id {}, but a whole number is due", id));
      frame_.id[k] = static_cast<std::int64_t>(id);
    }
    frame_.persistentIds = true;
  }

  void positions() {
    auto& x = frame_.position;
    x.assign(raw_.rows, Vec3::Zero());
    const auto& tilt = raw_.tilt; // (xy, xz, yz) of the file's own box, which shares are of
    for (int k = 0; k < 3; ++k) {
      const std::string axis(1, "xyz"[k]);
      if (const auto* numbers = columns_.take(axis)) {
        for (std::size_t i = 0; i < x.size(); ++i)
          x[i][k] += (*numbers)[i] * settings_.length;
        columns_.drop(axis + "_scaled");
      } else if (const auto* scaled = columns_.take(axis + "_scaled")) {
        if (!box_)
          place_.fail(fmt::format("positions are shares of a box along {}, but there is no box", axis));
        for (std::size_t i = 0; i < x.size(); ++i) {
          x[i][k] += box_->lower[k] + (*scaled)[i] * (box_->upper[k] - box_->lower[k]);
          if (k == 1) x[i][0] += (*scaled)[i] * tilt[0] * settings_.length;
          if (k == 2) x[i] += (*scaled)[i] * Vec3(tilt[1], tilt[2], 0) * settings_.length;
        }
      } else {
        place_.fail(
            fmt::format("no column holds the position along {}; there are: {}; name it under [columns] "
                        "in the file of --columns",
                        axis, columns_.names()));
      }
    }
    for (std::size_t i = 0; i < x.size(); ++i)
      if (!x[i].allFinite())
        place_.failAt(i, "found a position that is no finite number in metres; check the units and the box");
    if (tilt_.isZero(0) || !box_) return;
    if (const std::string lost = straighten(x, *box_, tilt_, place_); !lost.empty()) note(lost);
  }

  void species() {
    const RawColumn* column = columns_.find("species");
    if (!column) return;
    if (column->words.empty()) {
      numberedSpecies(*columns_.take("species"));
      return;
    }
    // The same word has the same number in every frame that holds the same set of words.
    std::vector<std::string> sorted = column->words;
    std::sort(sorted.begin(), sorted.end());
    std::vector<double> rank;
    for (const auto& word : column->words)
      rank.push_back(
          static_cast<double>(std::lower_bound(sorted.begin(), sorted.end(), word) - sorted.begin()));
    auto& values = frame_.scalars[quantity::species];
    values.reserve(raw_.rows);
    for (const double word : column->numbers)
      values.push_back(rank[static_cast<std::size_t>(word)]);
    frame_.speciesNames = std::move(sorted);
    columns_.drop("species");
  }

  void numberedSpecies(const std::vector<double>& numbers) {
    constexpr double most = 1000;
    double largest = 0;
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      if (numbers[k] != std::floor(numbers[k]) || numbers[k] < 0 || numbers[k] > most)
        place_.failAt(k, fmt::format("found the species {}, but a whole number from 0 to {} is due; map the "
                                     "column to another name with --columns",
                                     numbers[k], most));
      largest = std::max(largest, numbers[k]);
    }
    // Words beside the numbers (LAMMPS: element beside type) name them.
    std::map<int, std::string> elements;
    if (const RawColumn* words = columns_.find("element"); words && !words->words.empty())
      for (std::size_t k = 0; k < numbers.size(); ++k)
        elements.try_emplace(static_cast<int>(numbers[k]),
                             words->words[static_cast<std::size_t>(words->numbers[k])]);
    // Types count from 1 in LAMMPS and LIGGGHTS; names keep the file's number.
    const bool fromOne = std::find(numbers.begin(), numbers.end(), 0.0) == numbers.end() && !numbers.empty();
    for (int s = fromOne ? 1 : 0; s <= largest; ++s)
      frame_.speciesNames.push_back(elements.contains(s) ? elements[s] : std::to_string(s));
    auto& values = frame_.scalars[quantity::species] = numbers;
    if (fromOne)
      for (double& value : values)
        value -= 1;
  }

  void sizes() {
    std::vector<std::string> notes;
    radius_ = takeShapes(columns_, raw_, settings_, place_, frame_, notes);
    for (const auto& remark : notes)
      note(remark);
    const bool shaped = sized_ = !radius_.empty();
    if (const auto* numbers = columns_.take("radius")) setRadii(*numbers, settings_.length, "radius", shaped);
    if (const auto* numbers = columns_.take("diameter"))
      setRadii(*numbers, settings_.length / 2, "diameter", shaped);
    if (!sized_) suppliedRadii();
    if (sized_) frame_.scalars[quantity::radius] = std::move(radius_);
    if (const auto* numbers = columns_.take("mass")) {
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
        place_.failAt(k, fmt::format("found the {} {}, but a size is above 0", what, numbers[k]));
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
      if (it == frame_.scalars.end())
        place_.fail("radii are given by species, but no column holds the species");
      for (const double s : it->second) {
        const auto& name = frame_.speciesNames[static_cast<std::size_t>(s)];
        const auto radius = settings_.radiusOf.find(name);
        if (radius == settings_.radiusOf.end() && !settings_.radius)
          place_.fail(fmt::format("no radius is given for the species '{}'", name));
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

  void vectors() {
    const double l = settings_.length, t = settings_.time, m = settings_.mass;
    const std::map<std::string, double> units{{quantity::velocity, l / t},
                                              {quantity::spin, 1 / t},
                                              {quantity::force, m * l / (t * t)},
                                              {"torque", m * l * l / (t * t)}};
    constexpr const char* axes[] = {".x", ".y", ".z"};
    std::vector<std::string> bases;
    for (const auto& [name, column] : columns_.rest())
      if (name.size() > 2 && name.ends_with(".x")) bases.push_back(name.substr(0, name.size() - 2));
    for (const auto& base : bases) {
      if (!columns_.hasTriple(base)) continue;
      const bool words = std::any_of(std::begin(axes), std::end(axes), [&](const char* axis) {
        return !columns_.find(base + axis)->words.empty();
      });
      if (words) continue;
      const auto unit = units.find(base);
      frame_.vectors[base] =
          columns_.takeTriple(base, unit == units.end() ? 1 : unit->second, unit != units.end());
    }
  }

  void scalars() {
    for (const char* used : {"time", "step"})
      columns_.drop(used);
    for (const auto& [name, column] : columns_.rest())
      if (column->words.empty() && !frame_.scalars.contains(name)) frame_.scalars[name] = column->numbers;
  }

  void sortById() {
    if (const auto twice = sandglass::sortById(frame_))
      place_.fail(
          fmt::format("the id {} occurs twice; if the column does not tell grains apart, leave it out "
                      "with id = \"\" under [columns] in the file of --columns",
                      *twice));
  }

  const RawFrame& raw_;
  const ImportSettings& settings_;
  const FramePlace place_;
  std::vector<std::string>& remarks_;
  ColumnSet columns_;
  Frame frame_;
  std::optional<Domain> box_;
  Vec3 tilt_ = Vec3::Zero(); ///< [m]
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

Frame buildFrame(const RawFrame& raw, std::size_t index, const ImportSettings& settings,
                 const std::string& file, std::vector<std::string>& remarks) {
  return Builder(raw, index, settings, file, remarks).build();
}

} // namespace sandglass
