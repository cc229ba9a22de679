// Exit codes and sentences of `sandglass run` and `sandglass convert`: 0 done, 1 failed, 2 wrong input.

#include "tests/sim/small_hopper.h"
#include "tests/sim/temporary_folder.h"

#include <catch2/catch.hpp>

#include <cstdio>
#include <fstream>
#include <sys/resource.h>
#include <sys/wait.h>

using namespace sandglass::test;
using Catch::Contains;

namespace {

struct Outcome {
  int code;
  std::string text; ///< standard output and error
};

Outcome invoke(const std::string& arguments) {
  FILE* pipe = popen((std::string(SANDGLASS_PROGRAM) + " " + arguments + " 2>&1").c_str(), "r");
  REQUIRE(pipe != nullptr);
  Outcome outcome;
  char buffer[4096];
  while (const std::size_t n = std::fread(buffer, 1, sizeof buffer, pipe))
    outcome.text.append(buffer, n);
  outcome.code = WEXITSTATUS(pclose(pipe));
  return outcome;
}

} // namespace

TEST_CASE("sandglass run and convert from the command line", "[app]") {
  const TemporaryFolder folder("command");
  const std::string scene = (folder / "s.toml").string(), run = (folder / "r").string();
  std::ofstream(scene) << smallHopper;
  const std::string brief =
      " --set 'stage.settle.until.duration=\"7 ms\"' --set 'stage.discharge.until.duration=\"7 ms\"'";

  Outcome done = invoke("run " + scene + " -o " + run + brief);
  CHECK(done.code == 0);
  CHECK_THAT(done.text,
             Contains("2 of 2 stages, 0.0139") && Contains("3 frames") && Contains("grain-steps a second"));

  Outcome again = invoke("run " + scene + " -o " + run + brief);
  CHECK(again.code == 2);
  CHECK_THAT(again.text, Contains("already holds a run") && Contains("--overwrite"));
  CHECK(invoke("run " + scene + " -o " + run + brief + " --overwrite").code == 0);
  CHECK(invoke("run " + run + " --resume").code == 0); // the folder is scene and output at once
  Outcome other = invoke("run " + scene + " -o " + run + " --resume");
  CHECK(other.code == 2);
  CHECK_THAT(other.text, Contains("made from another scene"));

  for (const char* form : {"a.pvd", "a.csv", "a.vtp", "a.vtkhdf"}) {
    INFO(form);
    CHECK(invoke("convert " + run + " " + (folder / form).string()).code == 0);
    CHECK(std::filesystem::exists(folder / form));
  }
  CHECK(invoke("convert " + run + " " + (folder / "b.vtp").string() + " --frame -3").code == 0);
  CHECK(invoke("convert " + (folder / "a.vtkhdf").string() + " " + (folder / "c.csv").string()).code == 0);
}

TEST_CASE("A limit on the size of files ends a run with a sentence", "[app]") {
  const TemporaryFolder folder("file-limit");
  const std::string scene = (folder / "s.toml").string();
  std::ofstream(scene) << smallHopper;
  ::rlimit before{};
  REQUIRE(::getrlimit(RLIMIT_FSIZE, &before) == 0);
  const ::rlimit small{20 * 1024, before.rlim_max};
  REQUIRE(::setrlimit(RLIMIT_FSIZE, &small) == 0);
  const Outcome cut = invoke("run " + scene + " -o " + (folder / "r").string());
  REQUIRE(::setrlimit(RLIMIT_FSIZE, &before) == 0);
  CHECK(cut.code == 1);
  CHECK_THAT(cut.text, Contains("cannot finish writing"));
}

TEST_CASE("Wrong input of run and convert", "[app]") {
  const TemporaryFolder folder("command-wrong");
  const std::string scene = (folder / "s.toml").string(), run = (folder / "r").string();
  std::ofstream(scene) << smallHopper;
  const auto refused = [](const std::string& arguments, const std::string& sentence) {
    INFO(arguments);
    const Outcome outcome = invoke(arguments);
    CHECK(outcome.code == 2);
    CHECK_THAT(outcome.text, Contains(sentence));
  };
  refused("run " + (folder / "absent.toml").string(), "there is no such scene file");
  refused("run " + scene + " --quick", "quick.set: --quick takes its changes from this file");
  refused("run " + scene + " --resume --overwrite", "--resume");
  refused("run " + scene + " --threads many", "--threads");
  refused("run " + scene + " -o " + scene + "/x", "cannot be made");
  REQUIRE(invoke("run " + scene + " -o " + run +
                 " --set 'stage.settle.until.duration=\"1 ms\"' --set "
                 "'stage.discharge.until.duration=\"1 ms\"'")
              .code == 0);
  refused("convert " + run + " " + (folder / "a.doc").string(), "names no form that is written");
  refused("convert " + run + " " + (folder / "a.vtp").string() + " --frame 99", "has the frames 0 to 1");
  refused("convert " + run + " " + (folder / "a.pvd").string() + " --frame 1",
          "a single frame goes into .vtp, .csv, .dump or .xyz");
  refused("convert " + (folder / "absent").string() + " a.vtp", "there is no such file or folder");
}
