#include "vis/unhidden.h"

#include "vis/superellipsoid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace sandglass::vis {

namespace {

/// Pixels for a metre at unit depth; for a picture without perspective at any depth.
double pixelsPerMetre(const PictureGeometry& picture) {
  const Camera& camera = picture.camera;
  if (camera.orthographic) return picture.height / camera.orthographicHeight;
  return picture.height / 2.0 / std::tan(camera.viewAngle * std::numbers::pi / 360);
}

struct Seen {
  float front; ///< depth of the foremost point [m]
  std::uint32_t grain;
};

/// A grain as the camera sees it: right, up and forward are x, y and z.
struct Outline {
  Vec3 place = Vec3::Zero(); ///< of its middle, from the eye [m]
  Vec3 reach = Vec3::Zero(); ///< half its box
  double radius = 0;         ///< of the sphere around it
  /// Its inner ellipse in the plane through the middle: xx x^2 + 2 xy x y + yy y^2 <= 1.
  double xx = 0, xy = 0, yy = 0;
};

class Outlines {
public:
  Outlines(const VisibleGrains& grains, const Camera& camera)
      : grains_(grains), eye_(camera.position), axes_(axesOf(camera)) {}

  double front(std::size_t k) const {
    return (grains_.position[k] - eye_).dot(axes_.forward) - reachAlong(k, axes_.forward);
  }
  Outline operator()(std::size_t k) const {
    const Vec3 d = grains_.position[k] - eye_;
    Outline o;
    o.radius = grains_.radius[k];
    o.place = Vec3(d.dot(axes_.right), d.dot(axes_.up), d.dot(axes_.forward));
    if (grains_.isSphere(k)) {
      o.reach.setConstant(grains_.radius[k]);
      o.xx = o.yy = 1 / (grains_.radius[k] * grains_.radius[k]);
      return o;
    }
    o.reach = Vec3(reachAlong(k, axes_.right), reachAlong(k, axes_.up), reachAlong(k, axes_.forward));
    const Vec3 inner = inscribedEllipsoid(shapeOf(k));
    const Eigen::Quaterniond back = grains_.orientation[k].conjugate();
    const Vec3 right = (back * axes_.right).cwiseQuotient(inner), up = (back * axes_.up).cwiseQuotient(inner);
    o.xx = right.squaredNorm();
    o.xy = right.dot(up);
    o.yy = up.squaredNorm();
    return o;
  }

  void fetch(std::size_t k) const {
    __builtin_prefetch(&grains_.position[k]);
    __builtin_prefetch(&grains_.radius[k]);
  }

private:
  const GrainShape& shapeOf(std::size_t k) const {
    return grains_.shapes[static_cast<std::size_t>(grains_.shape[k])];
  }
  double reachAlong(std::size_t k, const Vec3& direction) const {
    if (grains_.isSphere(k)) return grains_.radius[k];
    return support(shapeOf(k), grains_.orientation[k].conjugate() * direction);
  }

