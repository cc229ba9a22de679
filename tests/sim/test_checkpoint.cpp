// A checkpoint is whole or refused.

#include "sim/base/error.h"
#include "sim/io/run_folder.h"
#include "tests/sim/temporary_folder.h"

#include <catch2/catch.hpp>

#include <fstream>

using namespace sandglass;
using namespace sandglass::test;
using Catch::Contains;

namespace {

Solver::State sample() {
  Solver::State state;
  for (int i = 0; i < 1000; ++i)
    state["dem/positions"].push_back(static_cast<std::byte>(i * 37));
  state["empty"];
  state["run"] = {std::byte{1}, std::byte{0}, std::byte{255}};
  return state;
}

} // namespace

TEST_CASE("A checkpoint comes back byte for byte", "[io]") {
  const TemporaryFolder folder("checkpoint");
  writeCheckpoint(folder / "a.checkpoint", sample());
  CHECK(readCheckpoint(folder / "a.checkpoint") == sample());
  CHECK_FALSE(std::filesystem::exists(folder / "a.checkpoint.part"));
}

TEST_CASE("Torn, damaged and foreign checkpoints are refused", "[io]") {
  const TemporaryFolder folder("checkpoint-torn");
  writeCheckpoint(folder / "a.checkpoint", sample());
  std::ifstream in(folder / "a.checkpoint", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const auto put = [&](const std::string& content) {
    std::ofstream(folder / "b.checkpoint", std::ios::binary) << content;
    return folder / "b.checkpoint";
  };
  for (const std::size_t length : {std::size_t{25}, bytes.size() / 2, bytes.size() - 1})
    CHECK_THROWS_WITH(readCheckpoint(put(bytes.substr(0, length))), Contains("torn or damaged"));
  for (std::size_t at = 30; at < bytes.size(); at += 97) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 4);
    CHECK_THROWS_AS(readCheckpoint(put(damaged)), InputError);
  }
  CHECK_THROWS_WITH(readCheckpoint(put("PNG")), Contains("not a checkpoint of Sandglass"));
  CHECK_THROWS_WITH(readCheckpoint(folder / "absent"), Contains("cannot be opened"));
}

TEST_CASE("A checkpoint that cannot be written says so", "[io]") {
  const TemporaryFolder folder("checkpoint-nowhere");
  CHECK_THROWS_WITH(writeCheckpoint(folder / "no such folder/a", sample()), Contains("cannot be written"));
}
