// A table of broken scenes, each with every sentence that the user gets.
#include "sim/base/error.h"
#include "sim/scene/document.h"
#include "sim/scene/scene.h"

#include <catch2/catch.hpp>

#include <fstream>
#include <sstream>

using namespace sandglass;

namespace {

const std::string folder = SANDGLASS_SOURCE_DIR "/tests/sim/broken_scenes";

std::string contents(const std::string& file) {
  std::ifstream in(file);
  REQUIRE(in);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::vector<std::string> texts(const Value* list) {
  std::vector<std::string> all;
  if (list)
    for (const auto& v : *list->list())
      all.push_back(*v.text());
  return all;
}

std::vector<std::string> faultsOf(const std::string& scene, const std::vector<std::string>& overrides) {
  try {
    parseScene(scene, "scene.toml", overrides, folder);
  } catch (const InputError& e) {
    auto sentences = e.sentences();
    for (auto& s : sentences) // CSV files are named with their folder
      if (const auto at = s.find(folder + "/"); at != std::string::npos) s.erase(at, folder.size() + 1);
    return sentences;
  }
  return {};
}

} // namespace

TEST_CASE("the scene that the broken ones start from is sound", "[scene]") {
  CHECK(faultsOf(contents(folder + "/base.toml"), {}).empty());
  CHECK(faultsOf("\xEF\xBB\xBF" + contents(folder + "/base.toml"), {}).empty()); // a byte order mark
}

TEST_CASE("every broken scene gets its sentences", "[scene]") {
  const std::string base = contents(folder + "/base.toml");
  const Value table = parseDocument(contents(folder + "/cases.toml"), "cases.toml");
  const ValueList& cases = *table.find("case")->list();
  CHECK(cases.size() >= 40);
  for (const Value& c : cases) {
    INFO(*c.find("name")->text());
    std::string scene = base;
    if (const Value* changes = c.find("change"))
      for (const Value& change : *changes->list()) {
        const auto pair = texts(&change);
        const auto at = scene.find(pair[0]);
        REQUIRE(at != std::string::npos);
        REQUIRE(scene.find(pair[0], at + 1) == std::string::npos);
        scene.replace(at, pair[0].size(), pair[1]);
      }
    CHECK(faultsOf(scene, texts(c.find("set"))) == texts(c.find("faults")));
  }
}

TEST_CASE("a scene file that cannot be opened is named", "[scene]") {
  CHECK_THROWS_WITH(readScene("/nowhere/scene.toml"),
                    "/nowhere/scene.toml: the scene file cannot be opened; check the path");
  CHECK_THROWS_AS(readScene(folder), InputError); // a folder is no scene
}
