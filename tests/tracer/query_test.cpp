// Hits of the device against those of the reference, bit for bit.
#include <doctest/doctest.h>

#include <vector>

#include "sanitized.hpp"
#include "tracer/device_helper.hpp"
#include "tracer/reference_helper.hpp"
#include "tracer/scenes_helper.hpp"
#include "tracer/tracer.hpp"

using namespace facet;
using test::fewer;
using test::same_bits;
using test::to_reference;
using tracer::device_scene;
using tracer::geometry_kind;
using tracer::hit;
using tracer::layout_kind;
using tracer::options;
using tracer::ray;
using tracer::tree_kind;

namespace {

std::vector<options> every_way() {
  std::vector<options> ways;
  for (tree_kind t : {tree_kind::levels, tree_kind::none})
    for (const auto& [g, layout] : {std::pair(geometry_kind::buffer, layout_kind::wide),
                                    std::pair(geometry_kind::buffer, layout_kind::narrow),
                                    std::pair(geometry_kind::image, layout_kind::automatic)})
      for (bool all : {false, true}) {
        options o;
        o.tree = t;
        o.geometry = g;
        o.layout = layout;
        o.all_features = all;
        o.packets = tracer::packet_kind::off;  // packet_test.cpp
        ways.push_back(o);
      }
  // Wide, without what is written for x86 alone.
  options portable;
  portable.layout = layout_kind::wide;
  portable.packets = tracer::packet_kind::off;
  portable.compiler_flags = " -DFACET_PORTABLE";
  ways.push_back(portable);
  return ways;
}

/// Differing hits of all ways to trace against brute force in the reference; and how many hit.
void check_hits(const scene& s, const std::vector<ray>& rays) {
  const reference::tracer<float> serial(s);
  std::vector<reference::hit<float>> expected;
  std::size_t met = 0;
  for (const ray& r : rays) {
    expected.push_back(serial.closest_brute(to_reference(r)));
    met += expected.back().instance != reference::miss;
  }
  CHECK(met > rays.size() / 20);  // a comparison of misses alone would show nothing
  for (const options& o : every_way()) {
    device_scene on_device(test::queue(), s, o);
    const auto hits = on_device.trace(rays);
    const auto any = on_device.trace(rays, true);
    std::size_t differing = 0, any_differing = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      differing += !same_bits(hits[i], expected[i]);
      any_differing +=
          (any[i].triangle != tracer::miss) != (expected[i].instance != reference::miss);
    }
    CAPTURE(int(o.tree));
    CAPTURE(int(o.geometry));
    CAPTURE(int(o.layout));
    CAPTURE(o.all_features);
    CHECK(differing == 0);
    CHECK(any_differing == 0);
  }
}

}  // namespace

TEST_CASE("one mesh: every tree, geometry and feature set gives the reference's bits") {
  check_hits(test::one_mesh(test::random_soup(500, 1)), test::random_rays(fewer(4000), 1));
}

TEST_CASE("instances, stretched, mirrored, tiny and huge, give the reference's bits") {
  check_hits(test::many_instances(), test::random_rays(fewer(2000), 2, 2));
}

TEST_CASE("a closed smooth mesh gives the reference's bits, from inside and outside") {
  check_hits(
      test::one_mesh(generate("torus_knot", {{"segments", 64}, {"sides", 8}, {"smooth", 1}})),
      test::random_rays(fewer(4000), 3));
}

TEST_CASE("meshes of few triangles, at every size around a leaf of either layout") {
  for (std::uint32_t n : {1u, 2u, 3u, 4u, 5u, 6u, 7u, 8u, 9u, 15u, 16u, 17u, 65u}) {
    CAPTURE(n);
    mesh m = test::random_soup(n, n);
    for (vec3f& p : m.positions) p = p * 2.0f;
    const scene s = test::one_mesh(m);
    const reference::tracer<float> serial(s);
    const auto rays = test::random_rays(fewer(500), n);
    for (const layout_kind layout : {layout_kind::narrow, layout_kind::wide}) {
      options o;
      o.layout = layout;
      const auto hits = device_scene(test::queue(), s, o).trace(rays);
      std::size_t differing = 0;
      for (std::size_t i = 0; i < rays.size(); ++i)
        differing += !same_bits(hits[i], serial.closest_brute(to_reference(rays[i])));
      CHECK(differing == 0);
    }
  }
}

TEST_CASE("of coincident triangles the lowest instance, then the lowest triangle is hit") {
  mesh m = test::random_soup(1, 5);
  m.positions = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  m.indices.clear();
  for (int k = 0; k < 300; ++k) m.indices.insert(m.indices.end(), {0u, 1u, 2u});
  scene s = test::one_mesh(m);
  s.instances.assign(5, instance{});
  const std::vector<ray> rays(64, ray{{0.1f, 0.1f, 2}, 0, {0, 0, -1}, INFINITY});
  for (const options& o : every_way()) {
    device_scene on_device(test::queue(), s, o);
    for (const hit& h : on_device.trace(rays)) {
      CHECK(h.instance == 0);
      CHECK(h.triangle == 0);
      CHECK(h.t == 2);
    }
  }
}

