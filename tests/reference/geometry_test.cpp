// Hits: trees and brute force give the same bits, ties go to the smallest id, closed meshes are
// closed.
#include "reference/geometry.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "reference/scenes.hpp"
#include "sanitized.hpp"

using namespace facet;
using namespace facet::reference;
using test::fewer;

namespace {

/// A closed jagged sphere around `centre`, its corners rounded to float where they lie.
mesh jagged(float scale, vec3f centre) {
  mesh m = generate("noisy_sphere", {{"subdivisions", 3}, {"amplitude", 0.3}});
  for (vec3f& p : m.positions) p = p * scale + centre;
  return m;
}

/// Points inside every jagged sphere of that scale: its radius is at least 0.7.
vec3f inside(test::random& r, float scale, vec3f centre) {
  return r.in_cube() * (0.3f * scale) + centre;
}

/// On the mesh: corner `i`, or a point of one of triangle i's edges.
vec3f on_edge(const mesh& m, test::random& r, bool corner) {
  const std::size_t i = r.below(std::uint32_t(m.triangle_count()));
  const int k = int(r.below(3));
  const vec3f a = m.position(i, k), b = m.position(i, (k + 1) % 3);
  return corner ? a : a + (b - a) * r.uniform();
}

}  // namespace

TEST_CASE_TEMPLATE("the trees give the hits of brute force, bit for bit", T, float, double) {
  const scene s = test::crowd();
  const tracer<T> t(s);
  int hits = 0;
  for (const ray<T>& r : test::rays_into<T>(2, fewer(3000), 1)) {
    const hit<T> expected = t.closest_brute(r);
    REQUIRE(t.closest(r) == expected);
    REQUIRE(t.occluded(r) == bool(expected));
    REQUIRE(t.occluded_brute(r) == bool(expected));
    REQUIRE(t.crossings(r) == t.crossings_brute(r));
    hits += bool(expected);
  }
  CHECK(hits > int(fewer(500)));
}

TEST_CASE("rays onto corners and edges, far from the origin, too") {
  for (const float far : {0.0f, 100.0f}) {
    const scene s = test::scene_of(jagged(1, {far, -far, far}));
    const tracer<float> t(s);
    test::random r(2);
    for (int i = 0; i < 1000; ++i) {
      const vec3f o = vec3f(far, -far, far) + r.in_cube() * 3.0f;
      const ray<float> aimed{o, 0, on_edge(s.meshes[0], r, i % 2 == 0) - o, INFINITY};
      REQUIRE(t.closest(aimed) == t.closest_brute(aimed));
      REQUIRE(t.crossings(aimed) == t.crossings_brute(aimed));
    }
  }
}

TEST_CASE_TEMPLATE("a miss has the ray's tmax, and a scene without triangles only misses", T, float,
                   double) {
  scene empty;
  empty.materials.emplace_back();
  empty.meshes.emplace_back();
  const ray<T> down{{T(0.25), T(0.25), 1}, 0, {0, 0, -1}, 7};
  const hit<T> miss_it{7, 0, 0, miss, miss};
  CHECK(tracer<T>(empty).closest(down) == miss_it);
  empty.instances.emplace_back();
  CHECK(tracer<T>(empty).closest(down) == miss_it);
  CHECK(tracer<T>(empty).closest_brute(down) == miss_it);

  const scene s = test::scene_of(test::unit_triangle());
  const tracer<T> t(s);
  CHECK(t.closest(down) == hit<T>{1, T(0.25), T(0.25), 0, 0});
  CHECK(t.closest({{2, 2, 1}, 0, {0, 0, -1}, 7}) == miss_it);
  CHECK_FALSE(t.closest({down.origin, -3, {0, 0, 1}, 7}));
  CHECK(t.closest({down.origin, -3, {0, 0, -1}, 7}));
  CHECK_FALSE(t.closest({down.origin, NAN, {0, 0, -1}, 7}));
  CHECK_FALSE(t.occluded({down.origin, 0, {0, 0, -T(0x1p-61)}, infinity<T>}));
  CHECK(t.closest({down.origin, 0, {0, 0, -T(0x1p-60)}, infinity<T>}).t == T(0x1p60));
}

