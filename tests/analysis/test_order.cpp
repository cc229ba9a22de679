// Bond order of lattices, rotations, random neighbours; coordination and rattlers.

#include "analysis/coordination.h"
#include "analysis/neighbour_list.h"
#include "analysis/registry.h"
#include "analysis/steinhardt.h"
#include "tests/analysis/lattices.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace sandglass;
using namespace sandglass::analysis;
using namespace sandglass::analysis::test;

namespace {

Bonds bondsOf(const NeighbourList& list) {
  return {list.start, list.index, list.vector, {}};
}

/// q_l and w_l of one set of directions.
std::pair<double, double> single(const std::vector<Vec3>& directions, int l) {
  const std::vector<std::size_t> start{0, directions.size()};
  const std::vector<std::uint32_t> index(directions.size(), 0);
  const BondOrder order = bondOrder({start, index, directions, {}}, l);
  return {magnitudes(order)[0], thirdOrder(order)[0]};
}

std::vector<Vec3> icosahedron() {
  const double g = std::numbers::phi;
  std::vector<Vec3> v;
  for (const double a : {-1.0, 1.0})
    for (const double b : {-g, g}) {
      v.push_back(Vec3(0, a, b));
      v.push_back(Vec3(a, b, 0));
      v.push_back(Vec3(b, 0, a));
    }
  return v;
}

} // namespace

TEST_CASE("q_l and w_l of lattices", "[order]") {
  // Steinhardt et al. 1983 and Mickel et al. 2013, tables.
  struct Case {
    const char* name;
    Frame frame;
    double cutoff, q4, q6, w4, w6;
  };
  const auto c = GENERATE(values<Case>({
      {"fcc", faceCentredFrame(), 1.2, 0.190941, 0.574524, -0.159317, -0.013161},
      {"hcp", hexagonalFrame(), 1.2, 0.097222, 0.484762, 0.134097, -0.012442},
      {"bcc, 14 neighbours", bodyCentredFrame(), 1.3, 0.036370, 0.510688, 0.159317, 0.013161},
      {"sc", simpleCubicFrame(), 1.2, 0.763763, 0.353553, 0.159317, 0.013161},
  }));
  INFO(c.name);
  const NeighbourList list = neighboursWithin(c.frame.position, c.frame.domain, c.cutoff);
  const Bonds bonds = bondsOf(list);
  for (const int l : {4, 6}) {
    const BondOrder order = bondOrder(bonds, l);
    const auto q = magnitudes(order), smooth = magnitudes(averaged(order, bonds)), w = thirdOrder(order);
    for (std::size_t i = 0; i < q.size(); i += 37) {
      CHECK(q[i] == Approx(l == 4 ? c.q4 : c.q6).margin(1e-6));
      // All sites of sc, fcc and bcc look alike; those of hcp are mirrored and keep most of it.
      if (std::string(c.name) != "hcp") CHECK(smooth[i] == Approx(q[i]).epsilon(1e-12));
      CHECK(w[i] == Approx(l == 4 ? c.w4 : c.w6).margin(1e-6));
    }
  }
}

TEST_CASE("the icosahedron has q6 = 0.66332 and w6 = -0.16975", "[order]") {
  CHECK(single(icosahedron(), 6).first == Approx(0.663325).margin(1e-6));
  CHECK(single(icosahedron(), 6).second == Approx(-0.169754).margin(1e-6));
  CHECK(single(icosahedron(), 4).first == Approx(0).margin(1e-12));
}

TEST_CASE("q_l follows from Legendre polynomials, for every l, turned or not", "[order]") {
  // The addition theorem: q_l^2 is the mean of P_l(cos) over all ordered pairs of bonds.
  RandomStream random(2, RandomPurpose::test, 8);
  std::vector<Vec3> directions;
  for (int k = 0; k < 9; ++k)
    directions.push_back(random.uniform(0.5, 2) * random.direction());
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  for (int l = 0; l <= 12; ++l) {
    double sum = 0;
    for (const auto& a : directions)
      for (const auto& b : directions)
        sum += std::legendre(static_cast<unsigned>(l), a.normalized().dot(b.normalized()));
    std::vector<Vec3> turned;
    for (const auto& a : directions)
      turned.push_back(turn * a);
    INFO("l = " << l);
    CHECK(single(directions, l).first == Approx(std::sqrt(std::max(0.0, sum)) / 9).epsilon(1e-9));
    CHECK(single(turned, l).first == Approx(single(directions, l).first).epsilon(1e-10));
    CHECK(single(turned, l).second == Approx(single(directions, l).second).margin(1e-10));
  }
}

TEST_CASE("Wigner's 3j symbols", "[order]") {
  // (2 2 2; 0 0 0) = -sqrt(2/35), (6 6 6; 0 0 0) = -20 / sqrt(46189), and the sum of all squares is 1.
  CHECK(wigner3j(2, 0, 0) == Approx(-std::sqrt(2.0 / 35)).epsilon(1e-13));
  CHECK(std::abs(wigner3j(6, 0, 0)) == Approx(20 / std::sqrt(46189.0)).epsilon(1e-12));
  for (const int l : {4, 6, 10}) {
    double sum = 0;
    for (int a = -l; a <= l; ++a)
      for (int b = -l; b <= l; ++b)
        sum += std::pow(wigner3j(l, a, b), 2);
    CHECK(sum == Approx(1).epsilon(1e-10));
  }
}

