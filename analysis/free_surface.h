#pragma once
// The free surface of a bed as a height field of the highest grain centres along the up direction.

#include "sim/frame/frame.h"

#include <vector>

namespace sandglass::analysis {

/// Right-handed axes with `up` third. The horizontal ones are coordinate axes wherever up is one.
struct UpFrame {
  Vec3 e1 = Vec3::UnitX(), e2 = Vec3::UnitY(), up = Vec3::UnitZ();
  explicit UpFrame(const Vec3& upDirection);
};

/// Columns about `columnWidth` wide; each holds the height of its highest centre, -infinity when empty.
/// Grains in flight (fewer than four others within 1.5 `diameter` above or beside) do not make a surface.
class FreeSurface {
public:
  FreeSurface(const Frame& frame, const Vec3& up, double columnWidth, double diameter);

  /// Height of the surface above x, along up [m].
  double heightAt(const Vec3& x) const { return height_[column(x)]; }

  /// Lowest surface within `reach` of x, measured level; -infinity where a column in reach is empty.
  double lowestNear(const Vec3& x, double reach) const;

  double highest() const;
  const UpFrame& axes() const { return axes_; }
  /// All columns' heights, empty ones included.
  const std::vector<double>& heights() const { return height_; }

private:
  std::size_t column(const Vec3& x) const;
  struct Direction {
    Vec3 axis = Vec3::Zero();
    double origin = 0, width = 1;
    int count = 1;
    bool periodic = false;
    int index(double s) const;
  };
  UpFrame axes_;
  Direction first_, second_;
  std::vector<double> height_;
};

} // namespace sandglass::analysis
