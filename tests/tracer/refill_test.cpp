// Work-items that take one ray after the other: hits are those of a work-item a ray, bit for bit.
#include <doctest/doctest.h>

#include <cstring>
#include <vector>

#include "tracer/device_helper.hpp"
#include "tracer/random_helper.hpp"
#include "tracer/scenes_helper.hpp"
#include "tracer/tracer.hpp"

using namespace facet;
using tracer::device_scene;
using tracer::hit;
using tracer::layout_kind;
using tracer::options;
using tracer::ray;
using tracer::refill_kind;

namespace {

options refilled(refill_kind kind = refill_kind::on) {
  options o;
  o.layout = layout_kind::narrow;
  o.refill = kind;
  return o;
}

/// Short ways and long ones, none at all (behind tmax), and rays that are refused.
std::vector<ray> mixed_rays(std::size_t count) {
  test::random r(7);
  std::vector<ray> rays;
  for (std::size_t k = 0; k < count; ++k) {
    const vec3f o = r.in_cube() * 3.0f, d = r.in_cube() * (k % 3 == 0 ? 5.0f : 1.0f) - o;
    rays.push_back({{o.x, o.y, o.z}, 0, {d.x, d.y, d.z}, k % 8 == 3 ? 0.5f : INFINITY});
    if (k % 11 == 5) rays.back().tmin = 2, rays.back().tmax = 1;
    if (k % 13 == 7) rays.back().direction[1] = NAN;
  }
  return rays;
}

void check_same(const scene& s, const std::vector<ray>& rays) {
  device_scene one_each(test::queue(), s, refilled(refill_kind::off));
  device_scene in_turn(test::queue(), s, refilled());
  for (const bool any : {false, true}) {
    tracer::statistics expected_stats, stats;
    const auto expected = one_each.trace(rays, any, 1, &expected_stats);
    const auto found = in_turn.trace(rays, any, 2, &stats);
    CHECK_FALSE(expected_stats.is_refilled);
    CHECK(stats.is_refilled);
    CHECK(stats.refused == expected_stats.refused);
    REQUIRE(found.size() == rays.size());
    std::size_t differing = 0, met = 0;
    for (std::size_t k = 0; k < rays.size(); ++k) {
      differing += std::memcmp(&found[k], &expected[k], sizeof(hit)) != 0;
      met += found[k].triangle != tracer::miss;
    }
    CHECK(differing == 0);
    CHECK(met > 0);
    CHECK(met < rays.size());
  }
}

}  // namespace

TEST_CASE("rays in turn meet what rays with a work-item each do, in one mesh and among instances") {
  for (const std::size_t count : {30, 64, 5000}) {
    CAPTURE(count);
    check_same(test::one_mesh(generate("icosphere", {{"radius", 1}, {"subdivisions", 3}})),
               mixed_rays(count));
    check_same(test::many_instances(), mixed_rays(count));
  }
}

TEST_CASE("a scene without a triangle is missed") {
  device_scene on(test::queue(), test::one_mesh({}), refilled());
  for (const hit& h : on.trace(mixed_rays(100))) CHECK(h.triangle == tracer::miss);
}

TEST_CASE("few rays have a work-item each unless asked otherwise") {
  const scene s = test::one_mesh(generate("icosphere", {{"radius", 1}, {"subdivisions", 1}}));
  device_scene on(test::queue(), s, refilled(refill_kind::automatic));
  tracer::statistics stats;
  on.trace(mixed_rays(100), false, 1, &stats);
  CHECK_FALSE(stats.is_refilled);
}

TEST_CASE("what it needs and is not there is named") {
  const scene s = test::one_mesh(generate("icosphere", {{"radius", 1}, {"subdivisions", 1}}));
  options wide = refilled();
  wide.layout = layout_kind::wide;
  CHECK_THROWS_WITH_AS(device_scene(test::queue(), s, wide), doctest::Contains("the wide layout"),
                       runtime::exception);
  options bare = refilled();
  bare.tree = tracer::tree_kind::none;
  CHECK_THROWS_WITH_AS(device_scene(test::queue(), s, bare), doctest::Contains("no tree"),
                       runtime::exception);
}
