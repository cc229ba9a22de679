// Superellipsoids: the ray meets the surface, the picture is that of a fine mesh, hidden ones change nothing.

#include "tests/vis/pixels.h"
#include "tests/vis/sample_frames.h"
#include "vis/superellipsoid.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace sandglass;
using namespace sandglass::test;
using namespace sandglass::vis;

namespace {

double inside(const GrainShape& s, const Vec3& p) {
  const Vec3 q = p.cwiseQuotient(s.semiAxes).cwiseAbs();
  return std::pow(std::pow(q.x(), 2 / s.e2) + std::pow(q.y(), 2 / s.e2), s.e2 / s.e1) +
         std::pow(q.z(), 2 / s.e1);
}

const std::vector<GrainShape>& zoo() {
  static const std::vector<GrainShape> all{{Vec3(1.0, 0.6, 0.4), 1, 1},    {Vec3(0.9, 0.7, 0.5), 0.2, 0.2},
                                           {Vec3(0.6, 0.6, 1.0), 0.15, 1}, {Vec3(0.8, 0.8, 0.5), 1, 0.3},
                                           {Vec3(1, 0.8, 0.9), 2, 2},      {Vec3(0.9, 0.5, 0.7), 1.6, 0.5}};
  return all;
}

View blackView() {
  View view = flatView(3);
  view.colouring.quantity = "";
  view.colouring.plain = {0, 0, 0};
  return view;
}

Frame one(const GrainShape& shape, const Eigen::Quaterniond& turn) {
  Frame f;
  f.id = {7};
  f.position = {Vec3::Zero()};
  f.shapes = {shape};
  f.orientation = {turn};
  return f;
}

Eigen::Quaterniond randomTurn(RandomStream& random) {
  return Eigen::Quaterniond(random.normal(), random.normal(), random.normal(), random.normal()).normalized();
}

double blackPixels(const Image& image) {
  double count = 0;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4)
    count += image.rgba[i] < 128;
  return count;
}

} // namespace

/// Grains of all kinds at random, so many that most hide others.
static Frame heap(int count) {
  Frame f;
  f.shapes = zoo();
  RandomStream random(3, RandomPurpose::test, 0);
  f.domain.upper = Vec3::Constant(12);
  for (int i = 0; i < count; ++i) {
    f.id.push_back(i);
    f.position.push_back(12 * Vec3(random.uniform(), random.uniform(), random.uniform()));
    f.orientation.push_back(randomTurn(random));
    f.scalars[quantity::shape].push_back(i % 7 - 1.0); // one in seven is a sphere
    f.scalars[quantity::radius].push_back(0.7);
  }
  return f;
}

TEST_CASE("rays meet the surface of a superellipsoid, and miss what they miss") {
  RandomStream random(9, RandomPurpose::test, 0);
  for (const GrainShape& shape : zoo()) {
    const double around = surroundingRadius(shape), within = inscribedEllipsoid(shape).minCoeff();
    int hits = 0;
    for (int k = 0; k < 500; ++k) {
      const Vec3 origin = 5 * random.direction();
      const Vec3 aim = around * random.uniform() * random.direction();
      const Ray ray{origin, (aim - origin).normalized()};
      const auto t = entryDistance(shape, ray);
      const double closest = origin.cross(ray.direction).norm();
      if (closest > around) CHECK_FALSE(t);
      if (closest < within) REQUIRE(t);
      // A dense walk along the ray: inside somewhere, or nowhere.
      double lowest = 1e300;
      for (int step = 0; step < 4000; ++step)
        lowest = std::min(lowest, inside(shape, ray.origin + (3 + 1e-3 * step) * ray.direction));
      if (t) {
        ++hits;
        const Vec3 p = ray.origin + *t * ray.direction;
        CHECK(inside(shape, p) == Approx(1).margin(1e-7));
        CHECK(inside(shape, p - 1e-4 * ray.direction) > 1);
        CHECK(p.norm() <= around * (1 + 1e-9));
        CHECK(p.norm() >= within * (1 - 1e-9));
        CHECK(outwardNormal(shape, p).dot(ray.direction) < 1e-6);
      } else {
        CHECK(lowest > 1 - 1e-6);
      }
    }
    CHECK(hits > 100);
  }
}

