// Forces across a gap: the numbers of the 1998 source, cut-offs, energies as the work of the force.

#include "tests/sim/physics/one_contact.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace sandglass;
using namespace sandglass::testing;

namespace {

LawStack withGap(const std::string& law) {
  SceneText t;
  t.rolling = "{ law = \"none\" }\ngap = [" + law + "]";
  return LawStack(t.scene());
}

/// Charged glass and an uncharged other material, named in this order.
LawStack charged(const std::string& first, const std::string& second) {
  SceneText t;
  t.rolling = R"({ law = "none" }
gap = [{ law = "coulomb", charges = ["1e-14 C", "1e-14 C"], smallest_separation = "0.1 um", cutoff = "1 mm" }])";
  std::string text = t.text();
  const std::string names = R"(between = ["glass", "wall"])", same = R"(["1e-14 C", "1e-14 C"])";
  const std::string charges = first == "wall" ? R"(["0 C", "1e-14 C"])" : R"(["1e-14 C", "0 C"])";
  const auto at = text.find(names);
  text.replace(text.find(same, at), same.size(), charges);
  text.replace(at, names.size(), fmt::format(R"(between = ["{}", "{}"])", first, second));
  return LawStack(parseScene(text, "test"));
}

/// Work of the normal force on the way from gap `from` to gap `to`, against the change of stored energy.
void checkEnergy(const LawStack& laws, double radius, double from, double to) {
  OneContact c(laws, 1e-6, radius);
  c.step(-from);
  const double before = c.stored();
  double work = 0, force = c.normal();
  const int pieces = 40000;
  const double ratio = std::pow(to / from, 1.0 / pieces);
  double z = from;
  for (int k = 0; k < pieces; ++k) {
    const double next = z * ratio;
    c.step(-next);
    work += 0.5 * (force + c.normal()) * (next - z);
    force = c.normal();
    z = next;
  }
  CHECK(before - c.stored() == Approx(work).epsilon(1e-5));
}

} // namespace

TEST_CASE("V18: van der Waals force of two spheres of 50 um at 0.4 nm") {
  const LawStack laws = withGap(R"({ law = "van_der_waals", lifshitz_constant = "1e-19 J" })");
  OneContact c(laws, 1e-6, 50e-6);
  c.step(-0.4e-9);
  CHECK(-c.normal() == Approx(6.217e-7).epsilon(1e-4));
  const double weight = 4.0 / 3.0 * std::numbers::pi * std::pow(50e-6, 3) * 2500 * 9.81;
  CHECK(-c.normal() / weight == Approx(48).epsilon(0.02));
  c.step(-0.1e-9); // closer than the smallest separation
  CHECK(-c.normal() == Approx(6.217e-7).epsilon(1e-4));
  c.step(-0.8e-9);
  CHECK(-c.normal() == Approx(6.217e-7 / 4).epsilon(1e-4));
  CHECK(laws.range() == 4e-8);
  c.step(-3.999e-8); // what the cut-off leaves out: (smallest/cutoff)^2 = 1e-4 of the contact force
  CHECK(-c.normal() == Approx(1e-4 * 6.217e-7).epsilon(1e-3));
  c.step(-4.001e-8);
  CHECK(c.normal() == 0.0);
  CHECK(c.b.contactForce[0] == 0.0); // friction is not loaded by it
  checkEnergy(laws, 50e-6, 1e-10, 4e-8);
}

TEST_CASE("V19: a charged sphere of 50 um beside an uncharged one, 1 um apart") {
  const LawStack laws = charged("glass", "wall");
  OneContact c(laws, 1e-6, 50e-6);
  c.b.oneType = false;
  c.b.type[0] = laws.typeOf(0, 1); // of grains, as both have mass
  c.step(-1e-6);
  CHECK(-c.normal() == Approx(2.202e-7).epsilon(5e-4));
  c.step(-1.001e-3);
  CHECK(c.normal() == 0.0);
  checkEnergy(laws, 50e-6, 5e-8, 0.99e-3);
}

