// sandglass render from a run on the disk, with no display: files, texts, choices, comparison, refusals.

#include "sim/io/run_folder.h"
#include "tests/app/program.h"
#include "tests/sim/temporary_folder.h"
#include "vis/picture_record.h"
#include "vis/renderer.h"

#include <catch2/catch.hpp>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sys/wait.h>

using namespace sandglass;
using namespace sandglass::test;

namespace fs = std::filesystem;

namespace {

/// The two colliding grains of sample_runs, 3 ms in 61 frames.
const fs::path& run() {
  static const TemporaryFolder folder("render-run");
  static const fs::path path = [] {
    const Result made = program("run " SANDGLASS_SOURCE_DIR "/sample_runs/two_grains/scene.toml -o " +
                                (folder / "run").string());
    INFO(made.text);
    REQUIRE(made.code == 0);
    return folder / "run";
  }();
  return path;
}

std::string on(const std::string& options) {
  return "render " + run().string() + " --size 160x90 " + options;
}

std::size_t count(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), {}));
}

} // namespace

TEST_CASE("render writes one picture a frame, each knowing where it comes from") {
  const TemporaryFolder folder("render-all");
  const auto frames = openFrames(run());
  const Result drawn = program(on("--every 10 -o " + (folder / "out").string()));
  INFO(drawn.text);
  REQUIRE(drawn.code == 0);
  CHECK(count(folder / "out") == (frames->size() + 9) / 10);
  std::map<std::string, std::string> text;
  const vis::Image image = vis::readPng(folder / "out/frame_00020.png", &text);
  CHECK(image.width == 160);
  CHECK(image.height == 90);
  CHECK(text["source"] == run().string());
  CHECK(text["frame"] == "20");
  CHECK(std::stod(text["time"]) == frames->time(20));
  CHECK(text["scene"] == frames->load(20)->provenance.at("scene"));
  // The view in the picture draws the picture again.
  const vis::View view = vis::parseView(text["view"], "picture");
  CHECK(vis::Renderer().draw(*frames->load(20), view).rgba == image.rgba);
}

TEST_CASE("render draws the frames that are asked for") {
  const TemporaryFolder folder("render-choice");
  const auto drawn = [&](const std::string& options) {
    fs::remove_all(folder / "out");
    const Result result = program(on(options + " -o " + (folder / "out").string()));
    INFO(result.text);
    REQUIRE(result.code == 0);
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder / "out"))
      names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    return names;
  };
  CHECK(drawn("--frames 3:5") ==
        std::vector<std::string>{"frame_00003.png", "frame_00004.png", "frame_00005.png"});
  CHECK(drawn("--frames 7") == std::vector<std::string>{"frame_00007.png"});
  CHECK(drawn("--frames :6 --every 3") ==
        std::vector<std::string>{"frame_00000.png", "frame_00003.png", "frame_00006.png"});
  CHECK(drawn("--at 0.00101") == std::vector<std::string>{"frame_00020.png"}); // 50 us a frame
}

TEST_CASE("both back ends write the same picture") {
  const TemporaryFolder folder("render-gl");
  REQUIRE(program(on("--frames 9 --gl osmesa -o " + (folder / "a").string())).code == 0);
  REQUIRE(program(on("--frames 9 --gl egl -o " + (folder / "b").string())).code == 0);
  CHECK(vis::readPng(folder / "a/frame_00009.png").rgba == vis::readPng(folder / "b/frame_00009.png").rgba);
}

TEST_CASE("render compares with a reference: 0 when alike, else 1 and a picture of the difference") {
  const TemporaryFolder folder("render-reference");
  REQUIRE(program(on("--frames 30 -o " + folder.path().string())).code == 0);
  const std::string reference = " --reference " + (folder / "frame_00030.png").string();
  const Result same = program(on("--frames 30" + reference));
  CHECK(same.code == 0);
  CHECK_THAT(same.text, Catch::Contains("0.0000 % of the pixels differ"));
  const Result other = program(on("--frames 30 --colour none -o " + (folder / "other").string() + reference));
  CHECK(other.code == 1);
  CHECK_THAT(other.text, Catch::Contains("difference.png"));
  CHECK(fs::exists(folder / "other/difference.png"));
  CHECK(program(on("--frames 30 --colour none --threshold 1 -o " + (folder / "other").string() + reference))
            .code == 0);
  CHECK(program(on("--frames 3:4" + reference)).code == 2);
}

TEST_CASE("render makes a film with all its frames") {
  const TemporaryFolder folder("render-film");
  const std::string film = (folder / "film.mp4").string();
  const Result made = program(on("--frames 0:14 --movie " + film));
  INFO(made.text);
  REQUIRE(made.code == 0);
  std::FILE* pipe = ::popen(
      ("ffprobe -v error -count_frames -show_entries stream=nb_read_frames -of csv=p=0 " + film).c_str(),
      "r");
  int frames = 0;
  REQUIRE(std::fscanf(pipe, "%d", &frames) == 1);
  ::pclose(pipe);
  CHECK(frames == 15);
}

