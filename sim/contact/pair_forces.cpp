#include "sim/contact/pair_forces.h"

#include "sim/base/error.h"
#include "sim/contact/mixed/mixed_loops.h"

#include <array>

namespace sandglass {

void PairForces::watchOverlap(double share, double smallestRadius) {
  overlapShare_ = share;
  overlapLength_ = share * smallestRadius;
}

void PairForces::bind(GrainStore& grains, PairList& list) {
  grains_ = &grains;
  list_ = &list;
  kernel_ = laws_.mixed() ? mixedKernel(laws_.width()) : kernelOf(laws_.width());
  view_.records = &grains.records().data()->x;
  view_.quads = grains.quadsPerRecord();
  view_.pairs = reinterpret_cast<const std::int32_t*>(list.pairs().data()); // of an empty list too
  view_.shiftOf = list.periodic() ? list.shiftOf().data() : nullptr;
  view_.shifts = list.periodic() ? &list.shifts().data()->x : nullptr;
  view_.noShift = static_cast<std::uint8_t>(list.shifts().size() / 2); // codes are symmetric about the box
  view_.material = grains.material.data();
  view_.materials = laws_.materials();
  const int material = grains.size() > 0 ? grains.material[0] : 0;
  view_.oneMaterial = std::all_of(grains.material.begin(), grains.material.begin() + grains.size(),
                                  [material](std::uint8_t m) { return m == material; });
  view_.oneType = laws_.typeOf(material, material);
  view_.history = list.history();
  view_.historySize = list.historySize();
  view_.quiet = list.quiet();
  view_.outputQuads = laws_.outputQuads();
  view_.outputStride = laws_.outputStride();
  view_.readsSpin = laws_.readsSpin();
  view_.radiusArm = laws_.fullRadiusArm();
  view_.ownTorque = laws_.ownTorque();
  view_.sumsOverlaps = laws_.sumsOverlaps();
  view_.reads = laws_.reads();
  view_.oneRadius = list.oneRadius();
  view_.oneInverseMass = list.oneInverseMass();
  pickLoop(material);
  if (!laws_.mixed()) return;
  mixed_.bind(grains, list, view_);
  refresh();
}

void PairForces::refresh() {
  if (view_.mixed) MixedRecords::refresh(kernel_, view_, static_cast<std::int64_t>(grains_->size()));
}

/// Several materials: makes the tables of constants; false where there are too many.
bool PairForces::bindTables() {
  std::vector<int> known; // materials of grains
  std::array<std::uint8_t, 256> placeOf{};
  for (std::size_t i = 0; i < grains_->size(); ++i) {
    const std::uint8_t m = grains_->material[i];
    if (std::find(known.begin(), known.end(), m) != known.end()) continue;
    if (known.size() == FusedTables::materials) return false;
    placeOf[m] = static_cast<std::uint8_t>(known.size());
    known.push_back(m);
  }
  const auto place = [&](int a, int b) {
    return static_cast<std::uint8_t>(placeOf[a] * FusedTables::materials + placeOf[b]);
  };
  for (const int a : known)
    for (const int b : known) {
      FusedLaws laws;
      laws.type = laws_.typeOf(a, b);
      for (const auto& entry : laws_.entries())
        entry.law->fuse(laws);
      tables_.put(place(a, b), laws);
    }
  placeOfPair_.resize(static_cast<std::size_t>(list_->entries()));
  for (std::size_t p = 0; p < placeOfPair_.size(); ++p) {
    const auto [a, b] = list_->pairs()[p];
    placeOfPair_[p] = place(grains_->material[a], grains_->material[b]);
  }
  fused_.tables = &tables_;
  fused_.placeOfPair = placeOfPair_.data();
  return true;
}

void PairForces::pickLoop(int material) {
  fused_ = laws_.fused(material);
  fusedLoop_ = nullptr;
  const bool linear =
      fused_.normal == FusedLaws::Normal::linear || fused_.normal == FusedLaws::Normal::linearOfMass;
  const bool possible = !view_.sumsOverlaps;
  if (laws_.mixed()) {
    fusedLoop_ = possible && view_.oneMaterial && (linear || view_.oneRadius > 0.0)
                     ? mixedLoop(fused_, laws_.width(), laws_.fastArithmetic())
                     : nullptr;
    if (!fusedLoop_ && grains_->size() > 0) throw InputError(LawStack::mixedRule);
    return;
  }
  if (!possible || (!view_.oneMaterial && !bindTables())) return;
  if (fused_.normal == FusedLaws::Normal::hertz && view_.oneRadius == 0.0)
    fused_.normal = FusedLaws::Normal::hertzOfSize;
  if (laws_.width() == KernelWidth::avx512) fusedLoop_ = fusedLoopAvx512(fused_, laws_.fastArithmetic());
  if (laws_.width() == KernelWidth::avx2) fusedLoop_ = fusedLoopAvx2(fused_);
}

void PairForces::fillBlock(std::int64_t first, int count, double dt, ContactBlock& b,
                           PairColumns& columns) const {
  b.dt = dt;
  kernel_.fill(view_, first, count, b, columns);
}

void PairForces::evaluate(PairList::Range range, double dt, bool keepHistory, Scratch& scratch,
                          double* out) const {
  constexpr int capacity = ContactBlock::capacity;
  for (; range.begin < range.end; range.begin += capacity, out += capacity * view_.outputStride)
    evaluateBlock({range.begin, std::min(range.begin + capacity, range.end)}, dt, keepHistory, scratch, out,
                  {}, nullptr);
}

void PairForces::addBlock(PairList::Range range, double dt, bool keepHistory, Scratch& scratch, SumRing sums,
                          std::int64_t ahead) const {
  const std::int64_t record = ahead * 4 * view_.quads;
  evaluateBlock(range, dt, keepHistory, scratch, scratch.outputs, sums,
                view_.mixed ? reinterpret_cast<const char*>(view_.mixed + record)
                            : reinterpret_cast<const char*>(view_.records + record));
}

void PairForces::evaluateBlock(PairList::Range range, double dt, bool keepHistory, Scratch& scratch,
                               double* out, SumRing sums, const char* ahead) const {
  const std::int64_t first = range.begin;
  const int count = static_cast<int>(range.end - first);
  if (fusedLoop_) {
    if (fusedLoop_(view_, fused_, first, range.end, dt, keepHistory, out, sums, ahead) <= overlapLength_)
      return;
    fillBlock(first, count, dt, scratch.block, scratch.columns); // grains have not moved: who was it?
    reportOverlaps(first, scratch);
    return;
  }
  // As the loops of their own do: the records that as many pairs will need, three a grain.
  for (int k = 0; ahead && k < count * 4 * view_.quads / 3; k += 8)
    __builtin_prefetch(ahead + k * sizeof(double), 1, 2);
  fillBlock(first, count, dt, scratch.block, scratch.columns);
  applyLaws(first, scratch);
  reportOverlaps(first, scratch);
  kernel_.write(view_, first, scratch.block, scratch.columns, keepHistory, out);
  if (sums.rows) kernel_.add(view_, first, count, out, sums);
}

void PairForces::applyLaws(std::int64_t first, Scratch& scratch) const {
  ContactBlock& b = scratch.block;
  if (laws_.range() == 0.0) {
    laws_.addForces(b);
    return;
  }
  // Laws across a gap: some pairs of the list are beyond their range, and some are born or die.
  double before[ContactBlock::maxHistory][ContactBlock::capacity];
  for (int k = 0; k < laws_.historySize(); ++k)
    std::copy_n(b.history[k], b.size, before[k]);
  for (std::size_t l = 0; l < laws_.entries().size(); ++l) {
    const auto& entry = laws_.entries()[l];
    const bool watched = laws_.hasEvents() && entry.role == LawRole::gap;
    if (watched) std::fill_n(b.event, b.size, noEvent);
    entry.law->apply(b, entry.firstHistory, laws_.width());
    if (!watched) continue;
    for (int c = 0; c < b.size; ++c)
      if (b.event[c] != noEvent && b.overlap[c] > -laws_.range()) {
        const auto [i, j] = list_->pairs()[first + c];
        scratch.events.push_back({grains_->id[i], grains_->id[j], list_->imageKey(first + c, *grains_),
                                  first + c, static_cast<std::int16_t>(l),
                                  static_cast<ContactEvent>(b.event[c])});
      }
  }
  leaveRange(first, before, scratch);
}

void PairForces::leaveRange(std::int64_t first, const double (*before)[ContactBlock::capacity],
                            Scratch& scratch) const {
  ContactBlock& b = scratch.block;
  std::uint8_t* live = list_->live();
  for (int c = 0; c < b.size; ++c) {
    if (b.overlap[c] > -laws_.range()) {
      if (live) live[first + c] = 1;
      continue;
    }
    b.normalForce[c] = b.ftx[c] = b.fty[c] = b.ftz[c] = 0.0;
    if (laws_.readsSpin()) b.mx[c] = b.my[c] = b.mz[c] = 0.0;
    const bool parted = live && live[first + c];
    for (int k = 0; k < laws_.historySize(); ++k)
      b.history[k][c] = parted ? before[k][c] : 0.0;
    if (!parted) continue; // else: forget, after the gap laws have been told
    live[first + c] = 0;
    const auto [i, j] = list_->pairs()[first + c];
    for (std::size_t l = 0; l < laws_.entries().size(); ++l)
      if (laws_.entries()[l].role == LawRole::gap)
        scratch.events.push_back({grains_->id[i], grains_->id[j], list_->imageKey(first + c, *grains_),
                                  first + c, static_cast<std::int16_t>(l), deathEvent, true});
  }
}

void PairForces::reportOverlaps(std::int64_t first, Scratch& scratch) const {
  const ContactBlock& b = scratch.block;
  double deepest[8] = {};
  for (int c = 0; c < b.size; c += 8)
    for (int l = 0; l < 8; ++l)
      deepest[l] = b.overlap[c + l] > deepest[l] ? b.overlap[c + l] : deepest[l];
  if (*std::max_element(deepest, deepest + 8) <= overlapLength_) return;
  for (int c = 0; c < b.size; ++c) {
    const auto [i, j] = list_->pairs()[first + c];
    const double share = b.overlap[c] / std::min(grains_->place[i].w, grains_->place[j].w);
    if (share > overlapShare_ && !list_->isPadding(first + c))
      scratch.deepest.take(share, grains_->id[i], grains_->id[j], -1);
  }
}

double PairForces::storedEnergy(double dt) const {
  double sum = 0.0;
  visitContacts(dt, [&](std::int64_t, const ContactBlock& block, int c) {
    for (const auto& entry : laws_.entries())
      sum += entry.law->storedEnergy(block, c, entry.firstHistory);
  });
  return sum;
}

} // namespace sandglass
