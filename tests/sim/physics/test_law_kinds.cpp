// Every registered law, found through the registry: the same bits at every vector width, single precision
// near double, and in a small bed the same bits for any number of threads and across save and load.

#include "sim/base/random.h"
#include "tests/sim/physics/every_law.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstring>

using namespace sandglass;
using namespace sandglass::testing;

namespace {

std::unique_ptr<Law> made(const LawKind& kind, int variant, int types) {
  LawContext context;
  for (int k = 0; k < types; ++k) {
    PairType t;
    t.used = true;
    t.parameters = usual(kind, variant);
    t.referenceMass = 5e-6 * (1 + k);
    t.effectiveYoungsModulus = 2e7;
    t.effectiveShearModulus = 1e7;
    t.largestEffectiveRadius = 1e-3;
    context.types.push_back(t);
  }
  return kind.make(context);
}

/// A block of contacts and gaps as they come from millimetre grains; history zero unless told otherwise.
void fill(ContactBlock& b, int size, bool oneType, std::uint64_t key) {
  RandomStream random(17, RandomPurpose::test, key);
  const auto between = [&](double low, double high) { return low + (high - low) * random.uniform(); };
  b.size = size;
  b.dt = 1e-6;
  b.oneType = oneType;
  for (int i = 0; i < size; ++i) {
    const Vec3 n = random.direction(), w = 100 * random.direction();
    Vec3 v = 0.2 * random.direction();
    b.type[i] = oneType ? 0 : i % 2;
    b.nx[i] = n.x(), b.ny[i] = n.y(), b.nz[i] = n.z();
    b.overlap[i] = i % 5 == 4 ? -between(0, 3e-5) : between(0, 3e-5);
    const bool wall = i % 7 == 6;
    const double ra = between(0.5e-3, 1.5e-3), rb = wall ? 1.0 : between(0.5e-3, 1.5e-3);
    const double ma = 1e4 * ra * ra * ra, mb = 1e4 * rb * rb * rb;
    b.radiusA[i] = ra, b.radiusB[i] = rb;
    b.inverseMassA[i] = 1 / ma, b.inverseMassB[i] = wall ? 0.0 : 1 / mb;
    b.effectiveRadius[i] = wall ? ra : ra * rb / (ra + rb);
    b.effectiveMass[i] = 1.0 / (b.inverseMassA[i] + b.inverseMassB[i]);
    b.vn[i] = v.dot(n);
    v -= b.vn[i] * n;
    b.vtx[i] = v.x(), b.vty[i] = v.y(), b.vtz[i] = v.z();
    b.wx[i] = w.x(), b.wy[i] = w.y(), b.wz[i] = w.z();
    // What a normal law would have left for the others.
    b.normalForce[i] = b.contactForce[i] = b.stiffness[i] = b.damping[i] = 0.0;
  }
  std::fill_n(b.event, size, noEvent);
}

void loaded(ContactBlock& b) {
  for (int i = 0; i < b.size; ++i) {
    b.contactForce[i] = b.normalForce[i] = std::max(0.0, 1000.0 * b.overlap[i]);
    b.stiffness[i] = 1000.0;
    b.damping[i] = 1e-3;
  }
}

/// All that laws write, one after the other.
template <class Real> std::vector<Real> written(const ContactBlockOf<Real>& b, int history) {
  std::vector<Real> all;
  const auto put = [&](const Real* column) { all.insert(all.end(), column, column + b.size); };
  for (const Real* column :
       {b.normalForce, b.contactForce, b.stiffness, b.damping, b.ftx, b.fty, b.ftz, b.mx, b.my, b.mz})
    put(column);
  for (int k = 0; k < history; ++k)
    put(b.history[k]);
  return all;
}

void clear(ContactBlock& b) {
  for (int i = 0; i < b.size; ++i)
    b.ftx[i] = b.fty[i] = b.ftz[i] = b.mx[i] = b.my[i] = b.mz[i] = 0.0;
  for (auto& column : b.history)
    std::fill_n(column, b.size, 0.0);
}

/// Several steps of a law over one block, so that histories have something in them.
std::vector<double> through(const Law& law, bool isNormal, int size, bool oneType, KernelWidth width) {
  ContactBlock b;
  std::vector<double> all;
  fill(b, size, oneType, 1);
  clear(b);
  for (std::uint64_t step = 1; step <= 4; ++step) {
    fill(b, size, oneType, step < 4 ? 1 : 2); // three steps of sliding, then another motion altogether
    for (int i = 0; i < size; ++i)
      b.ftx[i] = b.fty[i] = b.ftz[i] = b.mx[i] = b.my[i] = b.mz[i] = 0.0;
    if (!isNormal) loaded(b);
    law.apply(b, 0, width);
    const auto now = written(b, law.historySize());
    all.insert(all.end(), now.begin(), now.end());
  }
  return all;
}

ContactBlockSingle narrowed(const ContactBlock& b) {
  ContactBlockSingle s;
  s.size = b.size;
  s.dt = static_cast<float>(b.dt);
  s.oneType = b.oneType;
  std::copy_n(b.type, b.size, s.type);
  const auto copy = [&](const double* from, float* to) {
    for (int i = 0; i < b.size; ++i)
      to[i] = static_cast<float>(from[i]);
  };
  copy(b.nx, s.nx), copy(b.ny, s.ny), copy(b.nz, s.nz), copy(b.overlap, s.overlap);
  copy(b.radiusA, s.radiusA), copy(b.radiusB, s.radiusB);
  copy(b.inverseMassA, s.inverseMassA), copy(b.inverseMassB, s.inverseMassB);
  copy(b.effectiveRadius, s.effectiveRadius), copy(b.effectiveMass, s.effectiveMass);
  copy(b.vn, s.vn), copy(b.vtx, s.vtx), copy(b.vty, s.vty), copy(b.vtz, s.vtz);
  copy(b.wx, s.wx), copy(b.wy, s.wy), copy(b.wz, s.wz);
  copy(b.normalForce, s.normalForce), copy(b.contactForce, s.contactForce);
  copy(b.stiffness, s.stiffness), copy(b.damping, s.damping);
  copy(b.ftx, s.ftx), copy(b.fty, s.fty), copy(b.ftz, s.ftz), copy(b.mx, s.mx), copy(b.my, s.my),
      copy(b.mz, s.mz);
  for (int k = 0; k < ContactBlock::maxHistory; ++k)
    copy(b.history[k], s.history[k]);
  std::copy_n(b.event, b.size, s.event);
  return s;
}

/// A stirred block of grains falling on a floor, with that law in its role and simple ones in the others.
std::unique_ptr<DemSolver> bed(const LawKind& kind, int variant, int threads) {
  SceneText t = sceneWith(kind, variant);
  t.gravity = R"(["0", "-9.81 m/s^2", "0"])";
  t.lower = R"(["-8.5 mm", "-5 mm", "0 mm"])";
  t.upper = R"(["8.5 mm", "60 mm", "7 mm"])";
  t.periodic = R"(["x", "z"])";
  t.stepsPerContact = 25;
  t.walls = "[[wall]]\nname = \"floor\"\nkind = \"plane\"\nmaterial = \"wall\"\npoint = [\"0 m\", \"0 m\", "
            "\"0 m\"]\nnormal = [0, 1, 0]\n";
  auto solver = std::make_unique<DemSolver>(t.scene(), SolverOptions{threads});
  std::vector<GrainSeed> seeds;
  for (int k = 0; k < 240; ++k) {
    RandomStream random(5, RandomPurpose::test, k);
    const Vec3 place(-7.4e-3 + 2.12e-3 * (k % 8), 1.1e-3 + 2.12e-3 * (k / 24), 1.1e-3 + 2.3e-3 * (k / 8 % 3));
    seeds.push_back(
        grain(k, place + 0.03e-3 * random.direction(), 0.3 * random.direction(), 50 * random.direction()));
  }
  solver->add(seeds);
  return solver;
}

std::string bits(const DemSolver& solver) {
  std::string all;
  for (const GrainSeed& s : solver.present())
    for (const Vec3& v : {s.position, s.velocity, s.spin})
      all.append(reinterpret_cast<const char*>(v.data()), sizeof(double) * 3);
  return all;
}

} // namespace

