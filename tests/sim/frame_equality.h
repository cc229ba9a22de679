#pragma once
// Two frames equal to the last bit. Walls' shapes are compared by being there, the rest by value.

#include "sim/frame/frame.h"

#include <catch2/catch.hpp>

#include <cstring>

namespace sandglass::test {

template <class T> bool sameBits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}
inline bool sameBits(const Vec3& a, const Vec3& b) {
  return std::memcmp(a.data(), b.data(), 3 * sizeof(double)) == 0;
}

inline void requireEqual(const Frame& a, const Frame& b) {
  INFO("step " << a.step << " and " << b.step);
  REQUIRE(a.time == b.time);
  REQUIRE(a.step == b.step);
  REQUIRE(a.stage == b.stage);
  REQUIRE(a.persistentIds == b.persistentIds);
  REQUIRE(a.id == b.id);
  REQUIRE(sameBits(a.position, b.position));
  REQUIRE(a.scalars.size() == b.scalars.size());
  for (const auto& [name, values] : a.scalars)
    REQUIRE(sameBits(values, b.scalar(name)));
  REQUIRE(a.vectors.size() == b.vectors.size());
  for (const auto& [name, values] : a.vectors)
    REQUIRE(sameBits(values, b.vector(name)));
  REQUIRE(a.speciesNames == b.speciesNames);
  REQUIRE(a.shapes == b.shapes);
  REQUIRE(sameBits(a.orientation, b.orientation));
  REQUIRE(sameBits(a.domain.lower, b.domain.lower));
  REQUIRE(sameBits(a.domain.upper, b.domain.upper));
  REQUIRE(a.domain.periodic == b.domain.periodic);
  REQUIRE(a.walls.size() == b.walls.size());
  for (std::size_t w = 0; w < a.walls.size(); ++w) {
    REQUIRE(a.walls[w].name == b.walls[w].name);
    REQUIRE((a.walls[w].shape != nullptr) == (b.walls[w].shape != nullptr));
    REQUIRE(a.walls[w].active == b.walls[w].active);
    REQUIRE(sameBits(a.walls[w].velocity, b.walls[w].velocity));
    REQUIRE(sameBits(a.walls[w].force, b.walls[w].force));
    REQUIRE(sameBits(a.walls[w].torque, b.walls[w].torque));
    REQUIRE(sameBits(a.walls[w].spin, b.walls[w].spin));
    REQUIRE(sameBits(a.walls[w].reference, b.walls[w].reference));
    REQUIRE(sameBits(a.walls[w].translation, b.walls[w].translation));
    REQUIRE(a.walls[w].rotation.coeffs() == b.walls[w].rotation.coeffs());
    REQUIRE(a.walls[w].moving == b.walls[w].moving);
    REQUIRE(a.walls[w].work == b.walls[w].work);
    REQUIRE(a.walls[w].power == b.walls[w].power);
    REQUIRE(a.walls[w].wearWork == b.walls[w].wearWork);
    REQUIRE(a.walls[w].collisions == b.walls[w].collisions);
  }
  REQUIRE(a.contacts.size() == b.contacts.size());
  for (std::size_t c = 0; c < a.contacts.size(); ++c) {
    const FrameContact &p = a.contacts[c], &q = b.contacts[c];
    REQUIRE(std::tie(p.a, p.b, p.wall, p.image) == std::tie(q.a, q.b, q.wall, q.image));
    REQUIRE((sameBits(p.point, q.point) && sameBits(p.normal, q.normal) && sameBits(p.force, q.force)));
    REQUIRE(p.overlap == q.overlap);
  }
  REQUIRE(a.provenance == b.provenance);
}

} // namespace sandglass::test