  const VisibleGrains& grains_;
  Vec3 eye_;
  CameraAxes axes_;
};

class DepthMap {
public:
  explicit DepthMap(const PictureGeometry& picture)
      : width_(picture.width), height_(picture.height), scale_(pixelsPerMetre(picture)),
        flat_(picture.camera.orthographic),
        depth_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), open),
        tilesAcross_((width_ + tile - 1) / tile),
        tiles_(static_cast<std::size_t>(tilesAcross_) *
               static_cast<std::size_t>((height_ + tile - 1) / tile)) {}

  /// Whether a pixel centre in the grain's rectangle and in the circle around it is open.
  bool mayBeSeen(const Outline& o) const {
    const double front = o.place.z() - o.reach.z(), back = o.place.z() + o.reach.z();
    if (!flat_ && back <= 0) return false;
    if (!flat_ && (front <= 1e-6 * back || o.place.z() <= o.radius)) return true; // around the eye
    const auto [left, right] = across(o.place.x(), o.reach.x(), front, back);
    const auto [bottom, top] = across(o.place.y(), o.reach.y(), front, back);
    const Pixels columns = centres(left + width_ / 2.0, right + width_ / 2.0, width_);
    const Pixels rows = centres(bottom + height_ / 2.0, top + height_ / 2.0, height_);
    if (isCovered(columns, rows, static_cast<float>(front))) return false;
    const Circle circle = around(o);
    const auto [y0, y1] = centres(std::max(bottom + height_ / 2.0, circle.y - circle.radius),
                                  std::min(top + height_ / 2.0, circle.y + circle.radius), height_);
    for (int y = y0; y <= y1; ++y) {
      const double dy = y + 0.5 - circle.y;
      const double half = std::sqrt(std::max(0.0, circle.radius * circle.radius - dy * dy));
      const auto [x0, x1] = centres(std::max(left + width_ / 2.0, circle.x - half),
                                    std::min(right + width_ / 2.0, circle.x + half), width_);
      for (int x = x0; x <= x1; ++x)
        if (depth_[at(x, y)] > front) return true;
    }
    return false;
  }

  /// Pixels whose centres lie in the inner ellipse are covered at its depth.
  void cover(const Outline& o) {
    if (!flat_ && o.place.z() <= o.reach.z()) return;
    const double scale = flat_ ? scale_ : scale_ / o.place.z();
    // Of the ellipse xx x^2 + 2 xy x y + yy y^2 = 1: at height y it runs from (-xy y - w) / xx to
    // (-xy y + w) / xx, w^2 = xx - y^2 (xx yy - xy^2); its highest y is sqrt(xx / (xx yy - xy^2)).
    const double xx = o.xx / (scale * scale), xy = o.xy / (scale * scale), yy = o.yy / (scale * scale);
    const double determinant = xx * yy - xy * xy;
    const double highest = std::sqrt(xx / determinant) - margin;
    if (!(highest > 0)) return;
    const double middleX = o.place.x() * scale + width_ / 2.0;
    const double middleY = o.place.y() * scale + height_ / 2.0;
    const int y0 = std::max(0, static_cast<int>(std::ceil(middleY - highest - 0.5)));
    const int y1 = std::min(height_ - 1, static_cast<int>(std::floor(middleY + highest - 0.5)));
    const auto depth = static_cast<float>(o.place.z());
    int leftmost = width_, rightmost = -1;
    for (int y = y0; y <= y1; ++y) {
      const double dy = y + 0.5 - middleY;
      const double half = std::sqrt(std::max(0.0, xx - dy * dy * determinant)) / xx - margin;
      const double middle = middleX - xy * dy / xx;
      const int x0 = std::max(0, static_cast<int>(std::ceil(middle - half - 0.5)));
      const int x1 = std::min(width_ - 1, static_cast<int>(std::floor(middle + half - 0.5)));
      for (int x = x0; x <= x1; ++x)
        depth_[at(x, y)] = std::min(depth_[at(x, y)], depth);
      leftmost = std::min(leftmost, x0);
      rightmost = std::max(rightmost, x1);
    }
    for (int ty = y0 / tile; ty <= y1 / tile && y0 <= y1; ++ty)
      for (int tx = leftmost / tile; tx <= rightmost / tile && leftmost <= rightmost; ++tx)
        touch(tx, ty);
  }