TEST_CASE("every law gives the same bits at every vector width") {
  for (const LawKind& kind : lawKinds())
    for (const int variant : {0, 1})
      for (const bool oneType : {true, false})
        for (const int size : {64, 13, 1}) {
          INFO(kind.name << " variant " << variant << " one type " << oneType << " size " << size);
          const auto law = made(kind, variant, 2);
          const bool isNormal = kind.role == LawRole::normal;
          const auto plain = through(*law, isNormal, size, oneType, KernelWidth::plain);
          for (const double x : plain)
            REQUIRE(std::isfinite(x));
          for (const KernelWidth width : {KernelWidth::avx2, KernelWidth::avx512}) {
            if (width > bestKernelWidth()) continue;
            const auto wide = through(*law, isNormal, size, oneType, width);
            CHECK(std::memcmp(plain.data(), wide.data(), plain.size() * sizeof(double)) == 0);
          }
        }
}

TEST_CASE("every law in single precision stays within 1e-4 of double") {
  for (const LawKind& kind : lawKinds())
    for (const int variant : {0, 1}) {
      const auto law = made(kind, variant, 2);
      if (!law->singlePrecision()) continue;
      INFO(kind.name << " variant " << variant);
      ContactBlock b;
      fill(b, 64, true, 1);
      clear(b);
      if (kind.role != LawRole::normal) loaded(b);
      ContactBlockSingle s = narrowed(b);
      law->apply(b, 0, KernelWidth::plain);
      law->apply(s, 0, KernelWidth::plain);
      const auto wide = written(b, law->historySize());
      const auto narrow = written(s, law->historySize());
      for (std::size_t column = 0; column < wide.size() / 64; ++column) {
        double largest = 0.0;
        for (int i = 0; i < 64; ++i)
          largest = std::max(largest, std::abs(wide[column * 64 + i]));
        for (int i = 0; i < 64; ++i)
          CHECK(std::abs(wide[column * 64 + i] - narrow[column * 64 + i]) <= 1e-4 * largest);
      }
    }
}

