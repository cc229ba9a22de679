#include "sim/fields/field_stack.h"

#include "sim/base/error.h"
#include "sim/contact/pair_load_avx2.h"
#include "sim/math/exponential.h"

#include <fmt/format.h>

#include <algorithm>

namespace sandglass {

namespace {

/// Frozen grains have next to no inverse mass; nothing moves them, and nothing does work on them.
constexpr double freeInverseMass = 1e-20;

/// Adds columns to a quad of each grain's sums.
void addQuads(GroupSums sums, int quad, int size, const double* x, const double* y, const double* z) {
  for (int i = 0; i < size; i += 4) {
    const Columns columns =
        transpose(_mm256_load_pd(x + i), _mm256_load_pd(y + i), _mm256_load_pd(z + i), _mm256_setzero_pd());
    const __m256d rows[4] = {columns.x, columns.y, columns.z, columns.w};
    for (int k = 0; k < 4 && i + k < size; ++k) {
      double* at = sums.at(i + k) + 4 * quad;
      _mm256_store_pd(at, _mm256_add_pd(_mm256_load_pd(at), rows[k]));
    }
  }
}

} // namespace

const FieldBlock::Column& FieldBlock::falloff(double decay, double reference, const Vec3& axis) {
  if (decay == decay_ && reference == reference_ && axis == axis_) return falloff_;
  decay_ = decay;
  reference_ = reference;
  axis_ = axis;
  const double nx = axis.x(), ny = axis.y(), nz = axis.z();
  if (nx == 0.0 && ny == 0.0) {
    SANDGLASS_GRAINS(i) falloff_[i] = exponential(-decay * (nz * z[i] - reference));
  } else {
    SANDGLASS_GRAINS(i) falloff_[i] = exponential(-decay * (nx * x[i] + ny * y[i] + nz * z[i] - reference));
  }
  return falloff_;
}

FieldStack::FieldStack(const Scene& scene) {
  for (const FieldSpec& spec : scene.fields) {
    const FieldKind* kind = findField(spec.what.kind);
    if (!kind) throw InputError(fmt::format("there is no field kind '{}'", spec.what.kind));
    parts_.push_back({spec.name, kind->role, kind->make(spec.what.parameters), 1.0, {}});
  }
  resolve(scene);
  for (const FieldRole role : {FieldRole::lift, FieldRole::drag, FieldRole::spin})
    for (std::size_t k = 0; k < parts_.size(); ++k)
      if (parts_[k].role == role) order_.push_back(static_cast<int>(k));
  overlaps_ =
      std::any_of(parts_.begin(), parts_.end(), [](const Part& p) { return p.field->readsOverlaps(); });
  spins_ = std::any_of(parts_.begin(), parts_.end(), [](const Part& p) { return p.role == FieldRole::spin; });
}

void FieldStack::resolve(const Scene& scene) {
  const auto names = [&](std::size_t k, const char* key, const std::string& name) {
    const Parameters& p = scene.fields[k].what.parameters;
    if (!p.has(key)) return true; // all
    const auto& list = p.texts(key);
    return std::find(list.begin(), list.end(), name) != list.end();
  };
  for (const FieldRole role : {FieldRole::flow, FieldRole::shield})
    for (std::size_t drag = 0; drag < parts_.size(); ++drag)
      for (std::size_t other = 0; other < parts_.size(); ++other) {
        if (parts_[drag].role != FieldRole::drag || parts_[other].role != role) continue;
        const bool felt = role == FieldRole::flow ? names(drag, "flows", parts_[other].name)
                                                  : names(other, "of", parts_[drag].name);
        if (felt) parts_[drag].others.push_back(static_cast<int>(other));
      }
}

void FieldStack::setFactor(const std::string& name, double factor) {
  for (Part& part : parts_)
    if (part.name == name) {
      part.factor = factor;
      return;
    }
  throw InputError(fmt::format("there is no field '{}'", name));
}

void FieldStack::list(const GrainStore& grains, const PairList& pairs, Parallel& parallel) {
  worked_ = work();
  groupWork_.assign((grains.size() + FieldBlock::capacity - 1) / FieldBlock::capacity, 0.0);
  for (Part& part : parts_)
    if (part.field->looks()) part.field->list(grains, pairs, parallel);
}

void FieldStack::look(const GrainStore& grains, const PairList& pairs, double time, Parallel& parallel) {
  time_ = time;
  for (Part& part : parts_)
    if (part.factor != 0.0 && part.field->looks()) part.field->look(grains, pairs, parallel);
}

void FieldStack::fill(FieldBlock& b, GroupSums sums, const GrainStore& grains, const Vec3& gravity,
                      bool couples) const {
  const bool spins = spins_ && grains.turning;
  const auto store = [](double* column, int i, __m256d values) { _mm256_store_pd(column + i, values); };
  const __m256d gx = _mm256_set1_pd(gravity.x()), gy = _mm256_set1_pd(gravity.y()),
                gz = _mm256_set1_pd(gravity.z());
  for (int i = 0; i < FieldBlock::capacity; i += 4) {
    const auto at = [&](int k) { return std::min(i + k, b.size - 1); }; // lanes behind the last repeat it
    const auto columnsOf = [&](const QuadColumn& column) {
      const auto load = [&](int k) { return _mm256_load_pd(&column[b.first + at(k)].x); };
      return transpose(load(0), load(1), load(2), load(3));
    };
    const auto sumsOf = [&](int quad) {
      const auto load = [&](int k) { return _mm256_load_pd(sums.at(at(k)) + 4 * quad); };
      return transpose(load(0), load(1), load(2), load(3));
    };
    const Columns place = columnsOf(grains.place), motion = columnsOf(grains.motion), force = sumsOf(0);
    store(b.x, i, place.x), store(b.y, i, place.y), store(b.z, i, place.z), store(b.radius, i, place.w);
    store(b.vx, i, motion.x), store(b.vy, i, motion.y), store(b.vz, i, motion.z);
    store(b.inverseMass, i, motion.w);
    store(b.ax, i, _mm256_add_pd(_mm256_mul_pd(force.x, motion.w), gx));
    store(b.ay, i, _mm256_add_pd(_mm256_mul_pd(force.y, motion.w), gy));
    store(b.az, i, _mm256_add_pd(_mm256_mul_pd(force.z, motion.w), gz));
    if (!spins && !overlaps_) continue;
    Columns torque = sumsOf(1);
    store(b.overlap, i, torque.w);
    if (!spins) continue;
    const Columns roll = columnsOf(grains.roll);
    store(b.rollX, i, roll.x), store(b.rollY, i, roll.y), store(b.rollZ, i, roll.z);
    if (couples) {
      const Columns couple = sumsOf(2);
      torque.x = _mm256_add_pd(torque.x, _mm256_mul_pd(couple.x, roll.w));
      torque.y = _mm256_add_pd(torque.y, _mm256_mul_pd(couple.y, roll.w));
      torque.z = _mm256_add_pd(torque.z, _mm256_mul_pd(couple.z, roll.w));
    }
    store(b.turnX, i, torque.x), store(b.turnY, i, torque.y), store(b.turnZ, i, torque.z);
  }
}

void FieldStack::pass(FieldBlock& b) const {
  const std::vector<int>* felt = nullptr; // what the columns of flow and exposure hold
  for (const int k : order_) {
    const Part& part = parts_[k];
    if (part.factor == 0.0) continue;
    if (part.role == FieldRole::drag && (!felt || *felt != part.others)) {
      SANDGLASS_GRAINS(i) {
        b.flowX[i] = b.flowY[i] = b.flowZ[i] = 0.0;
        b.exposure[i] = 1.0;
      }
      for (const int other : part.others)
        if (parts_[other].factor != 0.0) parts_[other].field->apply(b, parts_[other].factor);
      felt = &part.others;
    }
    part.field->apply(b, part.factor);
  }
}

void FieldStack::addTo(GroupSums sums, const GrainStore& grains, std::int64_t first, std::int64_t last,
                       double dt, const Vec3& gravity, bool couples, bool count) {
  FieldBlock b;
  b.first = first;
  b.size = static_cast<int>(last - first);
  b.dt = dt;
  b.time = time_;
  fill(b, sums, grains, gravity, couples);
  alignas(32) FieldBlock::Column ax, ay, az, tx, ty, tz;
  SANDGLASS_GRAINS(i) {
    ax[i] = b.ax[i];
    ay[i] = b.ay[i];
    az[i] = b.az[i];
  }
  const bool spins = spins_ && grains.turning;
  if (spins) SANDGLASS_GRAINS(i) {
      tx[i] = b.turnX[i];
      ty[i] = b.turnY[i];
      tz[i] = b.turnZ[i];
    }
  pass(b);
  FieldBlock::Column work;
  SANDGLASS_GRAINS(i) {
    const double mass = b.inverseMass[i] > freeInverseMass ? 1.0 / b.inverseMass[i] : 0.0;
    ax[i] = mass * (b.ax[i] - ax[i]);
    ay[i] = mass * (b.ay[i] - ay[i]);
    az[i] = mass * (b.az[i] - az[i]);
    // Force times the mean velocity of the step: what leapfrog adds to the kinetic energy.
    work[i] = dt * (ax[i] * (b.vx[i] + 0.5 * dt * b.ax[i]) + ay[i] * (b.vy[i] + 0.5 * dt * b.ay[i]) +
                    az[i] * (b.vz[i] + 0.5 * dt * b.az[i]));
  }
  addQuads(sums, 0, b.size, ax, ay, az);
  if (spins) {
    SANDGLASS_GRAINS(i) {
      const bool free = b.inverseMass[i] > freeInverseMass;
      tx[i] = free ? b.turnX[i] - tx[i] : 0.0;
      ty[i] = free ? b.turnY[i] - ty[i] : 0.0;
      tz[i] = free ? b.turnZ[i] - tz[i] : 0.0;
      const double turn = 1.25 * dt * b.inverseMass[i]; // half of what the loop multiplies torques by
      work[i] += dt * (tx[i] * (b.rollX[i] + turn * b.turnX[i]) + ty[i] * (b.rollY[i] + turn * b.turnY[i]) +
                       tz[i] * (b.rollZ[i] + turn * b.turnZ[i]));
    }
    addQuads(sums, 1, b.size, tx, ty, tz);
  }
  if (!count) return;
  double sum = 0.0;
  for (int i = 0; i < b.size; ++i)
    sum += work[i];
  groupWork_[first / FieldBlock::capacity] += sum;
}

double FieldStack::work() const {
  double sum = worked_;
  for (const double work : groupWork_)
    sum += work;
  return sum;
}

std::vector<double> FieldStack::factors() const {
  std::vector<double> all;
  for (const Part& part : parts_)
    all.push_back(part.factor);
  return all;
}

void FieldStack::setFactors(const std::vector<double>& factors) {
  if (factors.size() != parts_.size())
    throw InputError("the checkpoint has another number of fields; it belongs to another scene or version");
  for (std::size_t k = 0; k < parts_.size(); ++k)
    parts_[k].factor = factors[k];
}

std::vector<double> FieldStack::workState() const {
  std::vector<double> state{worked_};
  state.insert(state.end(), groupWork_.begin(), groupWork_.end());
  return state;
}

void FieldStack::setWorkState(const std::vector<double>& state) {
  if (state.size() != groupWork_.size() + 1)
    throw InputError("the checkpoint's work of fields does not fit the scene; it belongs to another scene or "
                     "version");
  worked_ = state[0];
  std::copy(state.begin() + 1, state.end(), groupWork_.begin());
}

double fastestFlow(const Scene& scene) {
  double sum = 0.0;
  for (const FieldSpec& spec : scene.fields)
    if (const FieldKind* kind = findField(spec.what.kind))
      sum += kind->make(spec.what.parameters)->topSpeed(scene.domain);
  return sum;
}

} // namespace sandglass
