#include "tests/validate/verdicts.h"

#include "sim/base/error.h"
#include "tests/peers/circumstances.h"
#include "vis/chart.h"

#include <fmt/format.h>

#include <fstream>

namespace sandglass::validate {

namespace {

void write(const std::filesystem::path& file, const std::string& text) {
  if (!(std::ofstream(file) << text)) throw RunError("cannot write " + file.string());
}

} // namespace

void writeReport(const Report& report, const std::filesystem::path& folder, const std::string& name,
                 const std::string& title, const std::string& preamble, const std::string& conditions) {
  std::filesystem::create_directories(folder / name);
  write(folder / (name + ".csv"), csv(report.rows));
  std::string page =
      fmt::format("# {}\n\n{}\n\nMade by `./bootstrap validate {}` on {}{}{}.\n\n", title, preamble, name,
                  peers::circumstances(), conditions.empty() ? "" : "; ", conditions);
  page +=
      "| case | quantity | ours | expected | tolerance | source | verdict |\n|---|---|---|---|---|---|---|\n";
  for (const Row& r : report.rows) {
    const std::string ours = r.uncertainty > 0 ? fmt::format("{:.4g} ± {:.2g}", r.ours, r.uncertainty)
                                               : fmt::format("{:.6g}", r.ours);
    const std::string verdict = r.verdict() == "off" ? "**off**" : r.verdict();
    page += fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", r.testCase, r.quantity, ours, r.expected,
                        r.tolerance, r.source, verdict);
  }
  for (analysis::Curve curve : report.curves) {
    curve.provenance["circumstances"] = peers::circumstances();
    write(folder / name / (curve.name + ".csv"), analysis::toCsv(curve));
    vis::writeChart(curve, folder / name / (curve.name + ".png"));
    page += fmt::format("\n![{}]({}/{}.png)\n", curve.title, name, curve.name);
  }
  write(folder / (name + ".md"), page);
}

} // namespace sandglass::validate
