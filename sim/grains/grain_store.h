#pragma once
// The grains of a running solver, in storage order (by cell, so that neighbours in space are neighbours in
// memory). What a scene does not use stays empty: no spin where nothing turns grains, no image counters
// without periodic directions.

#include "sim/base/vec.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace sandglass {

/// Four doubles that load as one vector register.
struct alignas(32) Quad {
  double x = 0, y = 0, z = 0, w = 0;
  Vec3 vec() const { return {x, y, z}; }
};

struct GrainStore {
  bool turning = false; ///< spins and torques are kept
  bool imaged = false;  ///< image counters are kept

  std::vector<Quad> place;  ///< position [m], radius [m]
  std::vector<Quad> motion; ///< velocity [m/s], 1/mass [1/kg]
  std::vector<Quad> force;  ///< [N]
  std::vector<Quad> spin;   ///< [rad/s], 1/inertia [1/(kg m^2)]; when turning
  std::vector<Quad> torque; ///< [N m]; when turning
  std::vector<Quad> listed; ///< position when the list was built, and how far the grain may move from it [m]
  std::vector<std::int64_t> id;
  std::vector<std::int16_t> species;
  std::vector<std::uint8_t> material;
  std::vector<std::array<std::int32_t, 3>>
      image; ///< how often a grain left through its upper minus lower side
  std::vector<std::string> quantityNames;
  std::vector<std::vector<double>> quantities; ///< conserved quantities that laws ask for

  std::size_t size() const { return id.size(); }
  double mass(std::size_t i) const { return 1.0 / motion[i].w; }

  /// New storage order: grain k becomes what was grain order[k]. A shorter `order` drops grains.
  void reorder(const std::vector<std::int32_t>& order);
  void resize(std::size_t n);

  /// Bytes that one grain takes here.
  std::size_t bytesPerGrain() const;
};

} // namespace sandglass
