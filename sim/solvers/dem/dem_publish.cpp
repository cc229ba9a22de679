// What the soft-sphere solver shows of itself: frames, energies, walls.

#include "sim/solvers/dem/dem_solver.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace sandglass {

Vec3 DemSolver::wrapped(Vec3 x) const {
  const Domain& d = scene_.domain;
  for (int k = 0; k < 3; ++k)
    if (d.periodic[k]) {
      const double length = d.upper[k] - d.lower[k];
      x[k] -= length * std::floor((x[k] - d.lower[k]) / length);
      if (x[k] >= d.upper[k]) x[k] = d.lower[k];
    }
  return x;
}

FramePtr DemSolver::frame() const {
  auto frame = std::make_shared<Frame>();
  frame->time = time();
  frame->step = step_;
  frame->domain = scene_.domain;
  for (const Species& s : scene_.species)
    frame->speciesNames.push_back(s.name);
  const auto order = idOrder();
  const auto wants = [&](const char* name) {
    const auto& list = scene_.output.quantities;
    return std::find(list.begin(), list.end(), name) != list.end();
  };
  const auto scalars = [&](const char* name, auto&& value) {
    auto& out = frame->scalars[name];
    out.reserve(order.size());
    for (std::int32_t i : order)
      out.push_back(value(i));
  };
  const auto vectors = [&](const char* name, auto&& value) {
    auto& out = frame->vectors[name];
    out.reserve(order.size());
    for (std::int32_t i : order)
      out.push_back(value(i));
  };
  const FullStep& full = fullStep(wallLoads_ || wants(quantity::force));
  for (std::int32_t i : order) {
    frame->id.push_back(grains_.id[i]);
    frame->position.push_back(wrapped(grains_.place[i].vec()));
  }
  scalars(quantity::radius, [&](std::int32_t i) { return grains_.place[i].w; });
  if (scene_.species.size() > 1 || wants(quantity::species))
    scalars(quantity::species, [&](std::int32_t i) { return static_cast<double>(grains_.species[i]); });
  if (wants(quantity::mass)) scalars(quantity::mass, [&](std::int32_t i) { return massOf(i); });
  for (std::size_t q = 0; q < grains_.quantityNames.size(); ++q)
    scalars(grains_.quantityNames[q].c_str(), [&](std::int32_t i) { return grains_.quantities[q][i]; });
  if (wants(quantity::velocity))
    vectors(quantity::velocity, [&](std::int32_t i) { return full.velocity[i]; });
  if (wants(quantity::spin) && grains_.turning)
    vectors(quantity::spin, [&](std::int32_t i) { return full.spin[i]; });
  if (wants(quantity::force))
    vectors(quantity::force, [&](std::int32_t i) {
      if (heldFast(i)) return full.force[i].vec(); // nothing pulls it down
      return Vec3(full.force[i].vec() + grains_.mass(i) * gravity_);
    });
  if (wants(quantity::residenceTime))
    scalars(quantity::residenceTime,
            [&](std::int32_t i) { return time() - lives_.enteredAt(grains_.id[i]); });
  if (wants(quantity::life))
    scalars(quantity::life, [&](std::int32_t i) { return static_cast<double>(lives_.life(grains_.id[i])); });
  frame->walls = wallsNow(wallLoads_);
  if (scene_.output.contacts && !stale_) frame->contacts = contactsNow();
  return frame;
}

namespace {

/// What contact `c` of a block shows: normal, force, overlap.
FrameContact contactOf(const ContactBlock& b, int c) {
  FrameContact contact;
  contact.normal = {b.nx[c], b.ny[c], b.nz[c]};
  contact.force = b.normalForce[c] * contact.normal + Vec3(b.ftx[c], b.fty[c], b.ftz[c]);
  contact.overlap = b.overlap[c];
  return contact;
}

/// Where grains a (at x) and b touch: between their surfaces in proportion to the radii [m].
Vec3 pointBetween(const Vec3& x, double radiusA, double radiusB, const FrameContact& contact) {
  const double sum = radiusA + radiusB;
  return x - radiusA * (sum - contact.overlap) / sum * contact.normal;
}

} // namespace

