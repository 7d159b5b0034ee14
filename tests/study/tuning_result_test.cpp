// The rule by which a value is taken: faster by more than the spread and the margin, or not at all.
#include "study/tuning_result.hpp"

#include <doctest/doctest.h>

#include <random>

using namespace facet::study;

namespace {

using samples = std::vector<std::vector<double>>;

/// Two workloads of 10 rounds; each time is off by up to `noise` of itself.
samples times_of(double first, double second, double noise, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  samples s(2);
  for (int k = 0; k < 10; ++k)
    for (std::size_t w = 0; w < 2; ++w)
      s[w].push_back((w == 0 ? first : second) *
                     (1 + noise * (2 * double(random() >> 11) * 0x1p-53 - 1)));
  return s;
}

relative_time relative(const samples& kept, const samples& own) {
  return relative_to(kept, own, tuning_settings().drawing());
}

trial trial_of(const relative_time& t) {
  trial one;
  one.relative = t;
  return one;
}

relative_time sure(double median) { return {{median}, median, {median - 0.01, median + 0.01}}; }

}  // namespace

TEST_CASE("relative time is the geometric mean over the workloads, in each round") {
  const relative_time t = relative({{1, 1, 2}, {10, 10, 10}}, {{2, 4, 2}, {5, 40, 10}});
  REQUIRE(t.rounds.size() == 3);
  CHECK(t.rounds[0] == doctest::Approx(1));
  CHECK(t.rounds[1] == doctest::Approx(4));
  CHECK(t.rounds[2] == doctest::Approx(1));
  CHECK(t.median == doctest::Approx(1));
  CHECK(t.range.high == doctest::Approx(4));
}

TEST_CASE("a machine that slows down in a round slows both, which cancels") {
  const relative_time t = relative({{1, 3, 1}}, {{0.9, 2.7, 0.9}});
  CHECK(t.range.low == doctest::Approx(0.9));
  CHECK(t.range.high == doctest::Approx(0.9));
  CHECK(is_faster(t, {}));
}

TEST_CASE("a value that was dropped early is held against the first rounds alone") {
  const relative_time t = relative({{1, 1, 1, 9}}, {{2, 2, 2}});
  CHECK(t.rounds.size() == 3);
  CHECK(t.median == doctest::Approx(2));
}

TEST_CASE("a refused value has no relative time, and is never faster") {
  const relative_time t = relative({{1, 1}}, {{}});
  CHECK(t.rounds.empty());
  CHECK(!is_faster(t, {}));
}

TEST_CASE("times that are not greater than 0 are refused") {
  CHECK_THROWS_AS(relative({{1}}, {{0}}), std::invalid_argument);
  CHECK_THROWS_AS(relative({{0}}, {{1}}), std::invalid_argument);
}

TEST_CASE("faster by more than the margin and the spread is taken; less is not") {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    CAPTURE(seed);
    const samples kept = times_of(5, 50, 0.02, seed);
    CHECK(is_faster(relative(kept, times_of(4.5, 45, 0.02, seed + 1000)), {}));
    // As fast, or faster by less than the margin: whatever the noise.
    CHECK(!is_faster(relative(kept, times_of(5, 50, 0.02, seed + 2000)), {}));
    CHECK(!is_faster(relative(times_of(5, 50, 0, seed), times_of(4.95, 49.5, 0, seed)), {}));
    // One workload gains what the other loses.
    CHECK(!is_faster(relative(kept, times_of(2.5, 100, 0.02, seed + 3000)), {}));
  }
}

TEST_CASE("the challenger is the fastest of those that pass, and never the kept value") {
  choice_result c;
  c.trials = {trial_of({}), trial_of(sure(0.9)), trial_of(sure(0.8)), trial_of(sure(1.1))};
  CHECK(challenger_of(c, {}) == 2u);
  // The fastest by its median, but too uncertain.
  c.trials.push_back(trial_of({{0.5}, 0.5, {0.4, 1.2}}));
  CHECK(challenger_of(c, {}) == 2u);
  c.trials = {trial_of({}), trial_of(sure(0.985))};
  CHECK(!challenger_of(c, {}).has_value());
}

TEST_CASE("a challenger is taken if its second rounds say the same, and only then") {
  choice_result c;
  c.trials = {trial_of({}), trial_of(sure(1.1)), trial_of(sure(0.8))};
  CHECK(taken_of(c, {}) == 0);
  c.challenger = 2;
  CHECK(taken_of(c, {}) == 0);
  c.confirmation = sure(0.9);
  CHECK(taken_of(c, {}) == 2);
  c.confirmation = sure(0.975);  // its interval reaches beyond the margin
  CHECK(taken_of(c, {}) == 0);
}
