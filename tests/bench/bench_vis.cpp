// Speed of drawing on one machine: rows of
//   case,program,threads,precision,grains,steps,cpu_s,wall_s,grain_steps_per_cpu_s,bytes_per_grain,check
// A step is a picture of 1280 x 720 pixels in which every grain has moved; cpu_s is that of one picture over
// all threads of the rasteriser. `check`: hash of the last picture, the same for both back ends.

#include "sim/base/random.h"
#include "vis/renderer.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <ctime>
#include <fstream>
#include <iostream>
#include <string>
#include <thread>

using namespace sandglass;

namespace {

/// Uniform points as dense as a packing of 0.6, with random velocities.
Frame cube(std::size_t grains) {
  constexpr double radius = 1e-3;
  const double size = 2 * radius * std::cbrt(static_cast<double>(grains) * 3.14159265358979 / 6 / 0.6);
  Frame frame;
  frame.domain.upper = Vec3::Constant(size);
  RandomStream random(1, RandomPurpose::test, 0);
  for (std::size_t i = 0; i < grains; ++i) {
    frame.id.push_back(static_cast<std::int64_t>(i));
    frame.position.push_back(Vec3(random.uniform(), random.uniform(), random.uniform()) * size);
    frame.vectors[quantity::velocity].push_back(random.direction() * random.uniform());
  }
  frame.scalars[quantity::radius] = std::vector<double>(grains, radius);
  return frame;
}

/// FNV-1a, 64 bits.
std::uint64_t hash(const std::vector<std::uint8_t>& bytes) {
  std::uint64_t h = 14695981039346656037ULL;
  for (const std::uint8_t byte : bytes)
    h = (h ^ byte) * 1099511628211ULL;
  return h;
}

std::string row(const std::string& name, vis::GlBackend backend, std::size_t grains) {
  constexpr int pictures = 10;
  vis::Renderer renderer(backend);
  Frame frame = cube(grains);
  vis::Image image = renderer.draw(frame, {}); // the first one compiles shaders
  const auto wall = std::chrono::steady_clock::now();
  const auto cpu = std::clock();
  for (int k = 0; k < pictures; ++k) {
    for (std::size_t i = 0; i < grains; ++i)
      frame.position[i] += 1e-5 * frame.vectors[quantity::velocity][i];
    image = renderer.draw(frame, {});
  }
  const double spentCpu = static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC / pictures;
  const std::chrono::duration<double> spentWall = std::chrono::steady_clock::now() - wall;
  return fmt::format("{},sandglass,{},float,{},{},{:.3f},{:.3f},{:.4g},,{:016x}\n", name,
                     std::thread::hardware_concurrency(), grains, pictures, spentCpu,
                     spentWall.count() / pictures, static_cast<double>(grains) / spentCpu, hash(image.rgba));
}

} // namespace

int main(int argc, char** argv) {
  const std::string file = argc > 2 && std::string(argv[1]) == "--csv" ? argv[2] : "";
  std::string csv = "case,program,threads,precision,grains,steps,cpu_s,wall_s,grain_steps_per_cpu_s,bytes_"
                    "per_grain,check\n";
  for (const std::size_t grains : {2000, 20000, 200000}) {
    csv += row("draw_osmesa", vis::GlBackend::osmesa, grains);
    csv += row("draw_egl", vis::GlBackend::egl, grains);
  }
  std::cout << csv;
  if (!file.empty()) std::ofstream(file) << csv;
}
