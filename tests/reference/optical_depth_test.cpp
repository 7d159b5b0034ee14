// Optical depth: its sum does not depend on the order of its terms.
#include "reference/optical_depth.hpp"

#include <doctest/doctest.h>

#include <vector>

#include "reference/scenes.hpp"

using namespace facet;
using namespace facet::reference;

TEST_CASE_TEMPLATE("terms in any order give the same bits", T, float, double) {
  test::random r(1);
  std::vector<vec3<T>> terms;
  for (int i = 0; i < 100; ++i) {
    const vec3<T> way = vec3<T>(r.in_cube()) * T(i % 3 == 0 ? 1e6 : 1);
    terms.push_back(way);
    terms.push_back(way * T(-0.9999));
    terms.push_back(abs(vec3<T>(r.in_cube())) * T(0.01));
  }
  const auto sum = [&] {
    optical_depth<T> d;
    for (const vec3<T>& t : terms) d.add(t);
    return d.passing();
  };
  const vec3<T> expected = sum();
  for (int round = 0; round < 50; ++round) {
    for (std::size_t i = terms.size(); i > 1; --i)
      std::swap(terms[i - 1], terms[r.below(std::uint32_t(i))]);
    CHECK(sum() == expected);
  }
}

TEST_CASE_TEMPLATE("a way out as long as the way in leaves nothing behind", T, float, double) {
  optical_depth<T> d;
  for (const T x : {T(1e-9), T(0.3), T(123456.789), T(1e12)}) {
    d.add({x, -x, x});
    d.add({-x, x, -x});
  }
  CHECK(d.passing() == vec3<T>(1, 1, 1));
}

TEST_CASE("the depth is rounded to 2^-32 once a term, and what is below 0 passes whole") {
  optical_depth<double> d;
  d.add({0.25, 1, -1});
  d.add({0.5, 1e9, 0});
  // Two terms: at most 2 * 2^-33 of depth, so that much relatively, and an ulp of exp.
  CHECK(std::abs(d.passing().x - std::exp(-0.75)) <= (0x1p-32 + 0x1p-52) * std::exp(-0.75));
  CHECK(d.passing().y == 0);
  CHECK(d.passing().z == 1);
}
