// End-point overlap: worked out by hand, by points instead of clipping, and of devices' trees.
#include "study/end_point_overlap.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <vector>

#include "study/tree_makers.hpp"

using namespace facet;
using namespace facet::study;
using facet::tracer::plain_tree;
using facet::tracer::texel;

namespace {

void add(std::vector<texel>& to, vec3f a, vec3f b, vec3f c) {
  for (const vec3f& p : {a, b, c}) to.push_back({p.x, p.y, p.z, 0});
}

/// Two leaves under a root, of the triangles before `split` and of the rest.
plain_tree two_leaves(const std::vector<texel>& corners, std::uint32_t split) {
  const auto count = std::uint32_t(corners.size() / 3);
  plain_tree t;
  t.nodes = {{{}, false, 1, 2}, {{}, true, 0, split}, {{}, true, split, count - split}};
  for (std::uint32_t i = 0; i < count; ++i) {
    t.primitives.push_back(i);
    for (std::size_t k = 0; k < 3; ++k) {
      const texel& p = corners[3 * i + k];
      t.nodes[0].box.add(vec3f{p[0], p[1], p[2]});
      t.nodes[i < split ? 1 : 2].box.add(vec3f{p[0], p[1], p[2]});
    }
  }
  return t;
}

std::vector<texel> random_triangles(std::size_t n, std::uint64_t seed) {
  std::mt19937_64 bits(seed);
  const auto any = [&] { return float(bits() >> 40) * 0x1p-24f; };
  std::vector<texel> corners;
  for (std::size_t i = 0; i < n; ++i) {
    const vec3f at{any(), any(), any()};
    const auto near = [&] { return at + vec3f{any(), any(), any()} * 0.3f; };
    const vec3f a = near(), b = near(), c = near();
    add(corners, a, b, c);
  }
  return corners;
}

plain_tree binary_tree(const std::vector<texel>& corners) {
  return tracer::built_tree(made_by(*tree_maker_of("sah"), corners), corners);
}

bool is_in(const box3f& b, vec3d p) {
  return b.lo.x <= p.x && p.x <= b.hi.x && b.lo.y <= p.y && p.y <= b.hi.y && b.lo.z <= p.z &&
         p.z <= b.hi.z;
}

}  // namespace

TEST_CASE("boxes that do not meet overlap nothing") {
  std::vector<texel> corners;
  add(corners, {0, 0, 0}, {1, 0, 0}, {0, 1, 1});
  add(corners, {0, 0, 0}, {1, 1, 0}, {0, 1, 1});
  add(corners, {2, 0, 0}, {3, 0, 0}, {2, 1, 1});
  const end_point_overlap o = overlap_of(two_leaves(corners, 2), corners, 100, 1);
  CHECK(o.value == 0);
  CHECK(o.standard_error == 0);
  CHECK(o.triangles == 3);
  CHECK(!o.is_sampled);
}

TEST_CASE("boxes that share a side overlap nothing, unless a triangle lies in it") {
  std::vector<texel> corners;
  add(corners, {0, 0, 0}, {1, 0, 0}, {0, 1, 1});
  add(corners, {1, 0, 0}, {2, 0, 0}, {1, 1, 1});
  CHECK(overlap_of(two_leaves(corners, 1), corners, 100, 1).value == 0);
  add(corners, {1, 0, 0}, {1, 0, 1}, {1, 1, 0});  // in x = 1, all within the first one's box
  // Half of sqrt(2) twice, and 1/2: that is the whole surface.
  const double whole = std::sqrt(2.0) + 0.5;
  // Products, sums and a root in double, of a few numbers of one size.
  CHECK(overlap_of(two_leaves(corners, 1), corners, 100, 1).value ==
        doctest::Approx(0.5 / whole).epsilon(1e-15));
}

TEST_CASE("a triangle is clipped to the other leaf's box, whose triangles each count") {
  // The large one has legs of 4 in z = 0, and area 8. In the box [1, 2] x [1, 2] x [-1, 1] lies a
  // square of 1; in [1, 3] x [1, 3] what is left of the line x + y = 4, half a square of 4.
  for (const float side : {2.0f, 3.0f}) {
    std::vector<texel> corners;
    add(corners, {0, 0, 0}, {4, 0, 0}, {0, 4, 0});
    add(corners, {1, 1, -1}, {side, 1, 1}, {1, side, -1});
    add(corners, {1, 1, 1}, {side, side, 1}, {1, side, -1});
    const double inside = side == 2.0f ? 1 : 2;
    double surface = 8;
    for (std::size_t t = 1; t < 3; ++t) {
      const auto at = [&](std::size_t k) {
        return vec3d{corners[3 * t + k][0], corners[3 * t + k][1], corners[3 * t + k][2]};
      };
      surface += 0.5 * length(cross(at(1) - at(0), at(2) - at(0)));
    }
    // The small ones lie in the box [0, 4] x [0, 4] x {0} along a line at most: no area.
    const end_point_overlap o = overlap_of(two_leaves(corners, 1), corners, 100, 1);
    CHECK(o.value == doctest::Approx(2 * inside / surface).epsilon(1e-14));
  }
}

