// Hits that are wrong in ways that are known beforehand.
#include "study/hit_errors.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "scene/generate.hpp"
#include "scene/world_bounds.hpp"
#include "study/cases/lab.hpp"
#include "tracer/device_helper.hpp"
#include "tracer/scenes_helper.hpp"

using namespace facet;

namespace {

/// A square from -1 to 1 at z = 0, of two triangles that share the diagonal x = y, and a larger one
/// at z = -3.
scene two_squares() {
  mesh m;
  m.positions = {{-1, -1, 0},  {1, -1, 0},  {1, 1, 0},  {-1, 1, 0},
                 {-4, -4, -3}, {4, -4, -3}, {4, 4, -3}, {-4, 4, -3}};
  m.indices = {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7};
  return test::one_mesh(m);
}

using study::make_ray;

/// Down along z from 5 above.
tracer::ray down(float x, float y) { return make_ray({x, y, 5}, {0, 0, -1}); }

struct bench {
  scene s = two_squares();
  reference::tracer<double> exact{s};
  study::hit_oracle oracle{s, exact, 1};

  /// What the oracle says if the only ray's hit is the given triangle (or a miss) at t.
  study::hit_errors judge(const tracer::ray& r, std::uint32_t triangle, float t = 5) const {
    const study::ray_set set{"eye", {r}};
    const auto expected = oracle.trace(set);
    const bool hit = triangle != tracer::miss;
    const std::vector<tracer::hit> found{{t, 0, 0, hit ? 0 : tracer::miss, triangle}};
    return oracle.judge(set, expected, found, found);
  }
};

}  // namespace

TEST_CASE("the right triangle is right, whatever t is; so is a miss where nothing is") {
  const bench b;
  CHECK(b.judge(down(0.5f, -0.5f), 0).wrong() == 0);
  CHECK(b.judge(down(0.5f, -0.5f), 0, 7).wrong() == 0);
  const auto miss = b.judge(down(9, 9), tracer::miss, INFINITY);
  CHECK(miss.wrong() == 0);
  CHECK(miss.compared == 0);
}

TEST_CASE("the neighbour at an edge that the ray passes within the bound is a tie") {
  const bench b;
  const double bound = study::sideways_bound(world_box<double>(b.s), down(0, 0));
  CHECK(bound == 64 * 0x1p-24 * 8);           // |5| + 3 along z
  const auto across = [&](double distance) {  // from the diagonal, on the side of triangle 0
    return down(float(0.25 + distance / std::sqrt(2)), float(0.25 - distance / std::sqrt(2)));
  };
  const auto tie = b.judge(across(0), 1);
  CHECK(tie.ties == 1);
  CHECK(tie.wrong() == 1);
  CHECK(b.judge(across(bound / 2), 1).ties == 1);
  const auto apart = b.judge(across(4 * bound), 1);
  CHECK(apart.ties == 0);
  CHECK(apart.errors == 1);
  CHECK(apart.first_errors == std::vector<std::uint64_t>{0});
}

TEST_CASE("beside the square's outer edge what lies behind is a silhouette, farther in an error") {
  const bench b;
  const float just_inside = std::nextafter(1.0f, 0.0f);
  CHECK(b.judge(down(just_inside, -0.5f), 2, 8).silhouettes == 1);
  CHECK(b.judge(down(0.99f, -0.5f), 2, 8).errors == 1);
  // And a miss: at the edge of the larger square, not of the smaller one, behind which it lies.
  CHECK(b.judge(down(std::nextafter(4.0f, 0.0f), -0.5f), tracer::miss).silhouettes == 1);
  CHECK(b.judge(down(just_inside, -0.5f), tracer::miss).errors == 1);
}

TEST_CASE("a hit where nothing is, is an error; at an edge, a silhouette") {
  const bench b;
  CHECK(b.judge(down(4.5f, 0), 2, 8).errors == 1);
  CHECK(b.judge(down(std::nextafter(4.0f, 5.0f), -0.5f), 2, 8).silhouettes == 1);
}

