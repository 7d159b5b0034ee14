// The ray-triangle test: known hits, exact edges, and one owner for each edge.
#include "reference/triangle.hpp"

#include <doctest/doctest.h>

#include <cstdint>

#include "reference/scenes.hpp"

using namespace facet;
using namespace facet::reference;

namespace {

template <class T>
space<T> looking(vec3<T> o, vec3<T> d, T reach = 16) {
  return {o, d, {reach, reach, reach}};
}

template <class T>
const corners<T> unit{vec3<T>(0, 0, 0), vec3<T>(1, 0, 0), vec3<T>(0, 1, 0)};

}  // namespace

TEST_CASE_TEMPLATE("a hit in dyadic numbers is exact: t, u towards p1, v towards p2", T, float,
                   double) {
  const auto s = looking<T>({T(0.25), T(0.5), 2}, {0, 0, T(-0.5)});
  const auto h = triangle_test<T>(s, unit<T>).accept({}, 0, infinity<T>);
  REQUIRE(h);
  CHECK(h->t == 4);
  CHECK(h->u == T(0.25));
  CHECK(h->v == T(0.5));
}

TEST_CASE_TEMPLATE("a ray onto the counter-clockwise side enters, along every axis", T, float,
                   double) {
  for (int axis = 0; axis < 3; ++axis) {
    // Cyclic: a triangle that is counter-clockwise seen from +axis.
    corners<T> p;
    p[1][(axis + 1) % 3] = 1;
    p[2][(axis + 2) % 3] = 1;
    vec3<T> o(T(0.25), T(0.25), T(0.25)), d;
    o[axis] = 3, d[axis] = -1;
    CHECK(triangle_test<T>(looking<T>(o, d), p).side() == 1);
    o[axis] = -3, d[axis] = 1;
    CHECK(triangle_test<T>(looking<T>(o, d), p).side() == -1);
    o[(axis + 1) % 3] = 2;
    CHECK(triangle_test<T>(looking<T>(o, d), p).side() == 0);
  }
}

TEST_CASE_TEMPLATE("t ends are included, and a NaN end refuses", T, float, double) {
  const auto s = looking<T>({T(0.25), T(0.25), 1}, {0, 0, -1});
  const triangle_test<T> test(s, unit<T>);
  CHECK(test.accept({}, 1, 1));
  CHECK_FALSE(test.accept({}, std::nextafter(T(1), T(2)), 2));
  CHECK_FALSE(test.accept({}, 0, std::nextafter(T(1), T(0))));
  CHECK_FALSE(test.accept({}, NAN, 2));
  CHECK_FALSE(test.accept({}, 0, NAN));
}

TEST_CASE("the sign of an edge function is exact") {
  // Products of floats are exact in double, and rounding their difference keeps its sign.
  test::random r(1);
  int decided_by_errors = 0;
  for (int i = 0; i < 200000; ++i) {
    const float k = r.between(0.5f, 2);
    const vec3f p(r.between(-1, 1), r.between(-1, 1), 1);
    const vec3f q(std::nextafter(p.x * k, i % 3 == 0 ? 9.0f : -9.0f), p.y * k, 1);
    const auto s = looking<float>({0, 0, 0}, {0, 0, 1});
    const double exact = double(p.x) * double(q.y) - double(p.y) * double(q.x);
    const float e = edge(sheared<float>(s, p), sheared<float>(s, q));
    REQUIRE((e > 0) == (exact > 0));
    REQUIRE((e < 0) == (exact < 0));
    decided_by_errors += exact != 0 && p.x * q.y == p.y * q.x;
  }
  CHECK(decided_by_errors > 1000);
}