TEST_CASE_TEMPLATE("of equal hits the smallest instance, then the smallest triangle wins", T, float,
                   double) {
  for (const std::uint32_t copies : {2u, 7u, 300u}) {
    mesh m;
    for (std::uint32_t k = 0; k < copies; ++k) {
      // Sizes that the tree sorts apart; all hold the square that is aimed at.
      const float half = std::exp2(float(7 * k % 5));
      const float aside = (k % 2 == 0 ? half - 1 : 1 - half);
      const mesh one = test::rectangle({aside, -aside, 0}, {half, 0, 0}, {0, half, 0});
      for (const std::uint32_t i : one.indices) m.indices.push_back(4 * k + i);
      m.positions.insert(m.positions.end(), one.positions.begin(), one.positions.end());
    }
    scene s = test::scene_of(m);
    s.instances.push_back(s.instances[0]);
    const tracer<T> t(s);
    test::random r(3);
    for (int i = 0; i < 100; ++i) {
      // Sixteenths and powers of two: t is exactly 1 for every triangle. Every fourth ray is on the
      // diagonal, that both triangles of a rectangle share.
      const T x = T(int(r.below(32))) / 16 - 1, y = i % 4 == 0 ? x : T(int(r.below(32))) / 16 - 1;
      const ray<T> aimed{{x, y, 1}, 0, {0, 0, -1}, infinity<T>};
      const hit<T> h = t.closest(aimed);
      REQUIRE(h.t == 1);
      REQUIRE(h.instance == 0);
      REQUIRE(h.triangle == (x >= y ? 0 : 1));
      REQUIRE(h == t.closest_brute(aimed));
    }
  }
}

TEST_CASE_TEMPLATE("triangles without an area are never hit", T, float, double) {
  const vec3f a(0, 0, 0), b(1, 0, 0), c(3, 0, 0), d(0.25f, 0.5f, 0.75f);
  const scene s = test::scene_of(test::mesh_of({a, b, c, d, d * 2.0f, d * -3.0f},
                                               {0, 0, 0, 0, 1, 1, 0, 1, 2, 2, 0, 1, 3, 4, 5}));
  const tracer<T> t(s);
  test::random r(8);
  for (int i = 0; i < 10000; ++i) {
    const vec3<T> at = vec3<T>(i % 2 == 0 ? c : d) * T(i % 4 < 2 ? 0.5f : r.uniform());
    const vec3<T> from = i % 8 == 0 ? at + vec3<T>(0, 0, 1) : vec3<T>(r.in_cube()) * T(4);
    const ray<T> aimed{from, 0, at - from, infinity<T>};
    REQUIRE_FALSE(t.closest(aimed));
    REQUIRE_FALSE(t.closest_brute(aimed));
    REQUIRE(t.crossings(aimed).empty());
  }
}

TEST_CASE("a closed jagged sphere never leaks, whatever its scale and place") {
  struct place {
    float scale;
    vec3f centre;
  };
  for (const place& p : {place{1, {}}, place{1, {1e3f, -2e3f, 5e2f}}, place{1e-6f, {}},
                         place{1e6f, {1e6f, 0, 0}}, place{1e3f, {1e6f, 1e6f, -1e6f}}}) {
    const scene s = test::scene_of(jagged(p.scale, p.centre));
    const tracer<float> t(s);
    test::random r(4);
    int leaks = 0;
    for (int i = 0; i < 30000; ++i) {
      const vec3f o = inside(r, p.scale, p.centre);
      const vec3f d = i % 3 == 0 ? r.in_cube() : on_edge(s.meshes[0], r, i % 3 == 1) - o;
      const ray<float> aimed{o, 0, d, INFINITY};
      leaks += !t.closest(aimed) || !t.occluded(aimed);
    }
    CHECK(leaks == 0);
  }
}