private:
  struct Interval {
    double low, high;
  };
  /// Picture coordinates that a box can reach along one axis, in pixels from the middle.
  Interval across(double x, double reach, double front, double back) const {
    if (flat_) return {(x - reach) * scale_, (x + reach) * scale_};
    const double near = scale_ / front, far = scale_ / back;
    return {(x - reach) * (x < reach ? near : far), (x + reach) * (x > -reach ? near : far)};
  }
  struct Pixels {
    int first, last;
  };
  /// The farthest depth in a square of pixels, or something farther: it is looked up anew after some changes.
  struct Tile {
    float farthest = open;
    int changes = 0;
  };
  bool isCovered(const Pixels& columns, const Pixels& rows, float front) const {
    if (columns.first > columns.last || rows.first > rows.last) return true; // outside the picture
    for (int ty = rows.first / tile; ty <= rows.last / tile; ++ty)
      for (int tx = columns.first / tile; tx <= columns.last / tile; ++tx)
        if (tiles_[tileAt(tx, ty)].farthest > front) return false;
    return true;
  }
  void touch(int tx, int ty) {
    Tile& t = tiles_[tileAt(tx, ty)];
    constexpr int patience = 4;
    if (++t.changes < patience) return;
    t = {0, 0};
    for (int y = ty * tile; y < std::min(height_, (ty + 1) * tile); ++y)
      for (int x = tx * tile; x < std::min(width_, (tx + 1) * tile); ++x)
        t.farthest = std::max(t.farthest, depth_[at(x, y)]);
  }
  std::size_t tileAt(int tx, int ty) const {
    return static_cast<std::size_t>(ty) * static_cast<std::size_t>(tilesAcross_) +
           static_cast<std::size_t>(tx);
  }
  struct Circle {
    double x, y, radius; ///< [pixel]
  };
  /// Holds the picture of the surrounding sphere. For a point c + d of it, |d| <= r, the picture lies at
  /// (d_xy - d_z c_xy / c_z) / (c_z + d_z) from that of c, at most r sqrt(1 + |c_xy|^2 / c_z^2) / (c_z - r).
  Circle around(const Outline& o) const {
    const double z = o.place.z();
    const double scale = flat_ ? scale_ : scale_ / z;
    const double stretch =
        flat_ ? 1 : std::sqrt(z * z + o.place.head<2>().squaredNorm()) / std::max(z - o.radius, 1e-9 * z);
    return {o.place.x() * scale + width_ / 2.0, o.place.y() * scale + height_ / 2.0,
            o.radius * scale * stretch + margin};
  }
  /// Pixels whose centres lie between two places, the margin included.
  static Pixels centres(double low, double high, int size) {
    const double most = size;
    return {static_cast<int>(std::ceil(std::clamp(low - margin - 0.5, 0.0, most))),
            static_cast<int>(std::floor(std::clamp(high + margin - 0.5, -1.0, most - 1)))};
  }
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  static constexpr double margin = 0.02; ///< [pixel] for rounding in the rasteriser
  static constexpr float open = std::numeric_limits<float>::infinity();
  static constexpr int tile = 8; ///< [pixel]

  int width_, height_;
  double scale_;
  bool flat_;
  std::vector<float> depth_;
  int tilesAcross_;
  std::vector<Tile> tiles_;
};

} // namespace

double pixelsPerMetre(const PictureGeometry& picture, double depth) {
  if (picture.camera.orthographic) return pixelsPerMetre(picture);
  return depth > 0 ? pixelsPerMetre(picture) / depth : 0;
}

double pixelsAcross(const Vec3& place, double radius, const PictureGeometry& picture) {
  const double depth = (place - picture.camera.position).dot(axesOf(picture.camera).forward);
  const double scale = pixelsPerMetre(picture);
  if (picture.camera.orthographic) return 2 * radius * scale;
  return depth > radius ? 2 * radius * scale / depth : std::numeric_limits<double>::infinity();
}

std::vector<std::size_t> unhidden(const VisibleGrains& grains, const PictureGeometry& picture,
                                  bool skipHidden) {
  const Outlines outlines(grains, picture.camera);
  std::vector<Seen> order(grains.size());
  for (std::size_t k = 0; k < grains.size(); ++k)
    order[k] = {static_cast<float>(outlines.front(k)), static_cast<std::uint32_t>(k)};
  std::sort(order.begin(), order.end(), [](const Seen& a, const Seen& b) {
    return a.front < b.front || (a.front == b.front && a.grain < b.grain);
  });
  std::vector<std::size_t> result;
  if (!skipHidden) {
    for (const Seen& seen : order)
      result.push_back(seen.grain);
    return result;
  }
  DepthMap map(picture);
  constexpr std::size_t ahead = 24; // the order jumps through memory: ask for what comes soon
  for (std::size_t n = 0; n < order.size(); ++n) {
    if (n + ahead < order.size()) outlines.fetch(order[n + ahead].grain);
    const Seen& seen = order[n];
    const Outline outline = outlines(seen.grain);
    if (!map.mayBeSeen(outline)) continue;
    result.push_back(seen.grain);
    map.cover(outline);
  }
  return result;
}

} // namespace sandglass::vis