TEST_CASE("clipping finds what points on the surface find, and samples what all triangles do") {
  const auto corners = random_triangles(300, 7);
  const plain_tree t = binary_tree(corners);
  const end_point_overlap all = overlap_of(t, corners, 300, 1);
  CHECK(all.standard_error == 0);

  // The same quantity by definition: a random point of the surface lies in so many nodes that do
  // not hold its triangle.
  std::vector<double> areas(300);
  double surface = 0;
  const auto at = [&](std::size_t i, std::size_t k) {
    return vec3d{corners[3 * i + k][0], corners[3 * i + k][1], corners[3 * i + k][2]};
  };
  for (std::size_t i = 0; i < 300; ++i)
    surface += areas[i] = 0.5 * length(cross(at(i, 1) - at(i, 0), at(i, 2) - at(i, 0)));
  std::vector<std::vector<bool>> holds(t.nodes.size(), std::vector<bool>(300, false));
  for (std::size_t n = t.nodes.size(); n-- > 0;)
    for (std::uint32_t k = t.nodes[n].first; k < t.nodes[n].first + t.nodes[n].count; ++k)
      if (t.nodes[n].is_leaf)
        holds[n][t.primitives[k]] = true;
      else
        for (std::size_t i = 0; i < 300; ++i) holds[n][i] = holds[n][i] || holds[k][i];
  std::mt19937_64 bits(3);
  const auto any = [&] { return double(bits() >> 11) * 0x1p-53; };
  double mean = 0, variance = 0;
  constexpr int points = 100;  // a triangle
  for (std::size_t i = 0; i < 300; ++i) {
    double sum = 0, squares = 0;
    for (int k = 0; k < points; ++k) {
      double u = any(), v = any();
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const vec3d p = at(i, 0) + (at(i, 1) - at(i, 0)) * u + (at(i, 2) - at(i, 0)) * v;
      double met = 0;
      for (std::size_t n = 0; n < t.nodes.size(); ++n)
        met += !holds[n][i] && is_in(t.nodes[n].box, p);
      sum += met, squares += met * met;
    }
    const double share = areas[i] / surface;
    mean += share * sum / points;
    variance += share * share * (squares - sum * sum / points) / (points - 1) / points;
  }
  // Five standard errors: a fair sum of 300 independent means misses by more once in 10^6 seeds,
  // and this seed is fixed.
  CHECK(std::abs(mean - all.value) < 5 * std::sqrt(variance));
  CHECK(5 * std::sqrt(variance) < 0.05 * all.value);

  const end_point_overlap some = overlap_of(t, corners, 200, 1);
  CHECK(some.is_sampled);
  CHECK(some.triangles == 200);
  CHECK(some.standard_error > 0);
  CHECK(std::abs(some.value - all.value) < 5 * some.standard_error);
  CHECK(overlap_of(t, corners, 200, 1).value == some.value);
  CHECK(overlap_of(t, corners, 200, 2).value != some.value);
}

TEST_CASE("the standard error says how far samples scatter") {
  const auto corners = random_triangles(300, 7);
  const plain_tree t = binary_tree(corners);
  double sum = 0, squares = 0, said = 0;
  constexpr int runs = 200;
  for (std::uint64_t seed = 1; seed <= runs; ++seed) {
    const end_point_overlap o = overlap_of(t, corners, 50, seed);
    sum += o.value, squares += o.value * o.value;
    said += o.standard_error * o.standard_error;
  }
  const double scatter = (squares - sum * sum / runs) / (runs - 1);
  // The variance of 200 near-normal values is known to sqrt(2 / 199) = 10%; four of these.
  CHECK(scatter / (said / runs) == doctest::Approx(1).epsilon(0.4));
}

TEST_CASE("a lone leaf, no tree, and triangles without an area overlap nothing") {
  const auto corners = random_triangles(4, 1);
  plain_tree t;
  t.nodes = {{{}, true, 0, 4}};
  t.primitives = {2, 0, 3, 1};
  CHECK(overlap_of(t, corners, 100, 1).value == 0);
  CHECK(overlap_of({}, {}, 100, 1).value == 0);
  const std::vector<texel> points(12, texel{1, 1, 1, 0});
  CHECK(overlap_of(two_leaves(points, 2), points, 100, 1).value == 0);
}
