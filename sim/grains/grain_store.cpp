#include "sim/grains/grain_store.h"

namespace sandglass {

namespace {

template <class T> void permute(std::vector<T>& values, const std::vector<std::int32_t>& order) {
  std::vector<T> moved;
  moved.reserve(order.size());
  for (std::int32_t k : order)
    moved.push_back(values[k]);
  values = std::move(moved);
}

} // namespace

void GrainStore::reorder(const std::vector<std::int32_t>& order) {
  permute(place, order);
  permute(motion, order);
  permute(force, order);
  permute(listed, order);
  if (turning) {
    permute(spin, order);
    permute(torque, order);
  }
  permute(id, order);
  permute(species, order);
  permute(material, order);
  if (imaged) permute(image, order);
  for (auto& values : quantities)
    permute(values, order);
}

void GrainStore::resize(std::size_t n) {
  place.resize(n);
  motion.resize(n);
  force.resize(n);
  listed.resize(n);
  if (turning) {
    spin.resize(n);
    torque.resize(n);
  }
  id.resize(n);
  species.resize(n);
  material.resize(n);
  if (imaged) image.resize(n);
  for (auto& values : quantities)
    values.resize(n);
}

std::size_t GrainStore::bytesPerGrain() const {
  return sizeof(Quad) * (turning ? 6 : 4) + sizeof(std::int64_t) + sizeof(std::int16_t) +
         sizeof(std::uint8_t) + (imaged ? sizeof(image[0]) : 0) + sizeof(double) * quantities.size();
}

} // namespace sandglass
