// Flat rectangles: a single one (a gate, a shelf) and the six faces of a box.

#include "sim/base/error.h"
#include "sim/walls/wall_kinds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace sandglass {

namespace {

/// Centre, two orthogonal unit axes with half widths (infinite allowed), normal to the grain side.
struct Rectangle {
  Vec3 centre, u, v, normal;
  double halfU = 0, halfV = 0;

  Vec3 nearest(const Vec3& x, bool& inside) const {
    const Vec3 d = x - centre;
    const double a = d.dot(u), b = d.dot(v);
    inside = std::abs(a) < halfU && std::abs(b) < halfV;
    return centre + std::clamp(a, -halfU, halfU) * u + std::clamp(b, -halfV, halfV) * v;
  }
};

void addTriangles(const Rectangle& r, TriangleMesh& mesh, double largest) {
  const int first = static_cast<int>(mesh.points.size());
  const double a = std::min(r.halfU, largest), b = std::min(r.halfV, largest);
  for (const auto& [s, t] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
    mesh.points.push_back(r.centre + s * a * r.u + t * b * r.v);
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
  for (int k = 0; k < 4; ++k)
    mesh.edges.push_back({first + k, first + (k + 1) % 4});
}

/// At most six rectangles that together form one wall; features: face k, or edges and corners of face k as 64
/// + k.
class RectangleWall : public WallShape {
public:
  explicit RectangleWall(std::vector<Rectangle> faces) : faces_(std::move(faces)) {}

  void touches(const Vec3& centre, double reach, Touches& out) const override {
    // Faces whose plane is out of reach are out of reach, and so are their edges.
    struct Near {
      int face;
      bool inside;
      Vec3 point;
    };
    std::array<Near, 6> near; // a box has six faces
    int count = 0;
    for (std::size_t k = 0; k < faces_.size(); ++k) {
      if (std::abs((centre - faces_[k].centre).dot(faces_[k].normal)) >= reach) continue;
      Near& face = near[count++];
      face.face = static_cast<int>(k);
      face.point = faces_[k].nearest(centre, face.inside);
      if (face.inside) add(centre, face.point, face.face, reach, out);
    }
    // An edge shared by two faces has the same nearest point for both and counts once, and not at all where
    // it belongs to another face whose interior is nearer: that face is the contact.
    for (int k = 0; k < count; ++k) {
      if (near[k].inside) continue;
      bool covered = false;
      for (int other = 0; other < count && !covered; ++other) {
        if (near[other].inside) {
          bool onOther = false;
          const Vec3 q = faces_[near[other].face].nearest(near[k].point, onOther);
          covered = (q - near[k].point).squaredNorm() < 1e-24;
        } else if (other < k) {
          covered = (near[other].point - near[k].point).squaredNorm() < 1e-24;
        }
      }
      if (!covered) add(centre, near[k].point, 64 + near[k].face, reach, out);
    }
  }

  double signedDistance(const Vec3& x) const override {
    double best = std::numeric_limits<double>::infinity();
    bool behind = false;
    for (const Rectangle& face : faces_) {
      bool inside = false;
      const Vec3 point = face.nearest(x, inside);
      best = std::min(best, (x - point).norm());
      behind = behind || (inside && (x - face.centre).dot(face.normal) < 0.0);
    }
    return behind ? -best : best;
  }

  Eigen::AlignedBox3d bounds() const override {
    Eigen::AlignedBox3d box;
    for (const Rectangle& face : faces_)
      for (const auto& [s, t] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
        box.extend(face.centre + s * face.halfU * face.u + t * face.halfV * face.v);
    return box;
  }

  TriangleMesh mesh(const Eigen::AlignedBox3d& clip) const override {
    TriangleMesh mesh;
    for (const Rectangle& face : faces_)
      addTriangles(face, mesh, clip.diagonal().norm());
    return mesh;
  }

private:
  static void add(const Vec3& centre, const Vec3& point, int feature, double reach, Touches& out) {
    const Vec3 away = centre - point;
    const double d = away.norm();
    if (d < reach && d > 0.0) out.add({d, away / d, feature});
  }

  std::vector<Rectangle> faces_;
};

/// Beyond a corner or an edge no face is right behind a place, which is out of the box all the same: unless
/// one of the sides that it lies beyond is open.
class BoxWall final : public RectangleWall {
public:
  BoxWall(std::vector<Rectangle> faces, const Vec3& lower, const Vec3& upper, std::array<bool, 6> open)
      : RectangleWall(std::move(faces)), lower_(lower), upper_(upper), open_(open) {}

  double signedDistance(const Vec3& x) const override {
    bool outside = false, free = false;
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const std::size_t side : {0u, 1u}) {
        const auto k = static_cast<Eigen::Index>(axis);
        if (side == 0 ? x[k] >= lower_[k] : x[k] <= upper_[k]) continue;
        outside = true;
        free = free || open_[2 * axis + side];
      }
    const double distance = std::abs(RectangleWall::signedDistance(x));
    return outside && !free ? -distance : distance;
  }

private:
  Vec3 lower_, upper_;
  std::array<bool, 6> open_; ///< x-, x+, y-, ...
};

std::shared_ptr<const WallShape> makeBox(const Parameters& p) {
  const Vec3 lower = p.vector("lower"), upper = p.vector("upper");
  if (((upper - lower).array() <= 0.0).any()) throw InputError("upper must lie above lower along every axis");
  const auto& open = p.texts("open");
  const Vec3 centre = 0.5 * (lower + upper), half = 0.5 * (upper - lower);
  std::vector<Rectangle> faces;
  std::array<bool, 6> opened{};
  for (int axis = 0; axis < 3; ++axis)
    for (int side : {-1, 1}) {
      const std::string name = std::string(1, "xyz"[axis]) + (side < 0 ? "-" : "+");
      if (std::find(open.begin(), open.end(), name) != open.end()) {
        opened[static_cast<std::size_t>(2 * axis + (side > 0))] = true;
        continue;
      }
      const int a = (axis + 1) % 3, b = (axis + 2) % 3;
      faces.push_back({centre + side * half[axis] * Vec3::Unit(axis), Vec3::Unit(a), Vec3::Unit(b),
                       -side * Vec3::Unit(axis), half[a], half[b]});
    }
  for (const auto& name : open)
    if (name.size() != 2 || name[0] < 'x' || name[0] > 'z' || (name[1] != '-' && name[1] != '+'))
      throw InputError("open faces are named x-, x+, y-, y+, z- or z+, not '" + name + "'");
  if (faces.empty()) throw InputError("a box needs at least one face that is not open");
  return std::make_shared<BoxWall>(std::move(faces), lower, upper, opened);
}

} // namespace

WallKind rectangleWallKind() {
  return {"rectangle",
          "a flat rectangle: a gate, a shelf; touched from both sides",
          {{"centre", ParameterType::vector, "m", "its middle"},
           {"normal", ParameterType::vector, "1", "points to the side of the grains"},
           {"along", ParameterType::vector, "1", "direction of the first side, made perpendicular to normal"},
           {"length", ParameterType::number, "m", "of the side along 'along'", {}, false, 0.0, 1e30, true},
           {"breadth", ParameterType::number, "m", "of the other side", {}, false, 0.0, 1e30, true}},
          [](const Parameters& p) {
            const Vec3 n = p.vector("normal").normalized();
            const Vec3 u = p.vector("along") - p.vector("along").dot(n) * n;
            if (!(p.vector("normal").norm() > 0.0) || !(u.norm() > 0.0))
              throw InputError("normal and along must not be zero or parallel");
            const Vec3 unit = u.normalized();
            return std::make_shared<RectangleWall>(
                std::vector<Rectangle>{{p.vector("centre"), unit, n.cross(unit), n, 0.5 * p.number("length"),
                                        0.5 * p.number("breadth")}});
          }};
}

WallKind boxWallKind() {
  return {"box",
          "a box seen from inside; faces can be left open",
          {{"lower", ParameterType::vector, "m", "lower corner"},
           {"upper", ParameterType::vector, "m", "upper corner"},
           {"open", ParameterType::texts, "1", "faces left out, of x- x+ y- y+ z- z+",
            std::vector<std::string>{}}},
          makeBox};
}

} // namespace sandglass
