// Rays that go through the tree in lists against the reference, bit for bit.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "tracer/device_helper.hpp"
#include "tracer/hits_helper.hpp"
#include "tracer/layout.hpp"
#include "tracer/scenes_helper.hpp"
#include "tracer/tracer.hpp"

using namespace facet;
using test::differing_from_reference;
using test::hits_of;
using tracer::device_scene;
using tracer::hit;
using tracer::options;
using tracer::packet_kind;
using tracer::ray;
using tracer::stream_kind;

namespace {

/// Streams are a CPU's.
bool is_skipped() {
  if (test::device().is_gpu()) MESSAGE("skipped: streams are for CPUs");
  return test::device().is_gpu();
}

options in_streams() {
  options o = test::in_packets();
  o.streams = stream_kind::on;
  return o;
}

options with(std::vector<tracer::kernel_edit> edits) {
  options o = in_streams();
  o.edits = std::move(edits);
  return o;
}

/// Neighbours go different ways, so that packets take none of them. One in eight ends on its way.
std::vector<ray> scattered_rays(std::size_t count, std::uint64_t seed) {
  test::random r(seed);
  std::vector<ray> rays;
  for (std::size_t i = 0; i < count; ++i) {
    const vec3f o = r.in_cube() * 2.0f, d = r.in_cube() - o;
    rays.push_back({{o.x, o.y, o.z}, 0, {d.x, d.y, d.z}, i % 8 == 3 ? 0.7f : INFINITY});
  }
  return rays;
}

/// Parallel squares one behind the other, of two triangles each: a ray along them meets all boxes.
mesh pile(std::uint32_t squares) {
  mesh m;
  for (std::uint32_t k = 0; k < squares; ++k) {
    const float z = -0.01f * float(k);
    for (const vec3f p : {vec3f{-1, -1, z}, {1, -1, z}, {1, 1, z}, {-1, 1, z}})
      m.positions.push_back(p);
    for (const std::uint32_t c : {0, 1, 2, 0, 2, 3}) m.indices.push_back(4 * k + c);
  }
  return m;
}

}  // namespace

TEST_CASE("streams: scattered rays give the reference's bits, and do go in lists and alone") {
  if (is_skipped()) return;
  const mesh meshes[] = {generate("torus_knot", {{"segments", 64}, {"sides", 8}}),
                         test::random_soup(3000, 1)};
  const auto rays = scattered_rays(10000, 7);
  for (const mesh& m : meshes) {
    const scene s = test::one_mesh(m);
    CHECK(differing_from_reference(s, rays, in_streams()) == 0);
    options portable = in_streams();
    portable.compiler_flags = " -DFACET_PORTABLE";
    CHECK(differing_from_reference(s, rays, portable) == 0);
  }
  // Each of the ways that rays go is needed: did none ever go one of them, nothing above would have
  // shown anything of it.
  const tracer::kernel_edit lost[] = {
      {"trace_streams.cl", "!search_stream(s, positions, x, taken, mode)", "false"},
      {"search_stream.h", "alone.doubtful |= meet_leaf(", "if (false) meet_leaf("},
      {"search_stream.h", "walk(s, positions, x, &alone, mode);", ""},
      {"walk.h", "if (all->count == WALKS_WAIT) walk(s, positions, x, all, mode);",
       "if (all->count == WALKS_WAIT) all->count = 0u;"},
      // Rays of another kind meet the wrong sides of boxes first.
      {"search_stream.h", "kind & 4u ? FACET_SIDE : 0u", "0u"}};
  for (const tracer::kernel_edit& e : lost) {
    CAPTURE(e.from);
    CHECK(differing_from_reference(test::one_mesh(meshes[1]), rays, with({e})) > 0);
  }
}

