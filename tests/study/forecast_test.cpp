#include "study/forecast.hpp"

#include <doctest/doctest.h>

using facet::study::forecast;

TEST_CASE("a forecast counts what was spent, what is known, and the rest as what was tried") {
  forecast f(4);
  CHECK(f.total_ms() == 0);
  f.tried(100, 10, 5);  // 100 now, 50 later
  CHECK(f.spent_ms() == 100);
  CHECK(f.total_ms() == 4 * 150);
  f.tried(300, 30, 5);  // 300 now, 150 later: 300 on average
  CHECK(f.spent_ms() == 400);
  CHECK(f.total_ms() == 400 + 200 + 2 * 300);
  f.refused();
  CHECK(f.total_ms() == 400 + 200 + 300);
  f.refused();
  f.timed(12, 10);  // it took 2 more than was known
  CHECK(f.spent_ms() == 412);
  CHECK(f.total_ms() == 412 + 190);
  f.drop(30, 5);
  f.drop(10, 4);
  CHECK(f.total_ms() == f.spent_ms());
}

TEST_CASE("what takes exactly as long as forecast ends where the forecast said") {
  forecast f(3);
  f.tried(50, 5, 10);
  const double said = f.total_ms();
  f.tried(50, 5, 10);
  f.tried(50, 5, 10);
  for (int i = 0; i < 30; ++i) {
    CHECK(f.total_ms() == said);
    f.timed(5, 5);
  }
  CHECK(f.spent_ms() == said);
}