TEST_CASE("a picture is drawn again from itself, also when the run has moved along with it") {
  const TemporaryFolder folder("render-again");
  REQUIRE(program("run " SANDGLASS_SOURCE_DIR "/sample_runs/two_grains/scene.toml -o " +
                  (folder / "a/run").string())
              .code == 0);
  REQUIRE(program("render " + (folder / "a/run").string() +
                  " --frames 12 --colour x --map cividis --size 160x90 -o " +
                  (folder / "a/pictures").string())
              .code == 0);
  const fs::path picture = folder / "a/pictures/frame_00012.png";
  const vis::Image first = vis::readPng(picture);
  REQUIRE(program("render " + picture.string() + " -o " + (folder / "again").string()).code == 0);
  CHECK((vis::readPng(folder / "again/frame_00012.png").rgba == first.rgba));
  fs::rename(folder / "a", folder / "b");
  const fs::path moved = folder / "b/pictures/frame_00012.png";
  REQUIRE(program("render " + moved.string() + " --map grey -o " + (folder / "grey").string()).code == 0);
  CHECK((vis::readPng(folder / "grey/frame_00012.png").rgba != first.rgba)); // options go before its view
  fs::remove_all(folder / "b/run");
  const Result missing = program("render " + moved.string() + " -o " + (folder / "none").string());
  CHECK(missing.code == 2);
  CHECK_THAT(missing.text, Catch::Contains("a/run, is missing") && Catch::Contains("hash"));
}

TEST_CASE("a film says which run and view it shows") {
  const TemporaryFolder folder("render-record");
  const fs::path film = folder / "film.mp4";
  REQUIRE(program(on("--frames 3:5 --colour x --range 0:2 --movie " + film.string())).code == 0);
  const vis::PictureRecord record = vis::readRecord(film);
  CHECK(record.source == run());
  CHECK(record.frame == 3);
  CHECK(record.view.colouring.quantity == "x");
  CHECK(record.view.colouring.high == 2);
  CHECK(record.text.at("scene") == openFrames(run())->load(3)->provenance.at("scene"));
  CHECK(vis::viewFromPicture(film).width == 160);
}

TEST_CASE("patterns, several runs and pairs") {
  const TemporaryFolder folder("render-many");
  for (const char* name : {"a/run", "b/run"}) {
    fs::create_directories((folder / name).parent_path());
    fs::copy(run(), folder / name, fs::copy_options::recursive);
  }
  const std::string pattern = " '" + folder.path().string() + "/*/run'",
                    out = " -o " + (folder / "out").string();
  REQUIRE(program("render" + pattern + " --frames 4 --size 160x90" + out).code == 0);
  CHECK(fs::exists(folder / "out/run_00004.png"));
  CHECK(fs::exists(folder / "out/run-2_00004.png"));
  const Result pair = program("render --side-by-side " + (folder / "a/run").string() + " " +
                              (folder / "b/run").string() + " --frames 40 --size 320x90" + out);
  INFO(pair.text);
  REQUIRE(pair.code == 0);
  std::map<std::string, std::string> text;
  const vis::Image both = vis::readPng(folder / "out/pair_00040.png", &text);
  CHECK(both.width == 320);
  CHECK(text["right_source"] == (folder / "b/run").string());
  int unlike = 0; // one run beside itself: the halves are alike but for the line between them
  for (int y = 0; y < 90; ++y)
    for (int x = 1; x < 160; ++x)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t row = static_cast<std::size_t>(y) * 320;
        unlike += both.rgba[4 * (row + static_cast<std::size_t>(x)) + k] !=
                  both.rgba[4 * (row + 160 + static_cast<std::size_t>(x)) + k];
      }
  CHECK(unlike == 0);
  CHECK(program("render '" + (folder / "no*").string() + "'" + out).code == 2);
  CHECK(program("render" + out).code == 2);
}