TEST_CASE("streams: a list that has no room left goes on ray by ray") {
  if (is_skipped()) return;
  const scene s = test::one_mesh(pile(300));
  test::random r(3);
  std::vector<ray> rays;
  for (std::size_t i = 0; i < 2048; ++i) {
    const vec3f o = r.in_cube() * 0.5f;
    // From behind, and of one kind.
    const float x = 0.01f + 0.2f * r.uniform(), y = 0.01f + 0.2f * r.uniform();
    rays.push_back({{o.x, o.y, -5.0f - float(i % 7)}, 0, {x * 0.01f, y * 0.01f, 1}, INFINITY});
  }
  // Streams of 512 rays, so few are there, and room for less than two nodes' children.
  const tracer::kernel_edit narrow{"search_stream.h", "sum_of(counts) > FACET_LISTS",
                                   "sum_of(counts) > 5000u"};
  options apart = with({narrow});
  apart.compiler_flags = " -DFACET_PACKET_WIDTH=0.0f";  // no packets
  CHECK(differing_from_reference(s, rays, apart) == 0);
  apart.edits = {narrow,
                 {"search_stream.h", "for (uint i = 0u; i < count; ++i) add_walker(",
                  "for (uint i = 0u; i < 0u * count; ++i) add_walker("}};
  CHECK(differing_from_reference(s, rays, apart) > 0);
}

TEST_CASE("streams: triangles too small for t to be sure of are met, in lists and alone") {
  if (is_skipped()) return;
  // Twice their areas are some 2^-80 in units of E^2 (triangle.h: is_tiny), for E is that of one
  // large triangle beside them.
  mesh m = test::random_soup(300, 2);
  for (vec3f& p : m.positions) p = p * 0x1p-40f;
  for (const vec3f p : {vec3f{1, 1, 1}, {1, 1, 0.9f}, {1, 0.9f, 1}}) {
    m.indices.push_back(std::uint32_t(m.positions.size()));
    m.positions.push_back(p);
  }
  const scene s = test::one_mesh(m);
  auto rays = scattered_rays(4000, 8);
  for (ray& r : rays)
    for (float* o : {&r.origin[0], &r.origin[1], &r.origin[2]}) *o *= 0x1p-40f;
  CHECK(differing_from_reference(s, rays, in_streams()) == 0);
  CHECK(hits_of(s, rays, in_streams()) > rays.size() / 8);
  const tracer::kernel_edit all_alone{"search_stream.h", "sum_of(counts) > FACET_LISTS",
                                      "sum_of(counts) + 1u > 0u"};
  CHECK(differing_from_reference(s, rays, with({all_alone})) == 0);
  // Doubts that are not told of lose hits.
  CHECK(differing_from_reference(
            s, rays,
            with({{"search_stream.h", "alone.doubtful |= meet_leaf(", "meet_leaf("},
                  {"walk.h", "all->doubtful |= lanes_of(doubtful);", ""}})) > 0);
  CHECK(differing_from_reference(
            s, rays, with({all_alone, {"walk.h", "all->doubtful |= lanes_of(doubtful);", ""}})) >
        0);
}

