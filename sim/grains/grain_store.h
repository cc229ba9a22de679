#pragma once
// The grains of a running solver, in storage order (by cell, so that neighbours in space are neighbours in
// memory). What the particle loop reads of a grain stands in one record: two quads, or three where grains
// turn. What a scene does not use stays empty: no spin where nothing turns grains, no image counters without
// periodic directions.

#include "sim/base/aligned.h"
#include "sim/base/parallel.h"
#include "sim/base/vec.h"

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace sandglass {

/// Four doubles that load as one vector register.
struct alignas(32) Quad {
  double x = 0, y = 0, z = 0, w = 0;
  Vec3 vec() const { return {x, y, z}; }
};

/// One quad of every record.
class QuadColumn {
public:
  QuadColumn() = default;
  QuadColumn(Quad* first, int stride) : first_(first), stride_(stride) {}
  Quad& operator[](std::size_t i) const { return first_[i * stride_]; }

private:
  Quad* first_ = nullptr;
  std::size_t stride_ = 0;
};

class GrainStore {
public:
  GrainStore() = default;
  GrainStore(GrainStore&&) = default; // records do not move, so columns stay
  GrainStore(const GrainStore&) = delete;
  GrainStore& operator=(const GrainStore&) = delete;

  /// Says what is kept; before the first grain comes.
  void keep(bool turning, bool imaged);

  bool turning = false; ///< spins are kept
  bool imaged = false;  ///< image counters are kept

  QuadColumn place;  ///< position [m], radius [m]
  QuadColumn motion; ///< velocity [m/s], 1/mass [1/kg]
  QuadColumn roll;   ///< radius times spin [m/s], 1/radius [1/m]; when turning
  AlignedVector<Quad>
      listed; ///< position when the list was built, and how far the grain may move from it [m]
  std::vector<std::int64_t> id;
  std::vector<std::int16_t> species;
  std::vector<std::uint8_t> material; ///< two more at the end, for the phantoms
  std::vector<std::array<std::int32_t, 3>>
      image; ///< how often a grain left through its upper minus lower side
  std::vector<std::string> quantityNames;
  std::vector<std::vector<double>> quantities; ///< conserved quantities that laws ask for

  std::size_t size() const { return id.size(); }
  double mass(std::size_t i) const { return 1.0 / motion[i].w; }
  Vec3 spin(std::size_t i) const { return roll[i].w * roll[i].vec(); } ///< [rad/s]
  /// Moment of inertia of a sphere [kg m^2].
  double inertia(std::size_t i) const { return 0.4 * place[i].w * place[i].w / motion[i].w; }

  int quadsPerRecord() const { return turning ? 3 : 2; }
  /// All records, and behind them two phantoms far apart, which pad lists of pairs and touch nobody.
  AlignedVector<Quad>& records() { return records_; }
  const AlignedVector<Quad>& records() const { return records_; }
  /// Takes records as a checkpoint kept them.
  void setRecords(AlignedVector<Quad> records);

  /// Told that the records of the grains first .. last - 1 stand in their new order; while they are in the
  /// cache, and from several threads at once. Grains come in runs that begin at multiples of `run`.
  using Placed = std::function<void(std::int64_t first, std::int64_t last)>;
  static constexpr std::int64_t run = 32;

  /// Keeps the grains listed in `order` (storage indices), in that order.
  /// Of `listed`, only w goes with a grain, and nothing at all if `placed` is given, which may write it.
  /// `scratch` is memory to work in, made larger if need be; what it held is lost, since records change
  /// places with it.
  void reorder(const std::vector<std::int32_t>& order, Parallel& parallel, AlignedVector<Quad>& scratch,
               const Placed& placed = {});
  void resize(std::size_t n);
  std::size_t bytesPerGrain() const;

private:
  void placePhantoms();
  void pointAtRecords();

  AlignedVector<Quad> records_;
};

} // namespace sandglass