TEST_CASE("triangles without an area are never hit, as in the reference") {
  // Corners on random lines, where rounding alone would open them, and among them ordinary ones.
  test::random r(11);
  mesh m = test::random_soup(50, 8);
  for (int k = 0; k < 400; ++k) {
    const vec3f a = r.in_cube(), step = r.in_cube() * 0x1p-4f;
    const auto first = std::uint32_t(m.positions.size());
    // Sums of few bits, so that the three are on one line exactly.
    const auto grid = [](vec3f v) {
      return vec3f{std::round(v.x * 1024) / 1024, std::round(v.y * 1024) / 1024,
                   std::round(v.z * 1024) / 1024};
    };
    const vec3f from = grid(a), by = grid(step);
    m.positions.insert(m.positions.end(), {from, from + by, from + by * 3.0f});
    m.indices.insert(m.indices.end(), {first, first + 1, first + 2});
  }
  std::vector<ray> rays = test::random_rays(fewer(2000), 4);
  for (int k = 0; k < 400; ++k) {  // through points of the lines
    const vec3f a = m.positions[std::size_t(150 + 3 * k)],
                b = m.positions[std::size_t(152 + 3 * k)];
    const vec3f o = r.in_cube() * 3.0f, to = a + (b - a) * r.uniform(), d = to - o;
    rays.push_back({{o.x, o.y, o.z}, 0, {d.x, d.y, d.z}, INFINITY});
  }
  check_hits(test::one_mesh(m), rays);
  device_scene on_device(test::queue(), test::one_mesh(m));
  for (const hit& h : on_device.trace(rays)) CHECK((h.triangle < 50 || h.triangle == tracer::miss));
}

TEST_CASE("tmin and tmax are inclusive, a negative tmin counts as 0") {
  mesh m;
  m.positions = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  m.indices = {0, 1, 2};
  device_scene on_device(test::queue(), test::one_mesh(m));
  const auto from = [](float z, float tmin, float tmax) {
    return ray{{0, 0, z}, tmin, {0, 0, -1}, tmax};
  };
  const std::vector<ray> rays{from(2, 0, 2),      from(2, 2, 9), from(2, 0, 1.999f),
                              from(2, 2.001f, 9), from(0, 0, 1), from(-1, -5, 5)};
  const auto hits = on_device.trace(rays);
  CHECK(hits[0].t == 2);
  CHECK(hits[1].t == 2);
  CHECK(hits[2].triangle == tracer::miss);
  CHECK(hits[2].t == 1.999f);
  CHECK(hits[3].triangle == tracer::miss);
  CHECK(hits[4].t == 0);
  CHECK(hits[5].triangle == tracer::miss);
}

TEST_CASE("rays that cannot be used meet nothing") {
  device_scene on_device(test::queue(), test::one_mesh(generate("box", {{"size", 2}})));
  const std::vector<ray> rays{{{0, 0, 0}, 0, {0, 0, 0}, 1},
                              {{0, 0, 0}, 0, {NAN, 0, 1}, 1},
                              {{NAN, 0, 0}, 0, {0, 0, 1}, 9},
                              {{0, 0, 0}, NAN, {0, 0, 1}, 9},
                              {{0, 0, 0}, 0, {0, 0, 1}, NAN},
                              {{0, 0, 0}, 5, {0, 0, 1}, 4},
                              {{0, 0, INFINITY}, 0, {0, 0, -1}, INFINITY},
                              {{0, 0, 0}, 0, {0, 0, INFINITY}, INFINITY},
                              {{0, 0, 0}, 0, {0, 0, 1e-30f}, INFINITY}};
  for (const hit& h : on_device.trace(rays)) CHECK(h.triangle == tracer::miss);
}

TEST_CASE("the wide layout is for buffers: with images it is refused") {
  options o;
  o.layout = layout_kind::wide;
  o.geometry = geometry_kind::image;
  CHECK_THROWS_AS(device_scene(test::queue(), test::one_mesh(test::random_soup(3, 1)), o),
                  runtime::exception);
}

TEST_CASE("no rays give no hits, and statistics say what ran") {
  device_scene on_device(test::queue(), test::one_mesh(generate("box", {{"size", 2}})));
  CHECK(on_device.trace({}).empty());
  tracer::statistics stats;
  on_device.trace(test::random_rays(1000, 9), false, 3, &stats);
  CHECK(stats.rays == 1000);
  CHECK(stats.kernel_ms.size() == 3);
  CHECK(stats.tree_nodes > 0);
  CHECK(stats.tree_nodes < 12);
  CHECK(!stats.device.empty());
}
