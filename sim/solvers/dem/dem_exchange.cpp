// What grains hand to each other under laws with events, and who leaves through an outlet.

#include "sim/base/error.h"
#include "sim/solvers/dem/dem_solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace sandglass {

void DemSolver::applyEvents(std::vector<PairEvent>& events) {
  std::sort(events.begin(), events.end(), [](const PairEvent& s, const PairEvent& t) {
    return std::tie(s.idA, s.idB, s.imageKey, s.law) < std::tie(t.idA, t.idB, t.imageKey, t.law);
  });
  for (const PairEvent& e : events) {
    const auto& entry = laws_.entries()[e.law];
    const auto [i, j] = list_.pairs()[e.pair];
    EventGrains grains;
    for (int q : entry.quantities) {
      grains.a.push_back(&grains_.quantities[q][i]);
      grains.b.push_back(&grains_.quantities[q][j]);
    }
    double history[ContactBlock::maxHistory];
    const int size = entry.law->historySize();
    for (int k = 0; k < size; ++k)
      history[k] = list_.historyOf(e.pair, entry.firstHistory + k);
    entry.law->onEvent(e.event, history, grains);
    for (int k = 0; k < size; ++k)
      list_.setHistory(e.pair, entry.firstHistory + k, history[k]);
  }
  for (const PairEvent& e : events)
    for (int k = 0; e.torn && k < list_.historySize(); ++k)
      list_.setHistory(e.pair, k, 0.0);
}

bool DemSolver::discharge() {
  if (scene_.outlets.empty()) return false;
  std::vector<std::uint8_t> drop;
  for (const OutletSpec& outlet : scene_.outlets) {
    const Vec3 n = outlet.normal.normalized();
    for (std::size_t i = 0; i < grains_.size(); ++i) {
      if ((grains_.place[i].vec() - outlet.point).dot(n) <= 0.0) continue;
      if (drop.empty()) drop.assign(grains_.size(), 0);
      drop[i] = 1;
    }
  }
  if (drop.empty()) return false;
  if (laws_.hasEvents()) { // conserved quantities of live pairs go back to their owners first
    std::vector<PairEvent> events;
    for (std::int64_t p = 0; p < list_.entries(); ++p) {
      const auto [i, j] = list_.pairs()[p];
      if (list_.isPadding(p) || !list_.live()[p] || !(drop[i] || drop[j])) continue;
      for (std::size_t l = 0; l < laws_.entries().size(); ++l)
        if (laws_.entries()[l].role == LawRole::gap)
          events.push_back({grains_.id[i], grains_.id[j], list_.imageKey(p, grains_), p,
                            static_cast<std::int16_t>(l), deathEvent, true});
    }
    applyEvents(events);
  }
  for (std::int32_t i : idOrder()) {
    if (!drop[i]) continue;
    ++flow_.grainsDischarged;
    flow_.massDischarged += massOf(i);
    const Vec3 x = grains_.place[i].vec();
    const auto through = std::find_if(scene_.outlets.begin(), scene_.outlets.end(), [&](const OutletSpec& o) {
      return (x - o.point).dot(o.normal.normalized()) > 0.0; // the first that it is beyond
    });
    if (!through->recycle && !through->record) continue;
    GrainSeed seed = seedOf(i);
    for (const auto& values : grains_.quantities)
      seed.quantities.push_back(values[i]);
    left_.push_back({std::move(seed), static_cast<int>(through - scene_.outlets.begin()), time(),
                     time() - lives_.enteredAt(grains_.id[i])});
  }
  flow_.lastDischarge = time();
  rebuild(drop);
  return true;
}

std::vector<double> DemSolver::quantity(const std::string& name) const {
  const auto& names = grains_.quantityNames;
  const auto at = std::find(names.begin(), names.end(), name);
  if (at == names.end())
    throw InputError(fmt::format("no law of this scene keeps a grain quantity '{}'", name));
  std::vector<double> values;
  for (std::int32_t i : idOrder())
    values.push_back(grains_.quantities[at - names.begin()][i]);
  return values;
}

void DemSolver::setQuantity(const std::string& name, const std::vector<double>& values) {
  const auto& names = grains_.quantityNames;
  const auto at = std::find(names.begin(), names.end(), name);
  if (at == names.end())
    throw InputError(fmt::format("no law of this scene keeps a grain quantity '{}'", name));
  if (values.size() != grains_.size())
    throw InputError(
        fmt::format("{} values of '{}' were given for {} grains", values.size(), name, grains_.size()));
  const auto order = idOrder();
  for (std::size_t k = 0; k < order.size(); ++k)
    grains_.quantities[at - names.begin()][order[k]] = values[k];
}

} // namespace sandglass
