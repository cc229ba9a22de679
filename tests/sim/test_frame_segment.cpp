// What goes into a segment comes out bit for bit; what is not a segment is refused with a sentence.

#include "sim/base/error.h"
#include "sim/base/random.h"
#include "sim/io/frame_segment.h"
#include "tests/sim/frame_equality.h"
#include "tests/sim/temporary_folder.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>

using namespace sandglass;
using namespace sandglass::test;
using Catch::Contains;

namespace {

class FlatShape final : public WallShape {
public:
  void touches(const Vec3&, double, Touches&) const override {}
  double signedDistance(const Vec3& x) const override { return x.z(); }
  Eigen::AlignedBox3d bounds() const override { return {}; }
  TriangleMesh mesh(const Eigen::AlignedBox3d&) const override { return {}; }
};

const WallShapes flat = [](const std::string&) { return std::make_shared<FlatShape>(); };

Frame randomFrame(std::size_t grains, std::int64_t step, std::size_t contacts) {
  RandomStream random(11, RandomPurpose::test, static_cast<std::uint64_t>(step));
  const auto vec = [&] { return Vec3(random.normal(), random.normal(), random.normal()); };
  Frame f;
  f.time = 1e-3 * static_cast<double>(step);
  f.step = step;
  f.stage = step < 20 ? "fill" : "discharge";
  f.scalars[quantity::radius] = {};
  f.scalars[quantity::species] = {};
  f.vectors[quantity::velocity] = {};
  for (std::size_t i = 0; i < grains; ++i) {
    f.id.push_back(static_cast<std::int64_t>(3 * i + 1));
    f.position.push_back(vec());
    f.scalars[quantity::radius].push_back(random.uniform());
    f.scalars[quantity::species].push_back(static_cast<double>(i % 2));
    f.vectors[quantity::velocity].push_back(vec());
  }
  f.speciesNames = {"glass", "steel"};
  f.domain = {vec(), vec(), {false, true, false}};
  f.walls.push_back({"floor", std::make_shared<FlatShape>(), true, vec(), vec(), vec()});
  f.walls.push_back({"gate", std::make_shared<FlatShape>(), step < 20, vec(), vec(), vec()});
  FrameWall& drum = f.walls.emplace_back(f.walls.front());
  drum.name = "drum";
  drum.moving = true;
  drum.rotation = Eigen::Quaterniond(random.normal(), random.normal(), random.normal(), random.normal());
  drum.spin = vec();
  drum.reference = vec();
  drum.translation = vec();
  drum.work = random.normal();
  drum.power = random.normal();
  drum.wearWork = random.uniform();
  drum.collisions = step;
  for (std::size_t c = 0; c < contacts; ++c)
    f.contacts.push_back({static_cast<std::int64_t>(c),
                          c % 2 ? -1 : 7,
                          c % 2 ? 1 : -1,
                          {0, -1, 2},
                          vec(),
                          vec(),
                          vec(),
                          1e-4 * static_cast<double>(c)});
  f.provenance = {{"scene", "00ff"}, {"version", "0.1"}};
  return f;
}

std::filesystem::path writeSegment(const std::filesystem::path& file, const std::vector<Frame>& frames,
                                   bool single = false) {
  SegmentWriter writer(file, "title = \"Glas \xc3\xbc\"\n", frames.front(), single);
  for (const auto& frame : frames)
    writer.append(frame);
  writer.close();
  return file;
}

} // namespace

TEST_CASE("Frames of changing size come back bit for bit", "[io]") {
  const TemporaryFolder folder("segment");
  // No grain at first and again in the middle; more than one chunk (8192 rows) at the end.
  const std::vector<Frame> frames{randomFrame(0, 0, 0), randomFrame(5, 10, 3), randomFrame(0, 20, 0),
                                  randomFrame(9000, 30, 4), randomFrame(1, 40, 1)};
  const SegmentReader reader(writeSegment(folder / "a.vtkhdf", frames));
  REQUIRE(reader.size() == frames.size());
  CHECK(reader.sceneText() == "title = \"Glas \xc3\xbc\"\n");
  for (const std::size_t i : {4u, 0u, 3u, 1u, 2u}) { // any order
    CHECK(reader.time(i) == frames[i].time);
    CHECK(reader.step(i) == frames[i].step);
    requireEqual(reader.load(i, flat), frames[i]);
  }
}