TEST_CASE("a shape reaches as far along a direction as its farthest surface point") {
  RandomStream random(10, RandomPurpose::test, 0);
  for (const GrainShape& shape : zoo()) {
    const Vec3 direction = random.direction();
    double farthest = 0;
    for (int k = 0; k < 40000; ++k) { // radial: scale a direction until it lies on the surface
      const Vec3 d = random.direction();
      const Vec3 q = d.cwiseQuotient(shape.semiAxes).cwiseAbs();
      const double n = std::pow(
          std::pow(std::pow(q.x(), 2 / shape.e2) + std::pow(q.y(), 2 / shape.e2), shape.e2 / shape.e1) +
              std::pow(q.z(), 2 / shape.e1),
          shape.e1 / 2);
      farthest = std::max(farthest, direction.dot(d) / n);
    }
    CHECK(farthest <= support(shape, direction) * (1 + 1e-12));
    CHECK(farthest > support(shape, direction) * 0.97); // 40000 points leave gaps at corners
  }
}

TEST_CASE("the outward normal is the gradient") {
  const GrainShape shape{Vec3(0.9, 0.5, 0.7), 1.6, 0.5};
  const Ray ray{Vec3(3, 2, 1), -Vec3(3.2, 2.1, 0.8).normalized()};
  const auto t = entryDistance(shape, ray);
  REQUIRE(t);
  const Vec3 p = ray.origin + *t * ray.direction;
  Vec3 gradient;
  for (int k = 0; k < 3; ++k)
    gradient[k] = (inside(shape, p + 1e-6 * Vec3::Unit(k)) - inside(shape, p - 1e-6 * Vec3::Unit(k))) / 2e-6;
  CHECK((outwardNormal(shape, p) - gradient.normalized()).norm() < 1e-5);
}

TEST_CASE("the drawn area of an ellipsoid is that of its ellipse, of a box that of its rectangle") {
  Renderer renderer;
  const double pixel = 120; // for a metre
  // Along y one sees x and z; turned by 90 degrees about z, y and z.
  const Eigen::Quaterniond quarter(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitZ()));
  const GrainShape egg{Vec3(1.0, 0.6, 0.4), 1, 1};
  CHECK(blackPixels(renderer.draw(one(egg, Eigen::Quaterniond::Identity()), blackView())) ==
        Approx(std::numbers::pi * 1.0 * 0.4 * pixel * pixel).epsilon(0.003));
  CHECK(blackPixels(renderer.draw(one(egg, quarter), blackView())) ==
        Approx(std::numbers::pi * 0.6 * 0.4 * pixel * pixel).epsilon(0.003));
  // The section x-z of a shape with e1 = e is |x|^(2/e) + |z|^(2/e) = 1, whose area is
  // 4 a c G(1 + e/2)^2 / G(1 + e).
  for (const double e : {0.1, 0.5, 1.5, 2.0}) {
    const GrainShape shape{Vec3(1.0, 0.6, 0.4), e, 1};
    const double area = 4 * 1.0 * 0.4 * std::pow(std::tgamma(1 + e / 2), 2) / std::tgamma(1 + e);
    CHECK(blackPixels(renderer.draw(one(shape, Eigen::Quaterniond::Identity()), blackView())) ==
          Approx(area * pixel * pixel).epsilon(0.005));
  }
}

