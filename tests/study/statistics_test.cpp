#include "study/statistics.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <vector>

using namespace facet::study;

namespace {

/// The chance that the median of n values, n odd, drawn with replacement from x_1 < ... < x_n is at
/// most x_k: that more than half of the draws are (Efron 1979, section 3).
double chance_of_median_up_to(int k, int n) {
  const double p = double(k) / n;
  double sum = 0, ways = 1;  // n over j
  for (int j = 0; j <= n; ++j) {
    if (2 * j > n) sum += ways * std::pow(p, j) * std::pow(1 - p, n - j);
    ways = ways * (n - j) / (j + 1);
  }
  return sum;
}

std::vector<double> one_to(int n) {
  std::vector<double> values;
  for (int i = n; i >= 1; --i) values.push_back(i);
  return values;
}

}  // namespace

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
  CHECK(median_interval(std::vector<double>{7}, {}) == interval{7, 7});
  CHECK(median_interval(std::vector<double>(9, 0.5), {}) == interval{0.5, 0.5});
  CHECK(median_interval({}, {}) == interval{});
  CHECK(ratio_interval(std::vector<double>{6}, std::vector<double>{3}, {}) == interval{2, 2});
  CHECK(ratio_interval({}, std::vector<double>{3}, {}) == interval{});
}

// Of n distinct values, n odd, the bootstrap's median is one of them, and how often is known. The
// ends must be the values at which the known distribution passes 2.5% and 97.5%. With these n it
// does not pass within 0.6% of them; 20,000 draws err by 0.1% (one standard deviation).
TEST_CASE(
    "the interval's ends are where Efron's distribution of the median passes its percentiles") {
  for (const int n : {3, 7, 11, 13, 21}) {
    CAPTURE(n);
    int low = 1;
    while (chance_of_median_up_to(low, n) < 0.025) ++low;
    REQUIRE(std::abs(chance_of_median_up_to(low, n) - 0.025) > 0.006);
    if (low > 1) REQUIRE(std::abs(chance_of_median_up_to(low - 1, n) - 0.025) > 0.006);
    for (const std::uint64_t seed : {1u, 2u, 77u}) {
      const interval found = median_interval(one_to(n), {20000, 0.95, seed});
      CHECK(found == interval{double(low), double(n + 1 - low)});
    }
  }
}

TEST_CASE("a wider level gives a wider interval, a seed the same one again") {
  std::mt19937_64 random(5);
  std::vector<double> values;
  for (int i = 0; i < 40; ++i) values.push_back(double(random() >> 40));
  const interval narrow = median_interval(values, {2000, 0.5, 3}),
                 wide = median_interval(values, {2000, 0.99, 3});
  CHECK(wide.low < narrow.low);
  CHECK(narrow.high < wide.high);
  CHECK(median_interval(values, {2000, 0.5, 3}) == narrow);
  const double median = summarize(values).median;
  CHECK(narrow.low <= median);
  CHECK(median <= narrow.high);
}

TEST_CASE("a ratio's interval is the median's where one side does not vary, upside down below") {
  const std::vector<double> values{4, 5, 6, 7, 8, 9, 10}, two(7, 2.0);
  const interval of = median_interval(values, {20000, 0.95, 1});
  CHECK(ratio_interval(values, two, {20000, 0.95, 1}) == interval{of.low / 2, of.high / 2});
  CHECK(ratio_interval(two, values, {20000, 0.95, 1}) == interval{2 / of.high, 2 / of.low});
}

TEST_CASE("intervals overlap from end to end, and one may hold the other") {
  CHECK(interval{1, 2}.overlaps({2, 3}));
  CHECK(interval{2, 3}.overlaps({1, 2}));
  CHECK(interval{1, 4}.overlaps({2, 3}));
  CHECK(!interval{1, 2}.overlaps({2.5, 3}));
  CHECK(!interval{2.5, 3}.overlaps({1, 2}));
}

TEST_CASE("the best are all that overlap the best one, not those that overlap another of them") {
  const std::vector<estimate> estimates{
      {5, {4.5, 5.5}},   // overlaps the third only
      {3, {2.9, 3.2}},   // the best
      {4, {3.1, 4.6}},   // overlaps the best
      {9, {8, 10}},      // alone
      {3, {3.0, 3.05}},  // within the best's
  };
  CHECK(best_set(estimates) == std::vector<std::size_t>{1, 2, 4});
  CHECK(best_set({}).empty());
  CHECK(best_set(std::vector<estimate>{{1, {1, 1}}}) == std::vector<std::size_t>{0});
}
