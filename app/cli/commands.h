#pragma once
// The subcommands of `sandglass`, one file each. Each adds itself to the parser and sets `action` when
// chosen. Exit codes: 0 done, 1 the run or comparison failed, 2 the input is wrong.

#include <CLI/CLI.hpp>

#include <functional>

namespace sandglass::cli {

using Action = std::function<int()>;

// Each of these lives in <name>_command.cpp and is called once from main.cpp.
void addRun(CLI::App& app, Action& action);
void addConvert(CLI::App& app, Action& action);
void addExplain(CLI::App& app, Action& action);
void addAnalyze(CLI::App& app, Action& action);
void addInfo(CLI::App& app, Action& action);
void addCompare(CLI::App& app, Action& action);
void addSweep(CLI::App& app, Action& action);

#ifdef SANDGLASS_VIS
void addRender(CLI::App& app, Action& action);
#endif

} // namespace sandglass::cli