TEST_CASE("Shapes and orientations come back, through frames without grains too", "[io]") {
  const TemporaryFolder folder("shapes");
  std::vector<Frame> frames{randomFrame(5, 1, 0), randomFrame(0, 2, 0), randomFrame(9, 3, 2)};
  RandomStream random(5, RandomPurpose::test, 0);
  for (Frame& frame : frames) {
    frame.shapes = {{Vec3(1e-3, 2e-3, 3e-3), 0.3, 1}, {Vec3(2e-3, 2e-3, 1e-3), 1, 0.7}};
    for (std::size_t i = 0; i < frame.size(); ++i) {
      frame.orientation.emplace_back(random.normal(), random.normal(), random.normal(), random.normal());
      frame.scalars[quantity::shape].push_back(static_cast<double>(i % 2));
    }
  }
  frames[1].scalars[quantity::shape] = {};
  const auto file = writeSegment(folder / "a.vtkhdf", frames);
  const SegmentReader reader(file);
  for (std::size_t i = 0; i < frames.size(); ++i)
    requireEqual(reader.load(i, flat), frames[i]);
  const SegmentWriter writer(folder / "b.vtkhdf", "", frames.front(), false);
  CHECK(writer.accepts(frames[1]));
  Frame other = frames[2];
  other.shapes[0].e1 = 0.4;
  CHECK_FALSE(writer.accepts(other));
  other = frames[2];
  other.orientation.clear();
  CHECK_FALSE(writer.accepts(other));
}

TEST_CASE("A segment without walls, species or quantities", "[io]") {
  const TemporaryFolder folder("bare");
  Frame bare;
  bare.id = {4};
  bare.position = {Vec3(1, 2, 3)};
  bare.persistentIds = false;
  requireEqual(SegmentReader(writeSegment(folder / "a.vtkhdf", {bare, bare})).load(1, flat), bare);
}

TEST_CASE("Single-precision positions are the doubles rounded to float", "[io]") {
  const TemporaryFolder folder("single");
  const Frame frame = randomFrame(100, 1, 0);
  const SegmentReader reader(writeSegment(folder / "a.vtkhdf", {frame}, true));
  const Frame back = reader.load(0, flat);
  for (std::size_t i = 0; i < frame.size(); ++i)
    REQUIRE(back.position[i] == frame.position[i].cast<float>().cast<double>());
  CHECK(sameBits(back.scalar(quantity::radius), frame.scalar(quantity::radius)));
}

TEST_CASE("A writer accepts only frames with its columns", "[io]") {
  const TemporaryFolder folder("accepts");
  const Frame first = randomFrame(3, 1, 0);
  const SegmentWriter writer(folder / "a.vtkhdf", "", first, false);
  CHECK(writer.accepts(randomFrame(7, 2, 5)));
  Frame other = first;
  other.scalars["mass"] = {1, 2, 3};
  CHECK_FALSE(writer.accepts(other));
  other = first;
  other.walls.pop_back();
  CHECK_FALSE(writer.accepts(other));
  other = first;
  other.provenance["seed"] = "2";
  CHECK_FALSE(writer.accepts(other));
}

TEST_CASE("Torn, empty and foreign files are refused with a sentence", "[io]") {
  const TemporaryFolder folder("torn");
  const auto whole = writeSegment(folder / "whole.vtkhdf", {randomFrame(50, 1, 2)});
  std::string bytes;
  {
    std::ifstream in(whole, std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(in), {});
  }
  const auto put = [&](const std::string& name, const std::string& content) {
    std::ofstream(folder / name, std::ios::binary) << content;
    return folder / name;
  };
  CHECK_THROWS_WITH(SegmentReader(put("empty.vtkhdf", "")),
                    Contains("empty.vtkhdf: this is no whole frame file"));
  CHECK_THROWS_AS(SegmentReader(put("text.vtkhdf", "id x y z\n")), InputError);
  for (const std::size_t length : {std::size_t{8}, bytes.size() / 4, bytes.size() / 2, bytes.size() - 1})
    CHECK_THROWS_AS(SegmentReader(put("cut.vtkhdf", bytes.substr(0, length))), InputError);
  CHECK_THROWS_AS(SegmentReader(folder / "absent.vtkhdf"), InputError);
}

TEST_CASE("A damaged segment never crashes the reader", "[io]") {
  const TemporaryFolder folder("damaged");
  const auto file = writeSegment(folder / "a.vtkhdf", {randomFrame(50, 1, 2), randomFrame(20, 2, 0)});
  std::string bytes;
  {
    std::ifstream in(file, std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(in), {});
  }
  int refused = 0;
  for (std::uint64_t trial = 0; trial < 300; ++trial) {
    RandomStream random(5, RandomPurpose::test, trial);
    std::string damaged = bytes;
    for (int k = 0; k < 4; ++k)
      damaged[static_cast<std::size_t>(random.uniform() * static_cast<double>(bytes.size()))] =
          static_cast<char>(256 * random.uniform());
    std::ofstream(folder / "b.vtkhdf", std::ios::binary) << damaged;
    try {
      const SegmentReader reader(folder / "b.vtkhdf");
      for (std::size_t i = 0; i < reader.size(); ++i)
        reader.load(i, flat);
    } catch (const InputError&) {
      ++refused;
    }
  }
  CHECK(refused > 0); // damage in metadata shows; damage in unused bytes need not
}