TEST_CASE("ray-cast superellipsoids look like fine meshes, with and without perspective") {
  Renderer renderer;
  RandomStream random(4, RandomPurpose::test, 0);
  for (const bool orthographic : {false, true}) {
    Frame frame;
    frame.shapes = zoo();
    for (std::size_t k = 0; k < zoo().size(); ++k) {
      frame.id.push_back(static_cast<std::int64_t>(k));
      frame.position.emplace_back(1.7 * static_cast<double>(k % 3), 0.5 * static_cast<double>(k % 2),
                                  1.7 * static_cast<double>(k / 3));
      frame.orientation.push_back(randomTurn(random));
      frame.scalars[quantity::shape].push_back(static_cast<double>(k));
    }
    View view = bareView();
    view.box = false;
    view.colouring = {.quantity = "id", .map = "discrete"};
    view.camera.preset = "front";
    view.camera.orthographic = orthographic;
    const Image cast = renderer.draw(frame, view);
    view.meshes = true;
    const Image mesh = renderer.draw(frame, view);
    // Flat triangles of 1 / 64 of the way round: edges and highlights differ by a grey level or two.
    CHECK(difference(cast, mesh, 24) < 0.004);
    frame.shapes[3].semiAxes *= 1.05; // a planted wrong size
    CHECK(difference(renderer.draw(frame, view), cast, 24) > 0.008);
  }
}

TEST_CASE("grains hidden behind others are left out, and no pixel changes") {
  Renderer renderer;
  for (const bool shapes : {true, false})
    for (const char* preset : {"fit", "top", "inside"}) {
      Frame frame = heap(700);
      if (!shapes) {
        frame.shapes.clear();
        frame.orientation.clear();
      }
      View view = bareView();
      view.colouring = {.quantity = "id", .map = "viridis"};
      view.camera.preset = preset;
      if (view.camera.preset == "inside") { // the eye in the middle of the heap
        view.camera.preset.clear();
        view.camera.position = Vec3(6.1, 5.9, 6.3);
        view.camera.target = Vec3(9, 8, 7);
        view.camera.viewAngle = 60;
      }
      renderer.setDetail({.skipHidden = false});
      const Image all = renderer.draw(frame, view);
      CHECK(renderer.drawnGrains() == frame.size());
      renderer.setDetail({});
      const Image seen = renderer.draw(frame, view);
      CHECK(difference(all, seen, 0) == 0);
      CHECK(renderer.drawnGrains() < frame.size() * 9 / 10);
      CHECK(renderer.drawnGrains() > 20);
    }
}

TEST_CASE("a superellipsoid is picked exactly where it is seen") {
  Renderer renderer;
  Frame frame = heap(40);
  View view = bareView();
  view.box = false;
  view.colouring.quantity = "";
  view.colouring.plain = {0, 0, 0};
  const Image image = renderer.draw(frame, view);
  int hits = 0, wrong = 0;
  for (int y = 3; y < 357; y += 4)
    for (int x = 3; x < 637; x += 4) {
      bool edge = false; // where smoothing blends two things
      for (int dx = -2; dx <= 2; ++dx)
        for (int dy = -2; dy <= 2; ++dy)
          edge = edge || (at(image, x + dx, y + dy)[0] > 250) != (at(image, x, y)[0] > 250);
      if (edge) continue;
      const bool picked = renderer.pick(x, y).grain >= 0;
      hits += picked;
      wrong += picked != (at(image, x, y)[0] < 250);
    }
  CHECK(hits > 300);
  CHECK(wrong == 0);
}

TEST_CASE("a superellipsoid too small to be told from a sphere is drawn as one of its volume") {
  Renderer renderer;
  View view = blackView();
  view.camera.orthographicHeight = 600; // 0.6 pixels for a metre, 3.6 for the shape
  const GrainShape shape{Vec3(3, 0.5, 0.5), 1, 1};
  Frame frame = one(shape, Eigen::Quaterniond::Identity());
  frame.position[0] = Vec3(0.5, 0, 0.5) / 0.6; // the middle of a pixel
  const Image small = renderer.draw(frame, view);
  renderer.setDetail({.smallestShape = 0});
  const Image exact = renderer.draw(frame, view);
  CHECK((small.rgba != exact.rgba));
  CHECK(difference(small, exact, 0) < 20.0 / (640 * 360)); // a dot for a dash of four pixels, smoothed
}