TEST_CASE("the triangle that a ray leaves is an error, however near it is") {
  const bench b;
  study::ray_set set{"bounce", {make_ray({0.5f, -0.5f, 1e-7f}, {0, 0.1f, 1})}, {{0, 0}}};
  const auto expected = b.oracle.trace(set);
  REQUIRE(!expected[0]);
  const std::vector<tracer::hit> found{{0, 0, 0, 0, 0}};
  const auto e = b.oracle.judge(set, expected, found, found);
  CHECK(e.errors == 1);
  CHECK(e.self_hits == 1);
}

TEST_CASE("t is counted in floats from the double t, by powers of two") {
  const bench b;
  study::ray_set set{"eye", {}};
  std::vector<tracer::hit> found;
  for (const int steps : {0, 0, 1, -1, 2, 3, -4, 5}) {
    set.rays.push_back(down(0.5f, -0.5f));
    float t = 5;
    for (int k = 0; k < std::abs(steps); ++k) t = std::nextafter(t, steps > 0 ? 9.0f : 0.0f);
    found.push_back({t, 0, 0, 0, 0});
  }
  auto strict = found;
  strict[3].u = -0.0f;
  const auto e = b.oracle.judge(set, b.oracle.trace(set), found, strict);
  CHECK(e.compared == 8);
  CHECK(e.ulps == std::vector<std::uint64_t>{2, 2, 1, 2, 1});  // 0, 1, 2, to 4, to 8
  CHECK(e.median_ulps == 2);
  CHECK(e.most_ulps == 5);
  CHECK(e.other_bits == 1);
  CHECK(e.wrong() == 0);
}

TEST_CASE("moved instances: the strict kernel's hits have no errors, and t is near") {
  const scene s = test::many_instances();
  const reference::tracer<double> exact(s);
  const study::hit_oracle oracle(s, exact, 2);
  tracer::device_scene on(test::queue(), s);
  const study::ray_set eye = study::eye_rays(s, 96, 72);
  for (const study::ray_set& set : {eye, study::bounce_rays(s, eye, 3, 2)}) {
    CAPTURE(set.name);
    CHECK(set.rays.size() > 500);
    const auto hits = on.trace(set.rays);
    const auto e = oracle.judge(set, oracle.trace(set), hits, hits);
    CHECK(e.rays == set.rays.size());
    CHECK(e.errors == 0);
    CHECK(e.other_bits == 0);
  }
}

TEST_CASE("eye rays are those of the render kernel: what they hit is where the picture is solid") {
  scene s = test::many_instances();
  s.samples = 2;
  s.background_alpha = 0;
  tracer::device_scene on(test::queue(), s);
  const picture p = on.render(32, 24, 0);
  const auto hits = on.trace(study::eye_rays(s, 32, 24).rays);
  REQUIRE(hits.size() == 4u * 32 * 24);
  for (std::uint32_t y = 0; y < 24; ++y)
    for (std::uint32_t x = 0; x < 32; ++x) {
      int met = 0;
      for (std::size_t k = 0; k < 4; ++k)
        met += hits[4 * (y * 32 + x) + k].triangle != tracer::miss;
      CHECK(p.at(x, y)[3] == float(met) / 4);
    }
}

TEST_CASE("bounce rays leave what was hit, by the seed alone") {
  const scene s = two_squares();
  const study::ray_set eye = study::eye_rays(s, 16, 12);
  const study::ray_set a = study::bounce_rays(s, eye, 1, 1), b = study::bounce_rays(s, eye, 1, 2),
                       c = study::bounce_rays(s, eye, 2, 1);
  REQUIRE(!a.rays.empty());
  CHECK(a.rays.size() == a.from.size());
  CHECK(a.rays.size() == c.rays.size());
  bool is_other = false;
  for (std::size_t i = 0; i < a.rays.size(); ++i) {
    const vec3f d = study::direction_of(a.rays[i]);
    CHECK(d == study::direction_of(b.rays[i]));
    CHECK(a.from[i] == b.from[i]);
    is_other = is_other || !(d == study::direction_of(c.rays[i]));
    CHECK(d.z > 0);
    CHECK(std::abs(length(d) - 1) < 4 * 0x1p-24f);  // three components, each rounded once
  }
  CHECK(is_other);
}
