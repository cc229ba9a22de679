#pragma once
// A sweep as a job array of Slurm. Each job works off a share of the runs into a table of its own, since many
// nodes must not write one SQLite file on a shared file system; gathering takes those tables over.
//
//   sandglass sweep SWEEP.toml -o DIR --slurm 100     writes DIR/slurm/array.sh and DIR/slurm/submit.sh
//   sandglass sweep DIR --share 7/100                 what a job does: runs 8, 108, 208, ...
//   sandglass sweep DIR --gather                      their rows into DIR/sweep.sqlite; next round if any

#include "analysis/sweep/sweep_table.h"

#include <filesystem>
#include <string>
#include <utility>

namespace sandglass::cli {

inline constexpr const char* sharesFolder = "shares";

/// "7/100": share 7 of 100, counted from 0. Throws InputError.
std::pair<int, int> parseShare(const std::string& text);

/// The table of a share, made from the sweep's when it is not there. Runs that are over in the sweep's table
/// are so in it, too.
std::filesystem::path openShare(const std::filesystem::path& folder, int share, int shares);

int writeSlurm(const std::filesystem::path& folder, int jobs);

/// Takes over what the shares have; adds the next round of refinement when all runs are over. 1: runs wait.
int gatherShares(analysis::SweepTable& table, const std::filesystem::path& folder);

} // namespace sandglass::cli
