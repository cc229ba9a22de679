#include "sim/grains/grain_store.h"

#include <algorithm>
#include <utility>

namespace sandglass {

namespace {

constexpr int phantoms = 2;
constexpr std::int64_t grainsPerPiece = 4096;

template <int quads>
void copyRecords(const Quad* from, Quad* to, const std::int32_t* order, std::int64_t first,
                 std::int64_t last) {
  for (std::int64_t i = first; i < last; ++i)
    for (int k = 0; k < quads; ++k)
      to[i * quads + k] = from[std::int64_t{order[i]} * quads + k];
}

/// Moves values through memory that is there already: asking the system for as much anew takes longer.
/// `extra` values at the end keep their meaning.
template <class T>
void permute(std::vector<T>& values, const std::vector<std::int32_t>& order, Parallel& parallel,
             AlignedVector<Quad>& scratch, std::size_t extra = 0) {
  const std::size_t quads = (order.size() * sizeof(T) + sizeof(Quad) - 1) / sizeof(Quad);
  if (scratch.size() < quads) scratch.resize(quads);
  T* const moved = reinterpret_cast<T*>(scratch.data());
  const auto n = static_cast<std::int64_t>(order.size());
  parallel.forRange(n, grainsPerPiece, [&, from = values.data()](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i)
      moved[i] = from[order[i]];
  });
  values.resize(order.size() + extra);
  parallel.forRange(n, grainsPerPiece, [&, to = values.data()](std::int64_t first, std::int64_t last) {
    std::copy(moved + first, moved + last, to + first);
  });
}

/// The same for how far grains may move; positions at listing time are about to be written anew.
void permuteAllowances(AlignedVector<Quad>& listed, const std::vector<std::int32_t>& order,
                       Parallel& parallel, AlignedVector<Quad>& scratch) {
  const std::size_t quads = order.size() / 4 + 1;
  if (scratch.size() < quads) scratch.resize(quads);
  double* const moved = &scratch[0].x;
  const auto n = static_cast<std::int64_t>(order.size());
  parallel.forRange(n, grainsPerPiece, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i)
      moved[i] = listed[order[i]].w;
  });
  listed.resize(order.size());
  parallel.forRange(n, grainsPerPiece, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i)
      listed[i].w = moved[i];
  });
}

} // namespace

void GrainStore::keep(bool turningGrains, bool imagedGrains) {
  turning = turningGrains;
  imaged = imagedGrains;
  resize(0);
}

void GrainStore::pointAtRecords() {
  const int stride = quadsPerRecord();
  Quad* first = records_.data();
  place = {first, stride};
  motion = {first + 1, stride};
  if (turning) roll = {first + 2, stride};
}

void GrainStore::placePhantoms() {
  pointAtRecords();
  material.resize(size() + phantoms, 0);
  for (int k = 0; k < phantoms; ++k) {
    const std::size_t i = size() + k;
    place[i] = {k == 0 ? 1e6 : -1e6, 0.0, 0.0, 1e-3};
    motion[i] = {0.0, 0.0, 0.0, 1.0};
    if (turning) roll[i] = {0.0, 0.0, 0.0, 1e3};
    material[i] = 0;
  }
}

void GrainStore::setRecords(AlignedVector<Quad> records) {
  records_ = std::move(records);
  placePhantoms();
}

void GrainStore::reorder(const std::vector<std::int32_t>& order, Parallel& parallel,
                         AlignedVector<Quad>& scratch, const Placed& placed) {
  const auto n = static_cast<std::int64_t>(order.size());
  makeRoom(scratch, (n + phantoms) * quadsPerRecord());
  std::swap(records_, scratch);
  pointAtRecords();
  if (placed) listed.resize(order.size());
  parallel.forRange((n + run - 1) / run, grainsPerPiece / run, [&](std::int64_t from, std::int64_t to) {
    for (std::int64_t first = from * run; first < std::min(n, to * run); first += run) {
      const std::int64_t last = std::min(n, first + run);
      turning ? copyRecords<3>(scratch.data(), records_.data(), order.data(), first, last)
              : copyRecords<2>(scratch.data(), records_.data(), order.data(), first, last);
      if (placed) placed(first, last);
    }
  });
  if (!placed) permuteAllowances(listed, order, parallel, scratch);
  permute(id, order, parallel, scratch);
  permute(species, order, parallel, scratch);
  permute(material, order, parallel, scratch, phantoms);
  if (imaged) permute(image, order, parallel, scratch);
  for (auto& values : quantities)
    permute(values, order, parallel, scratch);
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
