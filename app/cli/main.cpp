// sandglass: the command line. No Qt, no display.

#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "sim/base/error.h"
#ifdef SANDGLASS_VIS
#include "vis/readers/child_reader.h"
#include "vis/readers/vti_field.h"
#include "vis/readers/vtk_frame.h"
#include "vis/readers/vtp_mesh.h"
#endif

#include <csignal>
#include <cstdio>
#include <exception>

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN); // a write beyond the largest file allowed then fails, as on a full disk
  using namespace sandglass;
#ifdef SANDGLASS_VIS
  if (int code = 0; vis::serveAsReader(argc, argv, code)) return code;
#endif
  CLI::App app{"Granular flow: simulate, render, analyse."};
  app.require_subcommand(1);
  cli::Action action;
  cli::addRun(app, action);
  cli::addConvert(app, action);
  cli::addExplain(app, action);
  cli::addAnalyze(app, action);
  cli::addInfo(app, action);
  cli::addCompare(app, action);
  cli::addSweep(app, action);
#ifdef SANDGLASS_VIS
  vis::registerMeshReaders();
  vis::registerFlowReaders();
  vis::registerFrameReaders();
  cli::addRender(app, action);
#endif

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 2;
  }
  try {
    return action();
  } catch (const InputError& e) {
    for (const auto& sentence : e.sentences())
      std::fprintf(stderr, "sandglass: %s\n", sentence.c_str());
    return 2;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "sandglass: %s\n", e.what());
    return 1;
  }
}