TEST_CASE("no neighbours give NaN", "[order]") {
  const std::vector<std::size_t> start{0, 0};
  CHECK(std::isnan(magnitudes(bondOrder({start, {}, {}, {}}, 6))[0]));
}

TEST_CASE("structure types of lattices, by shell and by faces", "[order]") {
  struct Case {
    const char *name, *type, *cutoff;
    Frame frame;
  };
  const auto c = GENERATE(values<Case>({{"fcc", "fcc-like", "1.2", faceCentredFrame()},
                                        {"hcp", "hcp-like", "1.2", hexagonalFrame()},
                                        {"bcc", "bcc-like", "1.3", bodyCentredFrame()},
                                        {"sc", "sc-like", "1.2", simpleCubicFrame()}}));
  const std::string neighbours = GENERATE("shell", "faces");
  const AnalysisKind& kind = analysisKind("order");
  Parameters knobs = defaultKnobs(kind);
  setKnob(knobs, kind, "neighbours", neighbours);
  setKnob(knobs, kind, "cutoff", c.cutoff);
  setKnob(knobs, kind, "solid_bonds", "6");
  const Results r = analyze(kind, knobs, {}, {std::make_shared<Frame>(c.frame)});
  INFO(c.name << " by " << neighbours);
  for (const auto& table : r.tables)
    if (table.name == "structure_types")
      for (std::size_t row = 0; row < table.rows.size(); ++row)
        CHECK(table.rows[row][0] == (table.rowNames[row] == c.type ? 1 : 0));
  for (const auto& g : r.grains)
    if (g.name == "crystal_cluster") // one crystal
      CHECK(g.values == std::vector<double>(c.frame.size(), 0));
}

TEST_CASE("contacts, rattlers and chains of them", "[order]") {
  // A simple cubic block of 27 on a floor, and a chain of three grains hanging loose on its top: the end of
  // the chain has one contact, then its neighbour has but one left, and so on down to the block.
  Frame frame = simpleCubicFrame(3);
  frame.domain.periodic = {true, true, false};
  for (auto& x : frame.position)
    x.z() += 0.49;
  for (int k = 0; k < 3; ++k) {
    frame.position.push_back(Vec3(0.01, 0.01, 3.5 + k));
    frame.id.push_back(27 + k);
    frame.scalars[quantity::radius].push_back(0.5);
  }
  frame.walls = {sceneWall("plane", {{"point", Vec3(0, 0, 0)}, {"normal", Vec3(0, 0, 1)}})};
  const ContactCounts c = contactCounts(frame, 1e-6, 4, true);
  for (std::size_t i = 0; i < 27; ++i)
    CHECK_FALSE(c.rattler[i]);
  for (std::size_t i = 27; i < 30; ++i)
    CHECK(c.rattler[i]);
  CHECK(c.contacts[0] == 6); // bottom layer: four beside, one above, the floor
  CHECK(c.contacts[27] == 2);
  CHECK(c.mechanical[29] == 0);
  // In one pass the same three go, and the grain below the chain has lost a contact.
  const ContactCounts once = contactCounts(frame, 1e-6, 4);
  CHECK(once.rattler == c.rattler);
  CHECK(once.mechanical[2] == once.contacts[2] - 1);
}

TEST_CASE("rattlers are counted once, or again and again", "[order]") {
  // A cube of 4 x 4 x 4 touching grains without periods: its 8 corners touch 3 others, its 24 edge grains 4,
  // its 24 face grains 5, its 8 inner ones 6.
  Frame frame = simpleCubicFrame();
  frame.domain.periodic = {false, false, false};
  const auto rattlers = [](const ContactCounts& c) {
    return std::count(c.rattler.begin(), c.rattler.end(), 1);
  };
  const ContactCounts once = contactCounts(frame, 1e-6, 4);
  CHECK(rattlers(once) == 8);
  // An edge grain touches one corner: 4 - 1. Nobody else does.
  CHECK(std::count(once.mechanical.begin(), once.mechanical.end(), 3) == 24);
  CHECK(std::count(once.mechanical.begin(), once.mechanical.end(), 5) == 24);
  CHECK(std::count(once.mechanical.begin(), once.mechanical.end(), 6) == 8);
  // Without corners the edges have 3, without edges the faces 5 - 2, without faces the inner ones 3.
  CHECK(rattlers(contactCounts(frame, 1e-6, 4, true)) == 64);
}

TEST_CASE("coordination numbers of a crystal by every definition", "[order]") {
  const AnalysisKind& kind = analysisKind("coordination");
  const Results r = analyze(kind, defaultKnobs(kind), {}, {std::make_shared<Frame>(faceCentredFrame(5))});
  for (const char* name : {"contact", "mechanical", "first shell"})
    for (std::size_t row = 0; row < r.tables[0].rows.size(); ++row)
      if (r.tables[0].rowNames[row] == name) CHECK(r.tables[0].rows[row][0] == 12);
}