TEST_CASE_TEMPLATE(
    "a ray through a fan's centre or spokes meets every triangle that touches it "
    "and crosses one",
    T, float, double) {
  // Eight triangles around the origin; the ray's shear is exact in these numbers.
  const T rim[8][2] = {{4, 0}, {4, 4}, {0, 4}, {-4, 4}, {-4, 0}, {-4, -4}, {0, -4}, {4, -4}};
  const auto count = [&](vec3<T> o, int& touched, int& crossed) {
    touched = crossed = 0;
    const auto s = looking<T>(o, {0, 0, -1});
    for (int k = 0; k < 8; ++k) {
      const int n = (k + 1) % 8;
      const corners<T> p{vec3<T>(), vec3<T>(rim[k][0], rim[k][1], 0),
                         vec3<T>(rim[n][0], rim[n][1], 0)};
      const triangle_test<T> test(s, p);
      touched += test.accept({}, 0, infinity<T>).has_value();
      crossed += test.side();
    }
  };
  int touched, crossed;
  count({0, 0, 1}, touched, crossed);
  CHECK(touched == 8);
  CHECK(crossed == 1);
  for (const auto& c : rim) {
    count({c[0] / 2, c[1] / 2, 1}, touched, crossed);
    CHECK(touched == 2);
    CHECK(crossed == 1);
  }
}

TEST_CASE_TEMPLATE("a triangle that names a corner twice is never accepted", T, float, double) {
  const vec3<T> a(0, 0, 0), b(1, 0, 0), c(1, T(0.3), T(0.7));
  const corners<T> twice[] = {{a, a, a}, {a, b, b}, {a, b, a}, {b, b, a}, {c, c, a}, {b, c, c}};
  test::random r(2);
  for (const corners<T>& p : twice) {
    for (int i = 0; i < 2000; ++i) {
      const vec3<T> at = p[std::size_t(i % 3)];
      const vec3<T> from = i % 4 == 0 ? at + vec3<T>(0, 0, 1) : vec3<T>(r.in_cube()) * T(4);
      REQUIRE_FALSE(triangle_test<T>(looking<T>(from, at - from), p).accept({}, 0, infinity<T>));
    }
  }
}

TEST_CASE_TEMPLATE("a ray on an edge goes to the side of a shift by (e, e^2) in sheared x and y", T,
                   float, double) {
  // Along -z sheared x is x and sheared y is y: the ray moves to +x, and far less to +y.
  const corners<T> above{vec3<T>(), vec3<T>(4, 4, 0), vec3<T>(0, 4, 0)};
  const corners<T> right{vec3<T>(), vec3<T>(4, 0, 0), vec3<T>(4, 4, 0)};
  const corners<T> left{vec3<T>(), vec3<T>(0, 4, 0), vec3<T>(-4, 4, 0)};
  const auto side = [&](T x, T y, const corners<T>& p) {
    const auto s = looking<T>({x, y, 1}, {0, 0, -1});
    return triangle_test<T>(s, p).side();
  };
  CHECK(side(0, 0, above) == 0);
  CHECK(side(0, 0, right) == 1);
  CHECK(side(0, 0, left) == 0);
  CHECK(side(2, 0, right) == 1);
  CHECK(side(2, 2, above) == 0);
  CHECK(side(2, 2, right) == 1);
  CHECK(side(0, 2, above) == 1);
  CHECK(side(0, 2, left) == 0);
}

TEST_CASE("where products underflow, the triangle's own slab interval still holds t") {
  // Edge functions of 2^-132 times 2^-40 are 0: without the clamp t would be, too.
  const float size = 0x1p-66f, away = 0x1p-40f;
  const corners<float> p{vec3f(-size, -size, 0), vec3f(size, -size, 0), vec3f(0, size, 0)};
  const auto s = looking<float>({0, 0, away}, {0, 0, -1}, size);
  const auto h = triangle_test<float>(s, p).accept({}, 0, infinity<float>);
  REQUIRE(h);
  CHECK(std::abs(h->t - away) <= 2 * s.pad);
}

TEST_CASE("coordinates whose products overflow still give t") {
  const float big = 0x1p59f;
  const corners<float> p{vec3f(-big, -big, 0), vec3f(big, -big, 0), vec3f(0, big, 0)};
  const auto s = looking<float>({0, 0, big}, {0, 0, -1}, big);
  const auto h = triangle_test<float>(s, p).accept({}, 0, infinity<float>);
  REQUIRE(h);
  CHECK(h->t == big);
  CHECK(h->u == 0.25f);
  CHECK(h->v == 0.5f);
}
