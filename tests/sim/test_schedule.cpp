// Due steps by whole numbers.

#include "sim/run/schedule.h"

#include <catch2/catch.hpp>

using sandglass::Schedule;

TEST_CASE("Due steps are the nearest to whole multiples of the interval", "[run]") {
  const Schedule third(1.0, 0.3); // 0, 3.33, 6.67, 10, 13.3
  for (const auto& [k, step] : {std::pair{0, 0}, {1, 3}, {2, 7}, {3, 10}, {4, 13}}) {
    CHECK(third.due(k) == step);
    CHECK(third.isDue(step));
    CHECK(third.index(step) == k);
  }
  CHECK_FALSE(third.isDue(4));
  CHECK(third.index(6) == 1);
  CHECK(third.next(0) == 3);
  CHECK(third.next(3) == 7);
  CHECK(third.next(9) == 10);
}

TEST_CASE("No error adds up over many intervals", "[run]") {
  // 0.1 and 1e-5 have no exact binary form; after 1e7 intervals the step is still 1e4 times the count.
  const Schedule schedule(0.1, 1e-5);
  for (const std::int64_t k : {1LL, 3LL, 999'999LL, 10'000'000LL}) {
    CHECK(schedule.due(k) == 10'000 * k);
    CHECK(schedule.isDue(10'000 * k));
    CHECK(schedule.next(10'000 * k - 1) == 10'000 * k);
  }
}

TEST_CASE("Intervals shorter than a step are due at every step, and 0 means never", "[run]") {
  const Schedule dense(0.25, 1.0);
  for (std::int64_t step = 0; step < 5; ++step)
    CHECK(dense.next(step) == step + 1);
  // However short: without a limit the search for its number would not end.
  const Schedule tiny(1e-30, 1.0);
  CHECK(tiny.isDue(1'000'000));
  CHECK(tiny.next(1'000'000) == 1'000'001);
  const Schedule none(0, 1.0);
  CHECK(none.next(7) == Schedule::never);
  CHECK_FALSE(none.isDue(0));
}