TEST_CASE("two charged spheres far apart act on each other as Coulomb's law has it") {
  const LawStack laws =
      withGap(R"({ law = "coulomb", charges = ["1e-12 C", "1e-12 C"], smallest_separation = "1 um", )"
              R"(cutoff = "100 mm" })");
  OneContact c(laws, 1e-6, 50e-6);
  c.step(-50e-3);
  const double r = 50e-3 + 2 * 50e-6;
  const double exact = 1e-24 / (4 * std::numbers::pi * 8.8541878128e-12 * r * r);
  CHECK(c.normal() == Approx(exact).epsilon(1e-5)); // the images are (R/r)^2 smaller
  checkEnergy(laws, 50e-6, 1e-4, 9e-2);
}

TEST_CASE("charges follow the order in which the scene names the materials") {
  for (const char* first : {"glass", "wall"}) {
    const LawStack laws = charged(first, first == std::string("glass") ? "wall" : "glass");
    OneContact c(laws, 1e-6, 50e-6);
    c.b.oneType = false;
    c.b.radiusB[0] = 1.0;
    c.b.inverseMassB[0] = 0.0;
    c.b.type[0] = laws.typeOf(0, 1); // charged glass at a wall
    c.step(-1e-6);
    CHECK(-c.normal() ==
          Approx(1e-28 / (16 * std::numbers::pi * 8.8541878128e-12 * 1e-12)).epsilon(1e-9)); // plane
    c.b.type[0] = laws.typeOf(1, 0); // an uncharged grain at a wall of glass
    c.step(-1e-6);
    CHECK(c.normal() == 0.0);
  }
}

TEST_CASE("a material has one charge in all its contacts") {
  CHECK_THROWS_WITH(withGap(R"({ law = "coulomb", charges = ["1e-14 C", "0 C"], cutoff = "1 mm", )"
                            R"(smallest_separation = "0.1 um" })"),
                    Catch::Contains("the material 'glass' the charges 1e-14 C and 0 C"));
}

TEST_CASE("two grains drawn together by van der Waals forces keep their energy") {
  SceneText t;
  t.normal = R"({ law = "linear", stiffness = "1000 N/m", restitution = 1.0 })";
  t.rolling = "{ law = \"none\" }\ngap = [{ law = \"van_der_waals\", lifshitz_constant = \"1e-12 J\", "
              "smallest_separation = \"2 um\", cutoff = \"100 um\" }]";
  t.stepsPerContact = 1000;
  DemSolver solver(t.scene(), {1});
  solver.add({grain(0, {1.05e-3, 0, 0}, {-0.02, 0, 0}), grain(1, {-1.05e-3, 0, 0}, {0.02, 0, 0})});
  solver.advance(1);
  const double start = solver.energies().total();
  const double moving = solver.energies().translational;
  for (int k = 0; k < 40; ++k) {
    solver.advance(500);
    CHECK(solver.energies().total() == Approx(start).margin(1e-3 * moving));
  }
}

TEST_CASE("gap laws say what their cut-offs leave out, as their forces have it") {
  const LawStack attraction = withGap(R"({ law = "van_der_waals", lifshitz_constant = "1e-19 J" })");
  // Left out of the work of separation: from the cut-off on, over all of it; 1 / cutoff over 1 / smallest.
  CHECK_THAT(attraction.entries().back().law->truncation(0, 25e-6, false),
             Catch::Contains("up to 6.22e-07 N") && Catch::Contains("at 4e-08 m") &&
                 Catch::Contains("0.01 % of that and 1 % of the work"));
  const LawStack charges = charged("glass", "wall");
  const int same = charges.typeOf(0, 0), wall = charges.typeOf(0, 1);
  const auto& law = *charges.entries().back().law;
  OneContact c(charges, 1e-6, 50e-6);
  const auto force = [&](double z) {
    c.step(-z);
    return c.normal();
  };
  // Image and direct force apart: q^2 / (4 pi eps r^2) of 1e-14 C at 100 um and at 1.1 mm.
  const double direct = 8.9875518e9 * 1e-28 / 1e-8;
  CHECK_THAT(law.truncation(same, 25e-6, false),
             Catch::Contains(
                 fmt::format("image force of up to {:.3g} N",
                             8.9875518e9 * 1e-28 / 1.001001e-8 * 1.001001e-8 / 1.002001e-8 - force(1e-7))) &&
                 Catch::Contains(fmt::format("direct force of up to {:.3g} N", direct)) &&
                 Catch::Contains("0.83 %"));
  CHECK_THAT(law.truncation(wall, 50e-6, true), !Catch::Contains("direct"));
}
