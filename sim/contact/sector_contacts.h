#pragma once
// Contacts across the faces of a wedge (Scene::wedge): grain a with the image of grain b that is turned by k
// sectors about the axis. Each is evaluated once, in a's place: b's position, velocity and spin are turned
// there, the force on the image is turned back to b. A grain near the axis can meet its own images.
//
// Ordinary pairs (PairList) and these are one and the same to a grain that moves round: when the lists are
// made anew, grains that have left the sector are turned back into it, and pairs change over from one list to
// the other with their histories, whose vectors are turned with grain a. Between that, grains may stand
// beyond a face by as far as their list allows.
// Forces are summed per grain in the order of (a, b, k), so threads do not matter.

#include "sim/contact/law_stack.h"
#include "sim/contact/pair_forces.h"
#include "sim/contact/wall_contacts.h"
#include "sim/grains/grain_store.h"
#include "sim/math/sector.h"

#include <array>
#include <cstdint>
#include <vector>

namespace sandglass {

class SectorContacts {
public:
  /// A whole circle: nothing to do, ever.
  SectorContacts(const LawStack& laws, const Sector& sector) : laws_(laws), sector_(sector) {}

  const Sector& sector() const { return sector_; }
  bool used() const { return !sector_.whole(); }

  /// Before the lists are made anew: turns grains back into the sector, with velocities, spins and the
  /// histories of all their contacts.
  void turnBack(GrainStore& grains, PairList& list, WallContacts& walls);
  /// After the pair list has been built: lists what is in reach across the faces, as the pair list does
  /// (`listed`), and hands histories over.
  void build(const GrainStore& grains, double range, PairList& list);

  void step(const GrainStore& grains, double dt, Parallel& parallel, DeepestOverlap& deepest);
  /// Adds forces and torques over radius of the last step to the sums of the grains in [first, last).
  void addTo(GroupSums sums, const GrainStore& grains, std::int64_t first, std::int64_t last) const;

  double storedEnergy(const GrainStore& grains, double dt) const;

  struct Contact {
    std::int32_t a = 0, b = 0; ///< storage indices; a has the smaller id, or is b
    std::int32_t turn = 0;     ///< by which b is turned, 1 to count - 1
  };
  /// Calls visit(contact, block, c) for each with present forces; changes nothing.
  template <class Visit> void visitContacts(const GrainStore& grains, double dt, Visit&& visit) const;

  /// For checkpoints: what cannot be made again from positions.
  std::vector<double>& historyArray() { return history_; }
  std::size_t size() const { return contacts_.size(); }

private:
  struct Key {
    std::int64_t a, b;
    std::int32_t turn;
    bool operator<(const Key& o) const { return a != o.a ? a < o.a : b != o.b ? b < o.b : turn < o.turn; }
  };
  struct Kept {
    Key key;
    std::array<double, ContactBlock::maxHistory> history;
  };
  void turnHistory(double* history, int turn) const;
  void keep(const GrainStore& grains, std::int32_t a, std::int32_t b, int turn, const double* history);
  const Kept* find(const Key& key) const;
  void search(const GrainStore& grains, double range);
  void link(const GrainStore& grains);
  /// Whether the contact acts; then its columns of the block are set.
  bool fillOne(const GrainStore& grains, std::size_t contact, ContactBlock& block, int c) const;
  void takeResult(const GrainStore& grains, std::size_t contact, const ContactBlock& block, int c);
  /// The contact of a grain with its image at the other side of the axis is one of two that are the same.
  double share(const Contact& c) const { return c.a == c.b && 2 * c.turn == sector_.count() ? 0.5 : 1.0; }

  const LawStack& laws_;
  Sector sector_;
  std::vector<Contact> contacts_;
  std::vector<double> history_;                 ///< historySize per contact, in a's place
  std::vector<double> result_;                  ///< force and torque on a, then on b, twelve per contact
  std::vector<std::int32_t> offsets_, entries_; ///< of each grain: contact << 1 | 1 when it is b
  std::vector<std::int32_t> turns_;             ///< of each grain, by turnBack()
  std::vector<Kept> kept_;                      ///< histories on their way from list to list
};

template <class Visit>
void SectorContacts::visitContacts(const GrainStore& grains, double dt, Visit&& visit) const {
  ContactBlock block;
  block.dt = dt;
  block.size = 1;
  block.oneType = false;
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    if (!fillOne(grains, k, block, 0)) continue;
    laws_.apply(block, true);
    visit(contacts_[k], block, 0);
  }
}

} // namespace sandglass
