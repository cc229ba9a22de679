// The program as a user calls it: what explain prints and how it exits.
#include <catch2/catch.hpp>

#include <array>
#include <cstdio>
#include <string>

namespace {

struct Answer {
  int code = -1;
  std::string text; ///< of both streams
};

Answer call(const std::string& arguments) {
  const std::string command = std::string(SANDGLASS_PROGRAM) + " " + arguments + " 2>&1";
  FILE* pipe = popen(command.c_str(), "r");
  REQUIRE(pipe);
  Answer answer;
  std::array<char, 4096> buffer{};
  while (const std::size_t n = fread(buffer.data(), 1, buffer.size(), pipe))
    answer.text.append(buffer.data(), n);
  const int status = pclose(pipe);
  answer.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return answer;
}

const std::string samples = SANDGLASS_SOURCE_DIR "/sample_runs/";

} // namespace

TEST_CASE("explain says what is modelled and what it costs", "[explain]") {
  const Answer answer = call("explain " + samples + "hopper_glass");
  CHECK(answer.code == 0);
  CHECK_THAT(answer.text, Catch::Contains("6790 grains"));
  CHECK_THAT(answer.text, Catch::Contains("2e-05 s: given by time_step"));
  CHECK_THAT(answer.text, Catch::Contains("forces across a gap")); // not used
  CHECK_THAT(answer.text, Catch::Contains("This assumes that every stage lasts its full duration"));
}

TEST_CASE("explain takes overrides, and refuses wrong ones with every fault", "[explain]") {
  CHECK_THAT(call("explain " + samples + "hopper_glass --set fill.1.number=100").text,
             Catch::Contains("100 grains"));
  const Answer answer = call("explain " + samples + "hopper_glass --set seed=-1 --set wall.gate.length=3");
  CHECK(answer.code == 2);
  CHECK_THAT(answer.text, Catch::Contains("--set: seed is -1, but must not be below 0\n"));
  CHECK_THAT(answer.text, Catch::Contains("--set: wall.gate.length is 3, but the unit is missing"));
}

TEST_CASE("explain --resolved prints a scene that explains itself alike", "[explain]") {
  const Answer resolved = call("explain --resolved " + samples + "two_grains");
  CHECK(resolved.code == 0);
  CHECK_THAT(resolved.text, Catch::Contains("diameter = \"0.002 m\""));
}

TEST_CASE("explain without a scene asks for one", "[explain]") {
  const Answer answer = call("explain");
  CHECK(answer.code == 2);
  CHECK_THAT(answer.text, Catch::Contains("name a scene"));
}
