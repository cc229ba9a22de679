#include "analysis/sweep/sweep_blobs.h"

#include <bit>
#include <cstring>

namespace sandglass::analysis {

static_assert(std::endian::native == std::endian::little);

namespace {

template <class T> void put(std::vector<std::byte>& bytes, const T& value) {
  const auto* from = reinterpret_cast<const std::byte*>(&value);
  bytes.insert(bytes.end(), from, from + sizeof value);
}

template <class T> T take(std::span<const std::byte>& bytes) {
  T value{};
  std::memcpy(&value, bytes.data(), sizeof value);
  bytes = bytes.subspan(sizeof value);
  return value;
}

constexpr std::size_t grainSize = sizeof(std::int64_t) + 7 * sizeof(double);

} // namespace

std::vector<std::byte> curveBytes(const Curve& curve) {
  std::vector<std::byte> bytes;
  if (curve.series.empty()) return bytes;
  const Series& s = curve.series.front();
  for (std::size_t k = 0; k < s.x.size(); ++k) {
    put(bytes, static_cast<float>(s.x[k]));
    put(bytes, static_cast<float>(s.y[k]));
  }
  return bytes;
}

void readCurve(std::span<const std::byte> bytes, Curve& curve) {
  Series series{curve.name, {}, {}, {}};
  while (bytes.size() >= 2 * sizeof(float)) {
    series.x.push_back(take<float>(bytes));
    series.y.push_back(take<float>(bytes));
  }
  curve.series = {std::move(series)};
}

std::vector<std::byte> frameBytes(const Frame& frame) {
  std::vector<std::byte> bytes;
  const auto& radius = frame.scalar(quantity::radius);
  const auto* velocity = frame.has(quantity::velocity) ? &frame.vector(quantity::velocity) : nullptr;
  for (std::size_t i = 0; i < frame.size(); ++i) {
    put(bytes, frame.id[i]);
    put(bytes, radius[i]);
    const Vec3 v = velocity ? (*velocity)[i] : Vec3::Zero();
    for (int k = 0; k < 3; ++k)
      put(bytes, frame.position[i][k]);
    for (int k = 0; k < 3; ++k)
      put(bytes, v[k]);
  }
  return bytes;
}

void readFrame(std::span<const std::byte> bytes, Frame& frame) {
  auto& radius = frame.scalars[quantity::radius];
  auto& velocity = frame.vectors[quantity::velocity];
  while (bytes.size() >= grainSize) {
    frame.id.push_back(take<std::int64_t>(bytes));
    radius.push_back(take<double>(bytes));
    Vec3 x, v;
    for (int k = 0; k < 3; ++k)
      x[k] = take<double>(bytes);
    for (int k = 0; k < 3; ++k)
      v[k] = take<double>(bytes);
    frame.position.push_back(x);
    velocity.push_back(v);
  }
}

} // namespace sandglass::analysis