TEST_CASE_TEMPLATE("through corners and edges of closed meshes rays enter as often as they leave",
                   T, float, double) {
  for (const char* kind : {"noisy_sphere", "box", "icosphere"}) {
    mesh m =
        kind == std::string("box") ? generate(kind, {}) : generate(kind, {{"subdivisions", 2}});
    for (const bool mirrored : {false, true}) {
      const transform where = mirrored ? transform::translate({0.5, 0.25, -2}) *
                                             transform::rotate({1, 2, 3}, 40) *
                                             transform::scale({-1, 0.75, 1.5})
                                       : transform{};
      const scene s = test::scene_of(m, where);
      const tracer<T> t(s);
      test::random r(5);
      int crossed = 0, miscounted = 0;
      for (int i = 0; i < 10000; ++i) {
        const vec3d o = where.point(vec3d(r.in_cube()) + vec3d(0, 0, i % 2 == 0 ? 6 : -6));
        const vec3d at = where.point(vec3d(on_edge(m, r, i % 3 == 0)));
        int balance = 0;
        for (const auto& c : t.crossings({vec3<T>(o), 0, vec3<T>(at - o), infinity<T>})) {
          balance += c.front ? 1 : -1;
          ++crossed;
        }
        miscounted += balance != 0;
      }
      CHECK(miscounted == 0);
      CHECK(crossed > 10000);
    }
  }
}

TEST_CASE("the sphere is where it should be, by the distance of its facets") {
  // A chord of n subdivisions lies at most 1 - cos(half the edge's angle) under the sphere; the
  // longest edge of the icosahedron's 63.4 degrees is divided by 2^5, and projection to the sphere
  // stretches the middle ones by less than 1.3.
  const scene s = test::scene_of(generate("icosphere", {{"subdivisions", 5}, {"radius", 1}}));
  const double depth = 1 - std::cos(1.3 * 1.107 / 32);
  const tracer<double> t(s);
  test::random r(6);
  for (int i = 0; i < 5000; ++i) {
    const vec3d o = normalize(vec3d(r.in_cube())) * 4.0, at = vec3d(r.in_cube()) * 0.5;
    const vec3d d = normalize(at - o);
    const double along = -dot(o, d), off2 = dot(o, o) - along * along;
    const double exact = along - std::sqrt(1 - off2);
    const hit<double> h = t.closest({o, 0, d, infinity<double>});
    REQUIRE(h);
    // Positions are floats: 2^-24 more. `depth` along the normal is depth / cos along the ray.
    const double cosine = std::sqrt(1 - off2);
    REQUIRE(h.t >= exact - 1e-6);
    REQUIRE(h.t <= exact + (depth + 1e-6) / (cosine - depth));
  }
}

TEST_CASE("float and double meet the same triangles at the same distance") {
  // The test's arithmetic moves a hit by at most the pad's 24u * E across and along the ray, and
  // the rays here differ by no rounding: t off by twice that over the cosine (|d| is about 3).
  const scene s = test::scene_of(jagged(1, {}));
  const tracer<float> f(s);
  const tracer<double> d(s);
  test::random r(7);
  int differ = 0;
  for (int i = 0; i < 5000; ++i) {
    const vec3f o = r.in_cube() * 3.0f, dir = r.in_cube() * 0.5f - o;
    const hit<float> a = f.closest({o, 0, dir, INFINITY});
    const hit<double> b = d.closest({vec3d(o), 0, vec3d(dir), infinity<double>});
    if (a.triangle != b.triangle) {
      ++differ;
      continue;
    }
    if (!b) continue;
    const vec3d p0(s.meshes[0].position(b.triangle, 0)), p1(s.meshes[0].position(b.triangle, 1)),
        p2(s.meshes[0].position(b.triangle, 2));
    const vec3d n = normalize(cross(p1 - p0, p2 - p0));
    const double slope = std::abs(dot(n, vec3d(dir)));
    REQUIRE(std::abs(double(a.t) - b.t) <= 2 * 24 * 0x1p-24 * 4.5 / slope + 0x1p-23 * b.t);
  }
  // An edge is within 6u * E of a ray with a chance of about 1e-5 here.
  CHECK(differ <= 2);
}

TEST_CASE("directions of any length from 2^-60 to 2^60 find the triangle, t scaled") {
  const scene s = test::scene_of(test::unit_triangle(), transform::translate({300, 0, 0}));
  const tracer<float> t(s);
  for (int e = -60; e <= 60; ++e) {
    const float size = std::exp2(float(e));
    const ray<float> r{{300.25f, 0.25f, 10}, 0, {0, 0, -size}, INFINITY};
    const hit<float> h = t.closest(r);
    REQUIRE(h.instance == 0);
    CHECK(h.t == 10 / size);
    CHECK(h == t.closest_brute(r));
  }
}
