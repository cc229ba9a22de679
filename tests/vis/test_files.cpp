// Pictures and films as files.

#include "sim/base/error.h"
#include "tests/vis/sample_frames.h"
#include "vis/renderer.h"

#include <catch2/catch.hpp>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

using namespace sandglass;
using namespace sandglass::vis;
namespace fs = std::filesystem;

namespace {

class Folder {
public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "sandglass-vis-XXXXXX").string();
    path = mkdtemp(name.data());
  }
  ~Folder() { fs::remove_all(path); }
  fs::path path;
};

Image gradient(int width, int height) {
  Image image{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (const int c : {x * 255 / width, y * 255 / height, (x * y) % 256, x < width / 2 ? 255 : 100})
        image.rgba.push_back(static_cast<std::uint8_t>(c));
  return image;
}

std::string output(const std::string& command) {
  std::string text;
  std::FILE* pipe = popen(command.c_str(), "r");
  REQUIRE(pipe != nullptr);
  char buffer[256];
  while (std::fgets(buffer, sizeof buffer, pipe))
    text += buffer;
  pclose(pipe);
  return text;
}

} // namespace

TEST_CASE("a PNG gives back its pixels and texts") {
  const Folder folder;
  const Image image = gradient(33, 17);
  const std::map<std::string, std::string> text{{"view", writeView({})},
                                                {"scene_hash", "0123abcd"},
                                                {"title", "Körner, 2 µm\nsecond line"},
                                                {"long", std::string(5000, 'x')}};
  writePng(image, folder.path / "a.png", text);
  std::map<std::string, std::string> back;
  const Image read = readPng(folder.path / "a.png", &back);
  CHECK(read.width == 33);
  CHECK(read.height == 17);
  CHECK(read.rgba == image.rgba);
  CHECK(back == text);
  CHECK(std::distance(fs::directory_iterator(folder.path), {}) == 1); // no leftovers
}

TEST_CASE("broken or missing PNG files give sentences") {
  const Folder folder;
  const fs::path good = folder.path / "good.png", bad = folder.path / "bad.png";
  writePng(gradient(64, 64), good, {});
  std::ifstream in(good, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  for (const std::size_t size : {std::size_t{0}, std::size_t{5}, std::size_t{30}, bytes.size() / 2}) {
    std::ofstream(bad, std::ios::binary) << bytes.substr(0, size);
    CHECK_THROWS_AS(readPng(bad), Error);
  }
  CHECK_THROWS_WITH(readPng(folder.path / "none.png"), Catch::Contains("none.png"));
  CHECK_THROWS_WITH(writePng(gradient(2, 2), folder.path / "no" / "a.png", {}),
                    Catch::Contains("folder that exists"));
}

TEST_CASE("difference counts pixels") {
  const Image a = gradient(10, 10);
  Image b = a;
  CHECK(difference(a, b) == 0);
  b.rgba[4 * 55 + 1] = static_cast<std::uint8_t>(b.rgba[4 * 55 + 1] ^ 128);
  b.rgba[4 * 7] = static_cast<std::uint8_t>(b.rgba[4 * 7] + 5); // below the tolerance of 8
  CHECK(difference(a, b) == Approx(0.01));
  CHECK(difference(a, b, 4) == Approx(0.02));
  CHECK(difference(a, gradient(10, 9)) == 1);
}

TEST_CASE("a film has its frames, even sides and its provenance") {
  const Folder folder;
  const fs::path file = folder.path / "film.mp4";
  {
    Movie movie(file, 161, 91, 25, {{"scene_hash", "0123abcd"}, {"seed", "7"}});
    for (int k = 0; k < 12; ++k)
      movie.add(gradient(161, 91));
    movie.close();
    CHECK_THROWS_AS(movie.add(gradient(161, 91)), Error);
  }
  const std::string probe =
      output("ffprobe -v error -count_frames -select_streams v:0 -show_entries "
             "stream=codec_name,width,height,pix_fmt,nb_read_frames:format_tags=comment -of "
             "default=noprint_wrappers=1 '" +
             file.string() + "'");
  for (const char* expected : {"codec_name=h264", "width=160", "height=90", "pix_fmt=yuv420p",
                               "nb_read_frames=12", "scene_hash = '0123abcd'"})
    CHECK_THAT(probe, Catch::Contains(expected));
}

TEST_CASE("a film that cannot be written is an error, not a death") {
  const Folder folder;
  CHECK_THROWS_AS(Movie(folder.path / "a.mp4", 1, 90, 25, {}), InputError);
  {
    Movie movie(folder.path / "film.mp4", 160, 90, 25, {});
    CHECK_THROWS_WITH(movie.add(gradient(320, 90)), Catch::Contains("320 x 90"));
  }
  CHECK_THROWS_WITH(
      [&] {
        Movie movie(folder.path / "no" / "film.mp4", 640, 360, 25, {}); // ffmpeg gives up at once
        for (int k = 0; k < 50; ++k)
          movie.add(gradient(640, 360));
        movie.close();
      }(),
      Catch::Contains("ffmpeg"));
  const std::string path = std::getenv("PATH");
  setenv("PATH", folder.path.c_str(), 1);
  CHECK_THROWS_WITH(Movie(folder.path / "film.mp4", 160, 90, 25, {}),
                    Catch::Contains("install the package ffmpeg"));
  setenv("PATH", path.c_str(), 1);
}