TEST_CASE("supersampling, 4k, selections and a camera that goes round") {
  const TemporaryFolder folder("render-more");
  const std::string out = " -o " + (folder / "out").string();
  REQUIRE(program(on("--frames 9 --supersample 3" + out)).code == 0);
  const vis::Image fine = vis::readPng(folder / "out/frame_00009.png");
  CHECK(fine.width == 160);
  REQUIRE(program(on("--frames 9" + out)).code == 0);
  const vis::Image plain = vis::readPng(folder / "out/frame_00009.png");
  CHECK((fine.rgba != plain.rgba));
  CHECK(vis::difference(fine, plain, 64) < 0.02); // only edges
  REQUIRE(program(on("--frames 9 --select 'x > 1000'" + out)).code == 0);
  CHECK(vis::difference(vis::readPng(folder / "out/frame_00009.png"), plain) > 0.01); // no grain left
  REQUIRE(program(on("--frames 9:10 --turn 90 --camera front" + out)).code == 0);
  const vis::View a = vis::viewFromPicture(folder / "out/frame_00009.png"),
                  b = vis::viewFromPicture(folder / "out/frame_00010.png");
  CHECK(b.camera.preset.empty());
  const Vec3 before = a.camera.position - a.camera.target, after = b.camera.position - b.camera.target;
  CHECK(before.dot(after) == Approx(0).margin(1e-9 * before.squaredNorm()));
  REQUIRE(program("render " + run().string() + " --frames 9 --size 4k" + out).code == 0);
  CHECK(vis::readPng(folder / "out/frame_00009.png").width == 3840);
}

TEST_CASE("tracks of chosen grains and slices through averages without a field of their own") {
  const TemporaryFolder folder("render-tracks");
  const auto drawn = [&](const std::string& options, const char* name, vis::View& view) {
    const Result result = program(on("--at 0.003 " + options + " -o " + (folder / name).string()));
    INFO(result.text);
    REQUIRE(result.code == 0);
    std::map<std::string, std::string> text;
    const vis::Image image = vis::readPng(folder / name / "frame_00060.png", &text);
    view = vis::parseView(text.at("view"), "view of the picture");
    return image;
  };
  // In 3 ms the two have not gone far enough for their tracks to show outside of them: grains are left out.
  std::ofstream(folder / "bare.toml") << "grains = false\n";
  const std::string bare = "--view " + (folder / "bare.toml").string();
  vis::View view;
  const vis::Image plain = drawn(bare, "plain", view);
  const vis::Image tracked = drawn(bare + " --tracks 0,1", "tracks", view);
  CHECK(view.tracks.grains == std::vector<std::int64_t>{0, 1});
  CHECK(vis::difference(plain, tracked) > 0);
  const vis::Image recent = drawn(bare + " --tracks 0,1 --track-duration 1e-4", "recent", view);
  CHECK(view.tracks.duration == 1e-4);
  CHECK(vis::difference(plain, recent) < vis::difference(plain, tracked));
  const vis::Image slice = drawn("--slice packing_fraction", "slice", view);
  CHECK(view.slice.shown);
  CHECK(view.slice.quantity == "packing_fraction");
  CHECK_FALSE(view.grains);
  CHECK(vis::difference(plain, slice) > 0.01);
}

TEST_CASE("what render cannot do is a sentence and exit code 2") {
  const TemporaryFolder folder("render-refusals");
  std::ofstream(folder / "view.toml") << "[camera]\npreset = \"side\"\nzoom = 2\n";
  struct Refusal {
    std::string options, sentence;
  };
  const Refusal refusals[] = {
      {"", "nothing to write"},
      {"-o OUT --clip 'q<3'", "--clip q<3: this is no clip plane"},
      {"-o OUT --clip 'x>3 kg'", "this is no clip plane"},
      {"-o OUT --camera side", "camera.preset is 'side'; it must be one of"},
      {"-o OUT --map jet", "colouring.map is 'jet'; it must be one of"},
      {"-o OUT --range 2:1", "--range 2:1: write frame, run, or LOW:HIGH"},
      {"-o OUT --size 12", "--size 12: write WIDTHxHEIGHT"},
      {"-o OUT --size 12x99999", "it must be a whole number from 16 to 16384"},
      {"-o OUT --select 'z >'", "the selection \"z >\" is no expression"},
      {"-o OUT --arrows torque", "no vector 'torque'"},
      {"-o OUT --field none.vti", "none.vti: the file cannot be opened"},
      {"-o OUT --colour original.w", "there is no quantity 'original.w'"},
      {"-o OUT --frames 1000:", "has the frames 0 to 60"},
      {"-o OUT --frames a:b", "--frames a:b: write A:B"},
      {"-o OUT --colour charge", "there is no quantity 'charge'"},
      {"-o OUT --view none.toml", "none.toml: the view file cannot be read"},
      {"-o OUT --view VIEW", "view.toml:3: camera.zoom is not a known key"},
      {"-o OUT --reference none.png --at 0", "none.png: the picture cannot be read"},
  };
  for (const auto& [options, sentence] : refusals) {
    INFO(options);
    std::string given = options;
    if (const auto at = given.find("OUT"); at != std::string::npos)
      given.replace(at, 3, (folder / "out").string());
    if (const auto at = given.find("VIEW"); at != std::string::npos)
      given.replace(at, 4, (folder / "view.toml").string());
    const Result result = program("render " + run().string() + " " + given);
    CHECK(result.code == 2);
    CHECK_THAT(result.text, Catch::Contains(sentence));
  }
  CHECK(program("render " + (folder / "nothing").string() + " -o x").code == 2);
}
