#include "analysis/discharge.h"

#include "analysis/statistics.h"
#include "sim/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sandglass::analysis {

namespace {

/// Time at which the discharged mass first reaches `mass`; linear between samples.
double timeAt(const DischargeData& data, double mass) {
  for (std::size_t i = 1; i < data.mass.size(); ++i)
    if (data.mass[i] >= mass) {
      const double step = data.mass[i] - data.mass[i - 1];
      const double part = step > 0 ? std::clamp((mass - data.mass[i - 1]) / step, 0.0, 1.0) : 0;
      return data.time[i - 1] + part * (data.time[i] - data.time[i - 1]);
    }
  return data.time.back();
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

/// The even range as shares of the mass discharged; see the header.
std::pair<double, double> evenRange(const DischargeData& data, double first, double total) {
  const int parts = std::clamp(static_cast<int>(data.time.size() / 4), 8, 40);
  std::vector<double> rate(parts);
  double before = timeAt(data, first + 1e-9 * total);
  for (int k = 0; k < parts; ++k) {
    const double after = timeAt(data, first + total * (k + 1) / parts);
    rate[k] = total / parts / std::max(after - before, 1e-300);
    before = after;
  }
  const std::vector<double> middle(rate.begin() + parts / 5, rate.begin() + (3 * parts + 4) / 5);
  const double plateau = median(middle);
  std::vector<double> deviation;
  for (const double r : middle)
    deviation.push_back(std::abs(r - plateau));
  // 1.4826: median absolute deviation to standard deviation; sqrt 3: means of three.
  const double spread = 1.4826 * median(deviation) / std::sqrt(3.0);
  const double allowed = std::max(0.1 * plateau, 3 * spread);
  const auto even = [&](int k) {
    const int a = std::max(0, k - 1), b = std::min(parts - 1, k + 1);
    double sum = 0;
    for (int j = a; j <= b; ++j)
      sum += rate[j];
    return std::abs(sum / (b - a + 1) - plateau) <= allowed;
  };
  int centre = 2 * parts / 5;
  for (int k = parts / 5; k < 3 * parts / 5 && !even(centre); ++k)
    centre = k;
  // One outlier spoils three means, so only three in a row end the range.
  int low = centre, high = centre;
  for (int k = centre - 1; k >= 0 && low - k <= 3; --k)
    if (even(k)) low = k;
  for (int k = centre + 1; k < parts && k - high <= 3; ++k)
    if (even(k)) high = k;
  if (high - low >= 4) {
    ++low;
    --high;
  }
  return {static_cast<double>(low) / parts, static_cast<double>(high + 1) / parts};
}

} // namespace

DischargeFit fitDischarge(const DischargeData& data, const DischargeOptions& options) {
  const std::size_t samples = data.time.size();
  if (samples < 10)
    throw InputError(fmt::format(
        "a discharge rate needs at least 10 samples of the discharged mass, not {}: sample more often",
        samples));
  const double first = data.mass.front();
  const double discharged = *std::max_element(data.mass.begin(), data.mass.end()) - first;
  if (!(discharged > 0))
    throw InputError("nothing was discharged in these data, so there is no discharge rate");

  const double total = options.shares && options.totalMass > 0 ? options.totalMass : discharged;
  const auto [low, high] = options.shares ? *options.shares : evenRange(data, first, discharged);
  if (!(low >= 0 && low < high && high <= 1))
    throw InputError(fmt::format(
        "the range of the discharge fit is {} to {}, but must be ascending shares between 0 and 1", low,
        high));
  if (high * total > discharged * (1 + 1e-12))
    throw InputError(fmt::format("only {:.3g} of the mass was discharged, so its range {} to {} has no "
                                 "slope: run longer or choose a lower range",
                                 discharged / total, low, high));

  DischargeFit fit;
  fit.startTime = timeAt(data, first + low * total);
  fit.endTime = timeAt(data, first + high * total);
  std::vector<double> t, m;
  for (std::size_t i = 0; i < samples; ++i)
    if (data.time[i] >= fit.startTime && data.time[i] <= fit.endTime) {
      t.push_back(data.time[i]);
      m.push_back(data.mass[i]);
    }
  if (t.size() < 10)
    throw InputError(fmt::format("only {} samples lie in the even range of the discharge ({:.4g} s to {:.4g} "
                                 "s), but a slope with an error needs 10: sample more often",
                                 t.size(), fit.startTime, fit.endTime));
  const Line line = fitLine(t, m);
  fit.rate = line.slope;
  fit.intercept = line.intercept;
  fit.r2 = line.r2;
  fit.startMass = first + low * total;
  fit.endMass = first + high * total;

  std::vector<double> increments;
  for (std::size_t i = 1; i < t.size(); ++i)
    increments.push_back((m[i] - m[i - 1]) / (t[i] - t[i - 1]));
  const double tau = correlationTime(increments);
  const double n = static_cast<double>(t.size());
  fit.blocks = std::clamp(static_cast<int>(n / (10 * tau)), 5, 20);
  fit.blocks = std::max(2, std::min(fit.blocks, static_cast<int>(n / 4)));
  std::vector<double> slopes;
  for (int b = 0; b < fit.blocks; ++b) {
    // Neighbouring blocks share an end sample, so that no increment is lost.
    const auto from = static_cast<std::size_t>(b * (n - 1) / fit.blocks);
    const auto to = static_cast<std::size_t>((b + 1) * (n - 1) / fit.blocks);
    slopes.push_back(
        fitLine(std::span(t).subspan(from, to - from + 1), std::span(m).subspan(from, to - from + 1)).slope);
  }
  fit.standardError = std::sqrt(variance(slopes) / fit.blocks);
  fit.halfWidth = fit.standardError * studentFactor(options.confidence, fit.blocks - 1);
  return fit;
}

Curve dischargeCurve(const DischargeData& data, const DischargeFit& fit, const DischargeOptions& options) {
  Curve curve;
  curve.name = "discharge";
  curve.title = "Discharged mass";
  curve.definition = fmt::format(
      "slope by least squares over {} {:.4g} s to {:.4g} s; interval of {:g} % from {} blocks, Student t",
      options.shares ? fmt::format("{:g} to {:g} of the mass,", options.shares->first, options.shares->second)
                     : std::string("the even range found,"),
      fit.startTime, fit.endTime, 100 * options.confidence, fit.blocks);
  curve.x = {"time", "s"};
  curve.y = {"discharged mass", "kg"};
  curve.series.push_back({"discharged", data.time, data.mass, {}});
  curve.series.push_back({"fit",
                          {fit.startTime, fit.endTime},
                          {fit.intercept + fit.rate * fit.startTime, fit.intercept + fit.rate * fit.endTime},
                          {}});
  curve.marks = {{"start of range", fit.startTime, true}, {"end of range", fit.endTime, true}};
  curve.numbers = {{"rate", fit.rate},
                   {fmt::format("rate_error_{:g}", 100 * options.confidence), fit.halfWidth},
                   {"rate_standard_error", fit.standardError},
                   {"range_start", fit.startTime},
                   {"range_end", fit.endTime},
                   {"mass_start", fit.startMass},
                   {"mass_end", fit.endMass},
                   {"blocks", static_cast<double>(fit.blocks)},
                   {"r2", fit.r2}};
  if (options.depth > 0) {
    curve.numbers["depth"] = options.depth;
    curve.numbers["rate_per_depth"] = fit.rate / options.depth;
    curve.numbers[fmt::format("rate_per_depth_error_{:g}", 100 * options.confidence)] =
        fit.halfWidth / options.depth;
  }
  return curve;
}

} // namespace sandglass::analysis
