#include "sim/grains/grain_store.h"

namespace sandglass {

namespace {

constexpr std::size_t phantoms = 2;
constexpr std::int64_t grainsPerPiece = 4096;

template <class T>
void permute(std::vector<T>& values, const std::vector<std::int32_t>& order, Parallel& parallel,
             std::size_t extra = 0, std::size_t stride = 1) {
  std::vector<T> moved((order.size() + extra) * stride);
  parallel.forRange(static_cast<std::int64_t>(order.size()), grainsPerPiece,
                    [&](std::int64_t first, std::int64_t last) {
                      for (std::int64_t i = first; i < last; ++i)
                        for (std::size_t k = 0; k < stride; ++k)
                          moved[i * stride + k] = values[order[i] * stride + k];
                    });
  values = std::move(moved);
}

} // namespace

void GrainStore::keep(bool turningGrains, bool imagedGrains) {
  turning = turningGrains;
  imaged = imagedGrains;
  resize(0);
}

void GrainStore::placePhantoms() {
  const int stride = quadsPerRecord();
  Quad* first = records_.data();
  place = {first, stride};
  motion = {first + 1, stride};
  if (turning) roll = {first + 2, stride};
  material.resize(size() + phantoms, 0);
  for (std::size_t k = 0; k < phantoms; ++k) {
    const std::size_t i = size() + k;
    place[i] = {k == 0 ? 1e6 : -1e6, 0.0, 0.0, 1e-3};
    motion[i] = {0.0, 0.0, 0.0, 1.0};
    if (turning) roll[i] = {0.0, 0.0, 0.0, 1e3};
    material[i] = 0;
  }
}

void GrainStore::setRecords(std::vector<Quad> records) {
  records_ = std::move(records);
  placePhantoms();
}

void GrainStore::reorder(const std::vector<std::int32_t>& order, Parallel& parallel) {
  permute(records_, order, parallel, phantoms, quadsPerRecord());
  permute(listed, order, parallel);
  permute(id, order, parallel);
  permute(species, order, parallel);
  permute(material, order, parallel, phantoms);
  if (imaged) permute(image, order, parallel);
  for (auto& values : quantities)
    permute(values, order, parallel);
  placePhantoms();
}

void GrainStore::resize(std::size_t n) {
  records_.resize((n + phantoms) * quadsPerRecord());
  listed.resize(n);
  id.resize(n);
  species.resize(n);
  material.resize(n);
  if (imaged) image.resize(n);
  for (auto& values : quantities)
    values.resize(n);
  placePhantoms();
}

std::size_t GrainStore::bytesPerGrain() const {
  return sizeof(Quad) * (quadsPerRecord() + 1) + sizeof(std::int64_t) + sizeof(std::int16_t) +
         sizeof(std::uint8_t) + (imaged ? sizeof(image[0]) : 0) + sizeof(double) * quantities.size();
}

} // namespace sandglass
