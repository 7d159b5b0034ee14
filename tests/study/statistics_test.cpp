#include "study/statistics.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

using facet::study::summarize;

TEST_CASE("median, mean, deviation and range of known values") {
  const auto s = summarize(std::vector<double>{4, 1, 3, 2});
  CHECK(s.median == 2.5);
  CHECK(s.mean == 2.5);
  CHECK(s.least == 1);
  CHECK(s.most == 4);
  CHECK(s.deviation == doctest::Approx(std::sqrt(5.0 / 3)));
  CHECK(summarize(std::vector<double>{9, 1, 2}).median == 2);
}

TEST_CASE("one value has no spread, no value nothing at all") {
  CHECK(summarize(std::vector<double>{7}).deviation == 0);
  CHECK(summarize(std::vector<double>{7}).median == 7);
  CHECK(summarize({}).median == 0);
}