TEST_CASE("every law gives the same bits for any number of threads and across save and load") {
  for (const LawKind& kind : lawKinds())
    for (const int variant : {0, 1}) {
      INFO(kind.name << " variant " << variant);
      const auto straight = bed(kind, variant, 1);
      straight->advance(400);
      const std::string expected = bits(*straight);
      for (const int threads : {2, 3, 7}) {
        const auto other = bed(kind, variant, threads);
        other->advance(400);
        CHECK(bits(*other) == expected);
      }
      for (const int at : {1, 137, 300}) {
        const auto first = bed(kind, variant, 2);
        first->advance(at);
        const auto second = bed(kind, variant, 3);
        second->load(first->save());
        second->advance(400 - at);
        CHECK(bits(*second) == expected);
        CHECK(second->energies().total() == straight->energies().total());
      }
    }
}

TEST_CASE("no law gains energy in a bed left to itself") {
  // Kinetic, stored and potential energy together may only fall; a hundredth of the energy in motion is
  // allowed for the step (25 in a contact).
  for (const LawKind& kind : lawKinds())
    for (const int variant : {0, 1}) {
      const auto solver = bed(kind, variant, 1);
      const Energies first = solver->energies();
      const double start = first.total(), moving = first.translational + first.rotational;
      double before = start;
      INFO(kind.name << " variant " << variant);
      for (int k = 0; k < 12; ++k) {
        solver->advance(50);
        const double now = solver->energies().total();
        CHECK(now < before + 0.01 * moving);
        before = now;
      }
      CHECK(before < start + 0.01 * moving);
    }
}

TEST_CASE("what a law keeps turns with the contact: vectors where it says so, numbers elsewhere") {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, -3).normalized()).toRotationMatrix();
  const auto turnColumns = [&](ContactBlock& b, double* x, double* y, double* z) {
    for (int i = 0; i < b.size; ++i) {
      const Vec3 v = turn * Vec3(x[i], y[i], z[i]);
      x[i] = v.x(), y[i] = v.y(), z[i] = v.z();
    }
  };
  for (const LawKind& kind : lawKinds())
    for (const int variant : {0, 1}) {
      if (kind.name == "none") continue;
      INFO(kind.name << " variant " << variant);
      const auto law = made(kind, variant, 2);
      ContactBlock plain{}, turned{};
      for (std::uint64_t step = 1; step <= 4; ++step) {
        for (ContactBlock* b : {&plain, &turned}) {
          fill(*b, 40, false, step < 4 ? 1 : 2);
          for (int i = 0; i < b->size; ++i)
            b->ftx[i] = b->fty[i] = b->ftz[i] = b->mx[i] = b->my[i] = b->mz[i] = 0.0;
          if (kind.role != LawRole::normal) loaded(*b);
        }
        turnColumns(turned, turned.nx, turned.ny, turned.nz);
        turnColumns(turned, turned.vtx, turned.vty, turned.vtz);
        turnColumns(turned, turned.wx, turned.wy, turned.wz);
        law->apply(plain, 0, KernelWidth::plain);
        law->apply(turned, 0, KernelWidth::plain);
      }
      turnColumns(plain, plain.ftx, plain.fty, plain.ftz);
      turnColumns(plain, plain.mx, plain.my, plain.mz);
      for (const int at : law->historyVectors())
        turnColumns(plain, plain.history[at], plain.history[at + 1], plain.history[at + 2]);
      const auto expected = written(plain, law->historySize()), found = written(turned, law->historySize());
      const std::size_t columns = expected.size() / 40;
      for (std::size_t c = 0; c < columns; ++c) {
        double scale = 0, worst = 0;
        for (std::size_t i = 40 * c; i < 40 * c + 40; ++i) {
          scale = std::max(scale, std::abs(expected[i]));
          worst = std::max(worst, std::abs(expected[i] - found[i]));
        }
        CHECK(worst <= 1e-10 * scale + 1e-20);
      }
    }
}
