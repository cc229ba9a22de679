#include "sim/base/error.h"
#include "sim/scene/units.h"

#include <catch2/catch.hpp>

#include <limits>
#include <numbers>
#include <thread>
#include <vector>

using namespace sandglass;

TEST_CASE("quantities become SI numbers", "[units]") {
  // Metric prefixes round once: the result is the number nearest to the quotient.
  CHECK(parseQuantity("3 mm", "m") == 3.0 / 1000);
  CHECK(parseQuantity("2.24mm", "m") == 2.24 / 1000);
  CHECK(parseQuantity("5.23e-4 s", "s") == 5.23e-4);
  CHECK(parseQuantity("2500 kg/m^3", "kg/m^3") == 2500);
  CHECK(parseQuantity("2.5 g/cm^3", "kg/m^3") == Approx(2500).epsilon(1e-15));
  CHECK(parseQuantity("140.4 g/(cm s)", "kg/(m s)") == Approx(14.04).epsilon(1e-15));
  CHECK(parseQuantity("250000 g/s^2", "N/m") == Approx(250).epsilon(1e-15));
  CHECK(parseQuantity("1000 1/s", "1/s") == 1000);
  CHECK(parseQuantity("0.3 nJ", "J") == Approx(3e-10).epsilon(1e-15));
  CHECK(parseQuantity("-9.81 m s^-2", "m/s^2") == -9.81);
  CHECK(parseQuantity("1 µm", "m") == 1e-6);
  CHECK(parseQuantity("+1.5 m", "m") == 1.5);
}

TEST_CASE("angles and rates of turning are in radians", "[units]") {
  CHECK(parseQuantity("180 deg", "rad") == Approx(std::numbers::pi).epsilon(1e-15));
  CHECK(parseQuantity("180°", "rad") == Approx(std::numbers::pi).epsilon(1e-15));
  CHECK(parseQuantity("60 rpm", "rad/s") == Approx(2 * std::numbers::pi).epsilon(1e-15));
  CHECK(parseQuantity("360 deg/s", "rad/s") == Approx(2 * std::numbers::pi).epsilon(1e-15));
  CHECK(parseQuantity("2 rad/s", "rad/s") == 2);
}

TEST_CASE("plain numbers and zero need no unit", "[units]") {
  CHECK(parseQuantity("0.5", "1") == 0.5);
  CHECK(parseQuantity("50 %", "1") == 0.5);
  CHECK(parseQuantity("0", "m") == 0);
}

TEST_CASE("what is no quantity of the dimension is refused with a phrase", "[units]") {
  CHECK_THROWS_WITH(parseQuantity("3 kg", "m"), "a mass, but a length is due, such as \"3 mm\"");
  CHECK_THROWS_WITH(parseQuantity("3", "m"), "but the unit is missing; a length is due, such as \"3 mm\"");
  CHECK_THROWS_WITH(parseQuantity("2 5 mm", "m"),
                    "but '5 mm' is not a unit; a length is due, such as \"3 mm\"");
  CHECK_THROWS_WITH(parseQuantity("3 mm @ 5", "m"),
                    "but 'mm @ 5' is not a unit; a length is due, such as \"3 mm\"");
  CHECK_THROWS_WITH(parseQuantity("20 degC", "K"),
                    "but 'degC' is no multiple of K; a temperature is due, such as \"300 K\"");
  CHECK_THROWS_WITH(parseQuantity("5 kg^2", "m"),
                    "a quantity in kg^2, but a length is due, such as \"3 mm\"");
  for (const char* text : {"", "m", "nan m", "inf m", "1e400 m", "1e308 Gm", "0x3 m", "3 m m", "3 metters"})
    CHECK_THROWS_AS(parseQuantity(text, "m"), InputError);
}

TEST_CASE("written quantities read back to the same bits", "[units]") {
  for (const double value :
       {0.1, 1.0 / 3, 2.24e-3, 5e-324, 1.7976931348623157e308, -1e-5, 123456789.123456789})
    for (const char* unit : {"m", "kg/m^3", "1", "rad/s", "N s/m"})
      CHECK(parseQuantity(quantityText(value, unit), unit) == value);
  CHECK(std::signbit(parseQuantity(quantityText(-0.0, "m"), "m")));
}

TEST_CASE("quantities can be read from several threads", "[units]") {
  std::vector<std::thread> threads;
  std::vector<int> right(4);
  for (std::size_t t = 0; t < right.size(); ++t)
    threads.emplace_back([&right, t] {
      for (int i = 0; i < 200; ++i)
        if (parseQuantity("2 cm", "m") == 0.02) ++right[t];
    });
  for (auto& thread : threads)
    thread.join();
  CHECK(right == std::vector<int>(4, 200));
}
