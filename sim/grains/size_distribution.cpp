#include "sim/grains/size_distribution.h"

#include "sim/base/error.h"

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sandglass {

namespace {

// A distribution "by mass" says which share of the mass has which diameter; the share of the grains is that
// divided by d^3. Everything below works with shares of grains.

class Single final : public SizeDistribution {
public:
  explicit Single(double diameter) : diameter_(diameter) {}
  double smallest() const override { return diameter_; }
  double largest() const override { return diameter_; }
  double draw(RandomStream&) const override { return diameter_; }
  double mean() const override { return diameter_; }
  double meanCube() const override { return diameter_ * diameter_ * diameter_; }

private:
  double diameter_;
};

/// A density over [smallest, largest]; moments by quadrature, computed once.
class Continuous : public SizeDistribution {
public:
  double smallest() const override { return smallest_; }
  double largest() const override { return largest_; }
  double mean() const override { return mean_; }
  double meanCube() const override { return meanCube_; }

protected:
  Continuous(double smallest, double largest) : smallest_(smallest), largest_(largest) {}

  /// `density`: of grains, need not be normalised.
  template <class F> void computeMoments(F density) {
    const auto integral = [&](int power) {
      // Pieces keep a narrow peak in a wide interval from slipping between the nodes.
      constexpr int pieces = 32;
      double sum = 0;
      for (int i = 0; i < pieces; ++i) {
        const double a = std::lerp(smallest_, largest_, i / double(pieces));
        const double b = std::lerp(smallest_, largest_, (i + 1) / double(pieces));
        sum += boost::math::quadrature::gauss_kronrod<double, 15>::integrate(
            [&](double d) { return density(d) * std::pow(d / largest_, power); }, a, b, 0);
      }
      return sum;
    };
    const double all = integral(0);
    mean_ = integral(1) / all * largest_;
    meanCube_ = integral(3) / all * largest_ * largest_ * largest_;
  }

  double smallest_, largest_, mean_ = 0, meanCube_ = 0;
};

class Uniform final : public Continuous {
public:
  Uniform(double smallest, double largest, bool byMass) : Continuous(smallest, largest), byMass_(byMass) {
    computeMoments([&](double d) { return byMass ? 1 / (d * d * d) : 1.0; });
  }
  double draw(RandomStream& random) const override {
    const double u = random.uniform();
    if (!byMass_) return std::lerp(smallest_, largest_, u);
    // Grains ~ d^-3: the cumulative share (a^-2 - d^-2)/(a^-2 - b^-2) solved for d.
    const double a = 1 / (smallest_ * smallest_), b = 1 / (largest_ * largest_);
    return std::clamp(1 / std::sqrt(a - u * (a - b)), smallest_, largest_);
  }

private:
  bool byMass_;
};

/// Normal in d, or in ln d; cut at both ends.
class Bell final : public Continuous {
public:
  /// `centre`, `deviation` of d, or of ln d when `logarithmic`.
  Bell(double centre, double deviation, double smallest, double largest, bool logarithmic, bool byMass)
      : Continuous(smallest, largest), centre_(centre), deviation_(deviation), logarithmic_(logarithmic) {
    // By mass in ln d: dividing by d^3 = exp(3 ln d) shifts the centre by -3 deviation^2, exactly.
    if (logarithmic && byMass) centre_ -= 3 * deviation * deviation;
    thinByCube_ = byMass && !logarithmic;
    computeMoments([&](double d) {
      const double x = ((logarithmic_ ? std::log(d) : d) - centre_) / deviation_;
      return std::exp(-x * x / 2) / (logarithmic_ ? d : 1.0) / (thinByCube_ ? d * d * d : 1.0);
    });
  }

  double draw(RandomStream& random) const override {
    for (int tries = 0; tries < mostTries; ++tries) {
      const double x = centre_ + deviation_ * random.normal();
      const double d = logarithmic_ ? std::exp(x) : x;
      if (d < smallest_ || d > largest_) continue;
      if (thinByCube_ && random.uniform() > std::pow(smallest_ / d, 3)) continue;
      return d;
    }
    throw InputError("the size distribution hardly reaches into the span between its smallest and largest "
                     "diameter; widen that span");
  }

private:
  static constexpr int mostTries = 1'000'000;
  double centre_, deviation_;
  bool logarithmic_, thinByCube_ = false;
};

class Table final : public SizeDistribution {
public:
  Table(std::vector<double> diameters, std::vector<double> shares, bool byMass)
      : diameters_(std::move(diameters)), cumulative_(std::move(shares)) {
    double all = 0, first = 0, cube = 0;
    for (std::size_t i = 0; i < diameters_.size(); ++i) {
      const double d = diameters_[i], d3 = d * d * d;
      const double share = byMass ? cumulative_[i] / d3 : cumulative_[i];
      all += share;
      first += share * d;
      cube += share * d3;
      cumulative_[i] = all;
    }
    for (double& c : cumulative_)
      c /= all;
    mean_ = first / all;
    meanCube_ = cube / all;
  }
  double smallest() const override { return *std::min_element(diameters_.begin(), diameters_.end()); }
  double largest() const override { return *std::max_element(diameters_.begin(), diameters_.end()); }
  double mean() const override { return mean_; }
  double meanCube() const override { return meanCube_; }
  double draw(RandomStream& random) const override {
    const auto at = std::lower_bound(cumulative_.begin(), cumulative_.end(), random.uniform());
    const auto last = static_cast<std::ptrdiff_t>(diameters_.size()) - 1;
    return diameters_[static_cast<std::size_t>(std::min(at - cumulative_.begin(), last))];
  }

private:
  std::vector<double> diameters_, cumulative_;
  double mean_ = 0, meanCube_ = 0;
};

ParameterSpec diameter(std::string name, std::string description, bool optional = false) {
  return {.name = std::move(name),
          .type = ParameterType::number,
          .unit = "m",
          .description = std::move(description),
          .optional = optional,
          .minimum = 0,
          .openMinimum = true};
}

const ParameterSpec weighed{.name = "by",
                            .type = ParameterType::text,
                            .unit = "1",
                            .description = "whether shares are of the number or of the mass of grains",
                            .fallback = std::string("number"),
                            .choices = {"number", "mass"}};

bool byMass(const Parameters& p) {
  return p.text("by") == "mass";
}

std::pair<double, double> span(const Parameters& p, double smallest, double largest) {
  const double low = p.number("smallest", smallest), high = p.number("largest", largest);
  if (low <= 0)
    throw InputError(
        "it reaches diameters of 0 and less at three deviations below the mean; give 'smallest'");
  if (!(low < high))
    throw InputError(fmt::format("the smallest diameter ({} m) is not below the largest ({} m)", low, high));
  return {low, high};
}

/// The span must hold a fair part of the bell, or drawing from it takes forever.
void checkReach(double centre, double deviation, double low, double high) {
  const double below = std::erf((low - centre) / deviation / std::sqrt(2.0));
  const double above = std::erf((high - centre) / deviation / std::sqrt(2.0));
  if (0.5 * (above - below) < 0.01)
    throw InputError("it has less than 1 % of its grains between 'smallest' and 'largest'; widen that span");
}

std::unique_ptr<const SizeDistribution> makeNormal(const Parameters& p) {
  const double mean = p.number("mean"), deviation = p.number("deviation");
  const auto [low, high] = span(p, mean - 3 * deviation, mean + 3 * deviation);
  checkReach(mean, deviation, low, high);
  return std::make_unique<Bell>(mean, deviation, low, high, false, byMass(p));
}

std::unique_ptr<const SizeDistribution> makeLognormal(const Parameters& p) {
  const double median = p.number("median"), sigma = p.number("sigma");
  const auto [low, high] = span(p, median * std::exp(-3 * sigma), median * std::exp(3 * sigma));
  const double centre = std::log(median) - (byMass(p) ? 3 * sigma * sigma : 0);
  checkReach(centre, sigma, std::log(low), std::log(high));
  return std::make_unique<Bell>(std::log(median), sigma, low, high, true, byMass(p));
}

std::unique_ptr<const SizeDistribution> makeTable(const Parameters& p) {
  const auto& diameters = p.numbers("diameters");
  const auto& shares = p.numbers("shares");
  if (diameters.empty()) throw InputError("the list of diameters is empty; give at least one");
  if (diameters.size() != shares.size())
    throw InputError(fmt::format("there are {} diameters but {} shares; give one share for each diameter",
                                 diameters.size(), shares.size()));
  if (std::accumulate(shares.begin(), shares.end(), 0.0) <= 0)
    throw InputError("the shares sum to 0; at least one must be above 0");
  return std::make_unique<Table>(diameters, shares, byMass(p));
}

} // namespace

const std::vector<SizeKind>& sizeKinds() {
  static const std::vector<SizeKind> kinds{
      {"single",
       "all grains alike",
       {diameter("diameter", "diameter of every grain")},
       [](const Parameters& p) { return std::make_unique<Single>(p.number("diameter")); }},
      {"uniform",
       "evenly between two diameters",
       {diameter("smallest", "smallest diameter"), diameter("largest", "largest diameter"), weighed},
       [](const Parameters& p) {
         const auto [low, high] = span(p, 0, 0);
         return std::make_unique<Uniform>(low, high, byMass(p));
       }},
      {"normal",
       "normal, cut at 'smallest' and 'largest' (three deviations from the mean unless given)",
       {diameter("mean", "mean diameter before the cut"),
        diameter("deviation", "standard deviation before the cut"), diameter("smallest", "lower cut", true),
        diameter("largest", "upper cut", true), weighed},
       makeNormal},
      {"lognormal",
       "lognormal, cut at 'smallest' and 'largest' (three sigma from the median unless given)",
       {diameter("median", "median diameter before the cut"),
        {.name = "sigma",
         .type = ParameterType::number,
         .unit = "1",
         .description = "standard deviation of ln d",
         .minimum = 0,
         .maximum = 2,
         .openMinimum = true},
        diameter("smallest", "lower cut", true),
        diameter("largest", "upper cut", true),
        weighed},
       makeLognormal},
      {"table",
       "listed diameters with their shares",
       {{.name = "diameters",
         .type = ParameterType::numbers,
         .unit = "m",
         .description = "the diameters",
         .minimum = 0,
         .openMinimum = true},
        {.name = "shares",
         .type = ParameterType::numbers,
         .unit = "1",
         .description = "share of each, in any scale",
         .minimum = 0},
        weighed},
       makeTable},
  };
  return kinds;
}

std::unique_ptr<const SizeDistribution> makeSizeDistribution(const std::string& kind,
                                                             const Parameters& parameters) {
  for (const auto& k : sizeKinds())
    if (k.name == kind) return k.make(parameters);
  throw InputError(fmt::format("there is no size distribution '{}'", kind));
}

} // namespace sandglass
