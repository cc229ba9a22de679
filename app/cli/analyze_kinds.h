#pragma once
// The analyses of the registry on the command line: an option for each, knobs, results to files.

#include "analysis/registry.h"
#include "app/cli/analyze_source.h"
#include "app/cli/result_files.h"

#include <string>

namespace sandglass::cli {

/// "--bond-angles"
std::string optionOf(const analysis::AnalysisKind& kind);

/// Name, description, needs and knobs of each, on standard output.
void printAnalysisKinds();

/// Over the frames that --frames names (analyses of change: all, without it). Writes results, prints the key
/// numbers. Throws InputError when it cannot be had.
void analyzeKind(const analysis::AnalysisKind& kind, const Source& source, const AnalyzeOptions& options,
                 ResultFiles& files);

} // namespace sandglass::cli
