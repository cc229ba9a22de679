#pragma once
// One renderer for screen and file. Makes and owns its GL context on the thread that constructs it, and is to
// be used and destroyed on that thread alone. No display, no Qt.

#include "analysis/result.h"
#include "sim/frame/frame.h"
#include "vis/view.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sandglass::vis {

/// RGBA, 8 bits, rows from the top.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
};

class History;

enum class GlBackend { automatic, osmesa, egl };

/// What is drawn more cheaply where nobody sees it; off for tests and comparisons.
struct Detail {
  bool skipHidden = true;   ///< leave out grains that are wholly behind others: no pixel changes
  double smallestShape = 4; ///< [pixel] superellipsoids less wide are drawn as spheres
};

struct PickResult {
  std::int64_t grain = -1; ///< id, or -1
  Vec3 point = Vec3::Zero();
  int half = 0; ///< of a pair: 0 left, 1 right
};

/// Where the axes of a chart lie in its picture and what they span: from a pixel to values.
struct ChartPlace {
  double left = 0, right = 0, top = 0, bottom = 0; ///< [pixel] from the upper left corner
  double xLow = 0, xHigh = 1, yLow = 0, yHigh = 1;
};

/// How a chart in a window looks; in files it is as here.
struct ChartLook {
  std::array<double, 3> ground{1, 1, 1}; ///< ink and lines are as light or dark as it asks for
  float textScale = 1;                   ///< of letters and lines
};

class Renderer {
public:
  explicit Renderer(GlBackend backend = GlBackend::automatic);
  ~Renderer();

  /// Draws frame with view. The same frame, view and back end give the same pixels.
  Image draw(const Frame& frame, const View& view);

  /// Two frames side by side through one camera, each in half of the picture; `left.width` is that of both
  /// together. pick() answers for both halves. Two runs may each have a history.
  Image drawPair(const Frame& left, const Frame& right, const View& leftView, const View& rightView,
                 std::shared_ptr<const History> leftHistory = nullptr,
                 std::shared_ptr<const History> rightHistory = nullptr);

  /// What the next pictures need of other frames (original positions, tracks); null: nothing.
  void setHistory(std::shared_ptr<const History> history);

  void setDetail(const Detail& detail);

  /// Grains that the last picture sent to the rasteriser.
  std::size_t drawnGrains() const;

  /// Draws a chart with VTK charts.
  Image draw(const analysis::Curve& curve, int width, int height, const ChartLook& look = {});
  ChartPlace chartPlace() const; ///< of the chart drawn last

  /// The grain under a pixel of the last drawn frame, by the same clip planes as drawing.
  PickResult pick(int x, int y) const;

  /// Ids of the grains whose centres lie in a rectangle of the last picture, corners in any order, ascending;
  /// those behind others too, clipped and hidden ones not. Of a pair, of the half in which it begins.
  std::vector<std::int64_t> grainsIn(int x0, int y0, int x1, int y1) const;

  /// The camera that the last draw() used, with presets resolved: what a mouse drag starts from.
  Camera resolvedCamera() const;

  std::string backendName() const; ///< "osmesa" or "egl" and the GL strings

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Camera moves for the mouse; angles in degrees.
Camera orbit(const Camera& camera, double azimuth, double elevation);
Camera zoom(const Camera& camera, double factor);
Camera pan(const Camera& camera, double right, double up); ///< shares of the view height

/// PNG with text chunks (tEXt/iTXt): provenance, view.
void writePng(const Image& image, const std::filesystem::path& file,
              const std::map<std::string, std::string>& text);
Image readPng(const std::filesystem::path& file, std::map<std::string, std::string>* text = nullptr);

/// Share of pixels that differ by more than `perChannel` (0..255) in any channel; 1 when sizes differ.
double difference(const Image& a, const Image& b, int perChannel = 8);

/// Pipes frames to the ffmpeg program (H.264 MP4). Throws Error with a sentence when ffmpeg is missing.
class Movie {
public:
  Movie(const std::filesystem::path& file, int width, int height, double framesPerSecond,
        const std::map<std::string, std::string>& metadata);
  ~Movie();
  void add(const Image& image);
  void close();

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace sandglass::vis