TEST_CASE("streams: rays that are odd or cannot be used are as they are by themselves") {
  if (is_skipped()) return;
  const mesh m = test::random_soup(500, 3);
  const scene s = test::one_mesh(m);
  const ray odd[] = {{{0, 0, 3}, 0, {0, 0, -1}, INFINITY},
                     {{0, 3, 0}, 0, {0, -1, 1e-9f}, INFINITY},
                     {{0, 0, 0}, 0, {1, -0.0f, 0}, INFINITY},
                     {{0, 0, 0}, 0, {1, 1, 1}, INFINITY},
                     {{0, 0, 0}, 5, {0, 0, 1}, 4},
                     {{1e5f, 0, 0}, 0, {-1, 0, 0}, INFINITY},
                     {{0, 0, 0}, -1, {1e-18f, 0, 0}, INFINITY},
                     {{0, 0, 0}, 0, {1e18f, 1, 1}, INFINITY},
                     {{0, 0, 1e19f}, 0, {0, 0, -1e-3f}, INFINITY},
                     {{0, 0, 3}, 0, {NAN, 0, -1}, INFINITY},
                     {{0, 0, 3}, 0, {0, 0, -INFINITY}, INFINITY},
                     {{0, NAN, 3}, 0, {0, 0, -1}, INFINITY},
                     {{0, 0, 3}, NAN, {0, 0, -1}, INFINITY},
                     {{0, 0, 3}, 0, {0, 0, -1}, NAN},
                     {{0, 0, 3}, 0, {0, 0, -1e-30f}, INFINITY}};
  std::vector<ray> rays = scattered_rays(3000, 9);
  for (std::size_t i = 0; i < rays.size(); i += 5) rays[i] = odd[i / 5 % std::size(odd)];
  options plain = in_streams();
  plain.packets = packet_kind::off;
  plain.streams = stream_kind::off;
  tracer::statistics expected_stats, stats;
  const auto expected =
      device_scene(test::queue(), s, plain).trace(rays, false, 1, &expected_stats);
  const auto found = device_scene(test::queue(), s, in_streams()).trace(rays, false, 1, &stats);
  CHECK(stats.is_streamed);
  CHECK(stats.refused == expected_stats.refused);
  CHECK(stats.refused > 0);
  std::size_t differing = 0;
  for (std::size_t i = 0; i < rays.size(); ++i)
    differing += found[i].triangle != expected[i].triangle || found[i].u != expected[i].u ||
                 (found[i].t != expected[i].t && !std::isnan(expected[i].t));
  CHECK(differing == 0);
}

TEST_CASE(
    "streams: any number of rays, whole streams or not, and none of a scene without triangles") {
  if (is_skipped()) return;
  const scene s = test::one_mesh(generate("icosphere", {{"subdivisions", 2}}));
  const auto rays = scattered_rays(2 * FACET_STREAM + 40, 2);
  for (const std::size_t n : {1u, FACET_PACKET - 1, FACET_PACKET, FACET_PACKET + 1,
                              FACET_STREAM - 1, FACET_STREAM + 1, 2 * FACET_STREAM + 40}) {
    CAPTURE(n);
    CHECK(differing_from_reference(s, {rays.begin(), rays.begin() + std::ptrdiff_t(n)},
                                   in_streams()) == 0);
  }
  for (const hit& h : device_scene(test::queue(), test::one_mesh({}), in_streams()).trace(rays))
    CHECK(h.triangle == tracer::miss);
}

TEST_CASE("streams: of coincident triangles the lowest is hit, whichever is met first") {
  if (is_skipped()) return;
  mesh m = pile(1);
  const std::vector<std::uint32_t> square = m.indices;
  for (int k = 1; k < 300; ++k) m.indices.insert(m.indices.end(), square.begin(), square.end());
  const scene s = test::one_mesh(m);
  const auto rays = scattered_rays(4000, 4);
  CHECK(differing_from_reference(s, rays, in_streams()) == 0);
  CHECK(hits_of(s, rays, in_streams()) > rays.size() / 20);
  CHECK(differing_from_reference(
            s, rays, with({{"stream.h", "!is_before(s, 0u, slot, 0u, best)", "false"}})) > 0);
}

TEST_CASE("streams: where they cannot be they are refused, and few rays do not take them") {
  if (is_skipped()) return;
  options alone = in_streams();
  alone.packets = packet_kind::off;
  CHECK_THROWS_WITH_AS(device_scene(test::queue(), test::one_mesh(generate("box", {})), alone),
                       doctest::Contains("found no packets"), runtime::exception);
  CHECK_THROWS_WITH_AS(device_scene(test::queue(), test::many_instances(), in_streams()),
                       doctest::Contains("found instances"), runtime::exception);
  options automatic = in_streams();
  automatic.streams = stream_kind::automatic;
  device_scene on(test::queue(), test::one_mesh(generate("box", {})), automatic);
  tracer::statistics stats;
  on.trace(scattered_rays(100, 1), false, 1, &stats);
  CHECK_FALSE(stats.is_streamed);
  const std::size_t many = 4096u * test::device().max_compute_units();
  on.trace(scattered_rays(many, 1), false, 1, &stats);
  CHECK(stats.is_streamed);
}
