#include "tests/bench/core_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace sandglass::bench {

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

std::string csv(const std::vector<Timing>& timings) {
  std::string text =
      "case,program,threads,precision,grains,steps,cpu_s,wall_s,grain_steps_per_cpu_s,bytes_per_"
      "grain,check,round,cycles_per_contact\n";
  const auto number = [](double value, const char* form) {
    return value > 0 ? fmt::format(fmt::runtime(form), value) : std::string();
  };
  for (const Timing& t : timings) {
    if (t.wallSeconds <= 0) { // a program that is not there
      text += fmt::format("{},{},,,,,,,,,{},,\n", t.benchCase, t.program, t.check);
      continue;
    }
    std::string check = t.check;
    if (t.kineticEnergy >= 0)
      check = fmt::format("{}{}E300={:.10g}", check, check.empty() ? "" : " ", t.kineticEnergy);
    text +=
        fmt::format("{},{},{},{},{},{},{:.4f},{:.4f},{:.5g},{},{},{},{}\n", t.benchCase, t.program, t.threads,
                    t.precision, t.grains, t.steps, t.cpuSeconds, t.wallSeconds,
                    static_cast<double>(t.grains) * static_cast<double>(t.steps) / t.cpuSeconds,
                    number(t.bytesPerGrain, "{:.0f}"), check, t.round, number(t.cyclesPerContact, "{:.1f}"));
  }
  return text;
}

namespace {

using Key = std::tuple<std::string, std::string, std::string, int>; // case, program, precision, threads

Key keyOf(const Timing& t) {
  return {t.benchCase, t.program, t.precision, t.threads};
}

/// What one case costs beside another, ours on one thread; medians of either, since they do not run in the
/// same minutes.
std::string acrossCases(const std::vector<Timing>& timings) {
  const auto rate = [&](const char* name) {
    std::vector<double> rates;
    for (const Timing& t : timings)
      if (t.benchCase == name && t.program == "sandglass" && t.precision == "double" && t.threads == 1)
        rates.push_back(t.rate());
    return median(rates);
  };
  std::string text;
  const auto add = [&](const char* what, const char* above, const char* below) {
    const double a = rate(above), b = rate(below);
    if (a > 0 && b > 0) text += fmt::format("- {}: {:.2f}\n", what, a / b);
  };
  add("frictionless over frictional, 10^4 grains", "bed_1e4_frictionless", "bed_1e4");
  add("frictionless over frictional, 10^5 grains", "bed_1e5_frictionless", "bed_1e5");
  add("cost of a grain-step at 10^6 grains over that at 10^4", "bed_1e4", "bed_1e6");
  return text.empty() ? text : "\nOurs, one thread, double:\n\n" + text;
}

} // namespace

std::string summary(const std::vector<Timing>& timings) {
  std::string text =
      "| case | program | precision | threads | grains | million grain-steps per second (lowest to "
      "highest) | times LAMMPS | times LIGGGHTS | times Yade | times one thread | cycles per contact | bytes "
      "per grain |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  std::vector<Key> order;
  for (const Timing& t : timings)
    if (std::find(order.begin(), order.end(), keyOf(t)) == order.end()) order.push_back(keyOf(t));
  const auto ratio = [&](const Key& key, auto&& isOther) {
    std::vector<double> ratios; // within one round: the machine drifts from round to round
    for (const Timing& t : timings)
      if (keyOf(t) == key && t.counts())
        for (const Timing& o : timings)
          if (o.benchCase == t.benchCase && o.round == t.round && o.counts() && isOther(t, o))
            ratios.push_back(t.rate() / o.rate());
    return ratios.empty() ? std::string() : fmt::format("{:.2f}", median(ratios));
  };
  for (const Key& key : order) {
    std::vector<double> rates, cycles;
    const Timing* some = nullptr;
    for (const Timing& t : timings)
      if (keyOf(t) == key) {
        if (!some || t.counts()) some = &t;
        if (!t.counts()) continue;
        rates.push_back(t.rate() / 1e6);
        if (t.cyclesPerContact > 0) cycles.push_back(t.cyclesPerContact);
      }
    const auto& [name, program, precision, threads] = key;
    if (rates.empty()) {
      text += fmt::format("| {} | {} | | | | {} | | | | | | |\n", name, program, some->check);
      continue;
    }
    const auto timesOther = [&, ours = program == "sandglass"](const char* other) {
      if (!ours) return std::string();
      return ratio(key, [&](const Timing& t, const Timing& o) {
        return o.program == other && o.threads == t.threads;
      });
    };
    text += fmt::format(
        "| {} | {} | {} | {} | {} | {:.2f} ({:.2f} to {:.2f}) | {} | {} | {} | {} | {} | {} |\n", name,
        program, precision, threads, some->grains, median(rates),
        *std::min_element(rates.begin(), rates.end()), *std::max_element(rates.begin(), rates.end()),
        timesOther("lammps"), timesOther("liggghts"), timesOther("yade"),
        threads > 1 ? ratio(key,
                            [](const Timing& t, const Timing& o) {
                              return o.program == t.program && o.precision == t.precision && o.threads == 1;
                            })
                    : "",
        cycles.empty() ? "" : fmt::format("{:.0f}", median(cycles)),
        some->bytesPerGrain > 0 ? fmt::format("{:.0f}", some->bytesPerGrain) : "");
  }
  return text + acrossCases(timings);
}

} // namespace sandglass::bench