std::vector<FrameContact> DemSolver::contactsNow() const {
  std::vector<FrameContact> contacts;
  pairForces_.visitContacts(dt_, [&](std::int64_t p, const ContactBlock& b, int c) {
    FrameContact contact = contactOf(b, c);
    const auto [i, j] = list_.pairs()[p];
    contact.a = grains_.id[i];
    contact.b = grains_.id[j];
    contact.image = list_.image(p);
    contact.point =
        wrapped(pointBetween(grains_.place[i].vec(), grains_.place[i].w, grains_.place[j].w, contact));
    contacts.push_back(contact);
  });
  across_.visitContacts(grains_, dt_, [&](const SectorContacts::Contact& pair, const ContactBlock& b, int c) {
    FrameContact contact = contactOf(b, c);
    contact.a = grains_.id[pair.a];
    contact.b = grains_.id[pair.b];
    contact.image = {pair.turn, 0, 0};
    contact.point = pointBetween(grains_.place[pair.a].vec(), b.radiusA[c], b.radiusB[c], contact);
    contacts.push_back(contact);
  });
  std::sort(contacts.begin(), contacts.end(), [](const FrameContact& s, const FrameContact& t) {
    return std::tie(s.a, s.b, s.image) < std::tie(t.a, t.b, t.image);
  });
  wallContacts_.visitContacts(
      grains_, walls_,
      [&](std::int32_t i, std::int32_t wall, const ContactBlock& b, int c, const WallTouch& touch) {
        FrameContact contact = contactOf(b, c);
        contact.a = grains_.id[i];
        contact.wall = wall;
        contact.normal = touch.normal;
        contact.force = b.normalForce[c] * touch.normal + Vec3(b.ftx[c], b.fty[c], b.ftz[c]);
        contact.point = wrapped(grains_.place[i].vec() - touch.distance * touch.normal);
        contacts.push_back(contact);
      });
  return contacts;
}

Energies DemSolver::energies() const {
  Energies e;
  const Vec3 extent = scene_.domain.upper - scene_.domain.lower;
  const FullStep& full = fullStep(false);
  for (std::int32_t i : idOrder()) {
    if (heldFast(i)) continue; // nothing can change what it has
    const double m = grains_.mass(i);
    Vec3 x = grains_.place[i].vec();
    if (grains_.imaged)
      for (int k = 0; k < 3; ++k)
        x[k] += extent[k] * grains_.image[i][k]; // so falling through a periodic side is no jump
    e.translational += 0.5 * m * full.velocity[i].squaredNorm();
    e.gravitational -= m * gravity_.dot(x);
    if (grains_.turning) e.rotational += 0.5 * grains_.inertia(i) * full.spin[i].squaredNorm();
  }
  if (!stale_)
    e.elastic = pairForces_.storedEnergy(dt_) + across_.storedEnergy(grains_, dt_) +
                wallContacts_.storedEnergy(grains_, walls_);
  return e;
}

double DemSolver::massOf(std::int32_t i) const {
  if (!heldFast(i)) return grains_.mass(i);
  const double r = grains_.place[i].w;
  return 4.0 / 3.0 * std::numbers::pi * r * r * r *
         scene_.material(scene_.species[grains_.species[i]].material).density;
}

GrainSeed DemSolver::seedOf(std::int32_t i) const {
  GrainSeed s;
  s.id = grains_.id[i];
  s.species = grains_.species[i];
  s.radius = grains_.place[i].w;
  s.position = wrapped(grains_.place[i].vec());
  const FullStep& full = fullStep(false);
  s.velocity = full.velocity[i];
  if (grains_.turning) s.spin = full.spin[i];
  s.life = lives_.life(s.id);
  return s;
}

std::vector<GrainSeed> DemSolver::present() const {
  std::vector<GrainSeed> all;
  for (std::int32_t i : idOrder())
    all.push_back(seedOf(i));
  return all;
}

double DemSolver::greatestSpeed() const {
  double square = 0;
  for (std::size_t i = 0; i < grains_.size(); ++i)
    if (!heldFast(i)) square = std::max(square, grains_.motion[i].vec().squaredNorm());
  return std::sqrt(square);
}

std::vector<FrameWall> DemSolver::walls() const {
  return wallsNow(true);
}

std::vector<FrameWall> DemSolver::wallsNow(bool loads) const {
  if (loads) fullStep(true); // wall forces of this instant
  std::vector<FrameWall> all;
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
    if (loads && !stale_) wallContacts_.total(static_cast<int>(w), force, torque);
    SolverWall wall = walls_[w];
    wall.tally = loads ? atFullStep_.tallies[w] : WallTally{};
    all.push_back(frameWall(wall, force, torque));
  }
  return all;
}

double DemSolver::wallWork() const {
  const FullStep& full = fullStep(true);
  double sum = frozen_.any() ? frozen_.workWith(full.force, full.torque, step_ == 0 ? 0.0 : dt_) : 0.0;
  for (const WallTally& tally : full.tallies)
    sum += tally.work;
  return sum + fields_.work();
}

} // namespace sandglass
