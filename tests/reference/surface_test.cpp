// Points, their error bounds and normals at a hit.
#include "reference/surface.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "reference/scenes.hpp"

using namespace facet;
using namespace facet::reference;

namespace {

template <class T>
surface<T> surface_on(const scene& s, const ray<T>& r) {
  const geometry<T> g(s);
  return surface_at(g, g.closest(r, road::tree), r.direction);
}

}  // namespace

TEST_CASE("the error bound covers the rounding of the point") {
  const mesh ball = generate("noisy_sphere", {{"subdivisions", 2}});
  test::random r(1);
  for (const double scale : {1e-6, 1.0, 1e6})
    for (const double offset : {0.0, 1.0, 1e6}) {
      const transform where =
          transform::translate(vec3d(1, -1, 0.5) * (offset * std::min(scale, 1.0))) *
          transform::rotate({1, 1, 0}, 25) * transform::scale({scale, scale * 0.7, scale});
      const scene s = test::scene_of(ball, where);
      const geometry<float> g(s);
      const geometry<double> exact(s);
      double worst = 0;
      for (int i = 0; i < 500; ++i) {
        const auto triangle = r.below(std::uint32_t(ball.triangle_count()));
        const float u = r.uniform() * 0.5f, v = r.uniform() * 0.5f;
        const auto a = surface_at(g, hit<float>{1, u, v, 0, triangle}, vec3f(0, 0, 1));
        const auto b =
            surface_at(exact, hit<double>{1, double(u), double(v), 0, triangle}, vec3d(0, 0, 1));
        // The double matrix is not the rounded one: that difference (u |m| |p|) is part of e_fwd.
        const double off = std::abs(dot(vec3d(a.point) - b.point, b.geometric));
        worst = std::max(worst, off / double(a.delta));
      }
      CHECK(worst < 1);
    }
}

TEST_CASE("a ray that leaves a surface does not meet it again, at any scale, offset and angle") {
  const mesh ball = generate("icosphere", {{"subdivisions", 2}, {"smooth", 0}});
  for (const double scale : {1e-6, 1.0, 1e6})
    for (const double offset : {0.0, 1.0, 1e4, 1e6}) {
      // In float at most 2^-24 * offset of the surface is left: beyond that there is no sphere.
      if (offset * 1e-7 > 0.05) continue;
      const transform where = transform::translate(vec3d(1, -1, 0.5) * (offset * scale)) *
                              transform::rotate({1, 1, 0}, 25) *
                              transform::scale({scale, scale, scale});
      const scene s = test::scene_of(ball, where);
      const geometry<float> g(s);
      test::random r(2);
      int again = 0;
      for (int i = 0; i < 3000; ++i) {
        const vec3f inside(where.point({0, 0, 0}));
        const vec3f d = normalize(r.in_cube());
        const auto h = g.closest({inside, 0, d, INFINITY}, road::tree);
        REQUIRE(h);
        const auto at = surface_at(g, h, d);
        REQUIRE_FALSE(at.front);
        // Outwards: a convex body is not met again from outside, however flat the angle.
        vec3f tangent = normalize(cross(at.geometric, r.in_cube()));
        const float lift = i % 4 == 0 ? 1.0f : i % 4 == 1 ? 1e-2f : i % 4 == 2 ? 1e-4f : 1e-6f;
        const vec3f out = normalize(tangent - at.geometric * lift);
        const auto met = g.closest({at.far_side(), 0, out, INFINITY}, road::tree);
        again += met.triangle == h.triangle;
        // And inwards it leaves the triangle behind, too.
        const auto deep = g.closest(
            {at.near_side(), 0, normalize(tangent + at.geometric * lift), INFINITY}, road::tree);
        again += deep.triangle == h.triangle;
      }
      CHECK(again == 0);
    }
}

TEST_CASE_TEMPLATE("a mirrored or stretched instance keeps its outside", T, float, double) {
  const transform stretched = transform::rotate({0, 1, 0}, 30) * transform::scale({2, 0.5, 1});
  const mesh ball = generate("icosphere", {{"subdivisions", 3}, {"smooth", 1}});
  for (const transform& where : {stretched, stretched * transform::scale({-1, 1, 1})}) {
    const scene s = test::scene_of(ball, where);
    test::random r(3);
    for (int i = 0; i < 50; ++i) {
      const vec3<T> o = normalize(vec3<T>(r.in_cube())) * T(5), d = normalize(-o);
      const surface<T> at = surface_on<T>(s, {o, 0, d, infinity<T>});
      CHECK(at.front);
      CHECK(dot(at.geometric, d) < 0);
      CHECK(dot(at.shading, at.geometric) > T(0.9));
      // The ellipsoid's normal is M^-T M^-1 p; facets of 3 subdivisions turn by less than 0.1 under
      // smooth normals, stretched by at most 4.
      const transform back = where.inverse();
      const vec3d exact = normalize(back.transposed_vector(back.vector(vec3d(at.point))));
      CHECK(length(vec3d(at.shading) - exact) < 0.1);
    }
  }
}

TEST_CASE_TEMPLATE("vertex normals that cancel give way to the geometric normal", T, float,
                   double) {
  mesh m = test::unit_triangle();
  m.normals = {{0, 0, 1}, {0, 0, -1}};
  m.normal_indices = {0, 1, 1};
  // At u = 1/2, v = 0 the first two cancel exactly.
  const scene s = test::scene_of(m);
  const surface<T> at = surface_on<T>(s, {{T(0.5), 0, 1}, 0, {0, 0, -1}, infinity<T>});
  CHECK(at.shading == vec3<T>(0, 0, 1));
  CHECK(at.geometric == vec3<T>(0, 0, 1));
}

TEST_CASE("tiny triangles have unit normals") {
  // Squares of these normals underflow in float.
  mesh m = test::unit_triangle();
  for (vec3f& p : m.positions) p = p * 1e-12f;
  const surface<float> at = surface_on<float>(
      test::scene_of(m), {{2e-13f, 2e-13f, 1e-12f}, 0, normalize(vec3f(0.1f, 0, -1)), INFINITY});
  CHECK(at.geometric == vec3f(0, 0, 1));
}
