#pragma once
// The parts of `sandglass analyze` that look at contacts, residence times, outflow, heaps and single impacts.

#include "app/cli/analyze_source.h"
#include "app/cli/result_files.h"

namespace sandglass::cli {

// Each writes its results, prints its key numbers, and throws InputError when they cannot be had.
void analyzeContacts(const Source& source, const AnalyzeOptions& options, ResultFiles& files);
void analyzeResidence(const Source& source, const AnalyzeOptions& options, ResultFiles& files);
void analyzeOutflow(const Source& source, const AnalyzeOptions& options, ResultFiles& files);
void analyzeHeap(const Source& source, const AnalyzeOptions& options, ResultFiles& files);
void analyzeImpacts(const AnalyzeOptions& options, ResultFiles& files);

} // namespace sandglass::cli
