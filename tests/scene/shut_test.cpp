// Triangles that no ray meets.
#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "scene/generate.hpp"
#include "scene/shut.hpp"

using namespace facet;

namespace {

mesh of(std::vector<vec3f> positions, std::vector<std::uint32_t> indices) {
  mesh m;
  m.positions = std::move(positions);
  m.indices = std::move(indices);
  return m;
}

const vec3f a(0, 0, 0), b(1, 1, 1), c(2, 2, 2), left(0, 2, 1), right(2, 0, 1);

}  // namespace

TEST_CASE("points and lines are shut, slivers are not") {
  CHECK(shut_triangles(of({a, b, left}, {0, 0, 0, 0, 1, 0, 0, 1, 2})) ==
        std::vector<bool>{true, true, false});
  // Thirds are rounded, and so is what lies on their line; b is exactly halfway.
  CHECK(shut_triangles(of({a, b, c}, {0, 1, 2})) == std::vector<bool>{true});
  CHECK(shut_triangles(of({a, b, vec3f(2, 2, std::nextafter(2.0f, 3.0f))}, {0, 1, 2})) ==
        std::vector<bool>{false});
}

TEST_CASE("corners on a line have no area, a sliver one ulp wide has") {
  std::mt19937 r(3);
  for (int i = 0; i < 1000; ++i) {
    // Steps of 2^-12 up to 2^11: all sums and products here are exact in float.
    const auto step = [&] { return float(int(r() % 4096) - 2048) * 0x1p-12f; };
    const vec3f p(step(), step(), step()), d(step(), step(), step());
    const vec3f q = p + d * float(r() % 64), s = p - d * float(r() % 64);
    CHECK_FALSE(has_area(p, q, s));
    if (q == p || s == p || d == vec3f()) continue;
    const int axis = d.x != 0 ? 1 : 0;
    vec3f beside = q;
    beside[axis] = std::nextafter(q[axis], 9.0f);
    CHECK(has_area(p, beside, s));
  }
}

TEST_CASE("a line between triangles that share all its edges stays open") {
  // The square a right c left, cut along a c on one side and along a b, b c on the other.
  const std::vector<vec3f> corners{a, b, c, left, right};
  CHECK(shut_triangles(of(corners, {0, 2, 3, 0, 1, 2, 0, 4, 1, 1, 4, 2})) ==
        std::vector<bool>{false, false, false, false});
  // Without one of the neighbours it has an edge of its own.
  CHECK(shut_triangles(of(corners, {0, 2, 3, 0, 1, 2, 0, 4, 1})) ==
        std::vector<bool>{false, true, false});
}

TEST_CASE("corners are compared by where they are, not by their numbers") {
  CHECK(shut_triangles(of({a, c, left, a, b, c, a, right, b, b, right, c},
                          {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11})) ==
        std::vector<bool>{false, false, false, false});
}

TEST_CASE("lines that hold only one another are shut, and those that they held fall with them") {
  // Twice the same line: every edge is shared, but nothing has an area.
  CHECK(shut_triangles(of({a, b, c}, {0, 1, 2, 2, 1, 0})) == std::vector<bool>{true, true});
  // Two lines side by side, of which the second has an edge of its own.
  const vec3f d(3, 3, 3);
  CHECK(shut_triangles(of({a, b, c, d, left}, {0, 1, 2, 0, 2, 3, 0, 1, 4, 1, 2, 4})) ==
        std::vector<bool>{true, true, false, false});
}

TEST_CASE("a sphere that was rounded far away keeps the lines that close it") {
  mesh m = generate("noisy_sphere", {{"subdivisions", 4}});
  for (vec3f& p : m.positions) p = vec3f(vec3d(p) + vec3d(6.2e5, -4.9e5, 6.1e5));
  std::size_t lines = 0, kept = 0;
  const std::vector<bool> is_shut = shut_triangles(m);
  for (std::size_t t = 0; t < m.triangle_count(); ++t) {
    const vec3f p = m.position(t, 0), q = m.position(t, 1), r = m.position(t, 2);
    if (has_area(p, q, r) || p == q || q == r || r == p) continue;
    ++lines;
    kept += !is_shut[t];
  }
  CHECK(lines > 5);
  CHECK(kept == lines);
}
