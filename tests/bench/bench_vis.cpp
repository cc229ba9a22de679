// Speed of drawing on one machine: rows of
//   case,program,threads,precision,grains,steps,cpu_s,wall_s,grain_steps_per_cpu_s,bytes_per_grain,check
// A step is a picture of 1280 x 720 pixels in which every grain has moved and the camera has gone round by 3
// degrees; cpu_s is that of one picture over all threads of the rasteriser, 1 / wall_s the pictures a second.
// bytes_per_grain: peak memory of the process above that of one with ten grains, the frame itself included.
// `check`: hash of the last picture, the same for both back ends. Stock VTK mappers beside ours draw grains
// alone; ours draw legend, scale, axes and smoothed edges as well. Each row is a process of its own.

#include "sim/base/random.h"
#include "tests/bench/stock_vtk.h"
#include "vis/renderer.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <ctime>
#include <fstream>
#include <functional>
#include <iostream>
#include <string>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

using namespace sandglass;

namespace {

/// Uniform points as dense as a packing of 0.6, with random velocities; spheres, or four shapes.
Frame cube(std::size_t grains, bool shapes) {
  constexpr double radius = 1e-3;
  const double size = 2 * radius * std::cbrt(static_cast<double>(grains) * 3.14159265358979 / 6 / 0.6);
  Frame frame;
  frame.domain.upper = Vec3::Constant(size);
  if (shapes)
    frame.shapes = {{Vec3(1.0, 0.7, 0.5) * 1e-3, 1, 1},
                    {Vec3(0.8, 0.8, 0.8) * 1e-3, 0.3, 0.3},
                    {Vec3(0.6, 0.6, 1.0) * 1e-3, 0.2, 1},
                    {Vec3(0.9, 0.7, 0.8) * 1e-3, 0.7, 1.3}};
  RandomStream random(1, RandomPurpose::test, 0);
  for (std::size_t i = 0; i < grains; ++i) {
    frame.id.push_back(static_cast<std::int64_t>(i));
    frame.position.push_back(Vec3(random.uniform(), random.uniform(), random.uniform()) * size);
    frame.vectors[quantity::velocity].push_back(random.direction() * random.uniform());
    if (!shapes) continue;
    frame.scalars[quantity::shape].push_back(static_cast<double>(i % 4));
    frame.orientation.push_back(
        Eigen::Quaterniond(random.normal(), random.normal(), random.normal(), random.normal()).normalized());
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

using Draw = std::function<vis::Image(const Frame&, int picture)>;

struct Program {
  std::string benchCase, name;
  bool shapes;
  std::vector<std::size_t> grains;
  std::function<Draw()> make;
};

Draw ours(vis::GlBackend backend) {
  auto renderer = std::make_shared<vis::Renderer>(backend);
  auto camera = std::make_shared<vis::Camera>();
  return [=](const Frame& frame, int picture) {
    vis::View view;
    if (picture > 0) view.camera = vis::orbit(*camera, 3.0 * picture, 0);
    vis::Image image = renderer->draw(frame, view);
    if (picture == 0) *camera = renderer->resolvedCamera();
    return image;
  };
}

Draw stock(bench::StockMapper kind) {
  auto vtk = std::make_shared<bench::StockVtk>(kind);
  return [=](const Frame& frame, int picture) { return vtk->draw(frame, picture == 0 ? 0 : 3); };
}

struct Row {
  double cpu = 0, wall = 0, peakBytes = 0;
  std::uint64_t check = 0;
};

constexpr int pictures = 6;

Row measured(const Program& program, std::size_t grains) {
  Frame frame = cube(grains, program.shapes);
  const Draw draw = program.make();
  vis::Image image = draw(frame, 0); // compiles shaders
  const auto wall = std::chrono::steady_clock::now();
  const auto cpu = std::clock();
  for (int k = 1; k <= pictures; ++k) {
    for (std::size_t i = 0; i < grains; ++i)
      frame.position[i] += 1e-5 * frame.vectors[quantity::velocity][i];
    image = draw(frame, k);
  }
  Row row;
  row.cpu = static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC / pictures;
  row.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count() / pictures;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  row.peakBytes = 1024.0 * static_cast<double>(usage.ru_maxrss);
  row.check = hash(image.rgba);
  return row;
}

/// In a child process, so that memory is that of one row. The parent never touches OpenGL.
Row inChild(const Program& program, std::size_t grains) {
  int ends[2];
  Row row;
  if (pipe(ends) != 0) return row;
  const pid_t child = fork();
  if (child == 0) {
    row = measured(program, grains);
    const bool sent = write(ends[1], &row, sizeof row) == static_cast<ssize_t>(sizeof row);
    _exit(sent ? 0 : 1);
  }
  close(ends[1]);
  const bool received = read(ends[0], &row, sizeof row) == static_cast<ssize_t>(sizeof row);
  close(ends[0]);
  waitpid(child, nullptr, 0);
  return received ? row : Row{};
}

} // namespace

int main(int argc, char** argv) {
  const std::string file = argc > 2 && std::string(argv[1]) == "--csv" ? argv[2] : "";
  using bench::StockMapper;
  using vis::GlBackend;
  const std::vector<Program> programs{
      {"spheres",
       "sandglass osmesa",
       false,
       {10000, 100000, 1000000},
       [] { return ours(GlBackend::osmesa); }},
      {"spheres", "sandglass egl", false, {10000, 100000, 1000000}, [] { return ours(GlBackend::egl); }},
      {"spheres",
       "vtkOpenGLSphereMapper",
       false,
       {10000, 100000, 1000000},
       [] { return stock(StockMapper::spheres); }},
      {"spheres",
       "vtkPointGaussianMapper",
       false,
       {10000, 100000, 1000000},
       [] { return stock(StockMapper::gaussianPoints); }},
      {"superellipsoids",
       "sandglass osmesa",
       true,
       {10000, 100000, 1000000},
       [] { return ours(GlBackend::osmesa); }},
      {"superellipsoids",
       "vtkGlyph3DMapper",
       true,
       {10000, 100000},
       [] { return stock(StockMapper::glyphs); }},
  };
  std::string csv = "case,program,threads,precision,grains,steps,cpu_s,wall_s,grain_steps_per_cpu_s,bytes_"
                    "per_grain,check\n";
  std::cout << csv << std::flush;
  for (const Program& program : programs) {
    const Row empty = inChild(program, 10);
    for (const std::size_t grains : program.grains) {
      const Row row = inChild(program, grains);
      const std::string line =
          row.cpu > 0
              ? fmt::format("{},{},{},float,{},{},{:.3f},{:.3f},{:.4g},{:.0f},{:016x}\n", program.benchCase,
                            program.name, std::thread::hardware_concurrency(), grains, pictures, row.cpu,
                            row.wall, static_cast<double>(grains) / row.cpu,
                            (row.peakBytes - empty.peakBytes) / static_cast<double>(grains), row.check)
              : fmt::format("{},{},,,{},,,,,,void: the process failed\n", program.benchCase, program.name,
                            grains);
      std::cout << line << std::flush;
      csv += line;
    }
  }
  if (!file.empty()) std::ofstream(file) << csv;
}
