// Rays that are traced together against the reference, bit for bit.
#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "tracer/device_helper.hpp"
#include "tracer/hits_helper.hpp"
#include "tracer/layout.hpp"
#include "tracer/reference_helper.hpp"
#include "tracer/scenes_helper.hpp"
#include "tracer/tracer.hpp"

using namespace facet;
using test::differing_from_reference;
using test::hits_of;
using test::in_packets;
using tracer::device_scene;
using tracer::hit;
using tracer::options;
using tracer::packet_kind;
using tracer::ray;

namespace {

constexpr std::size_t packet = FACET_PACKET;

/// Packet after packet, each towards a corner, a point of an edge or any point of the mesh: all at
/// that point itself or spread around it, from one point or from several close to one another.
std::vector<ray> close_rays(const mesh& m, std::size_t packets, std::uint64_t seed) {
  test::random r(seed);
  std::vector<ray> rays;
  for (std::size_t g = 0; g < packets; ++g) {
    const std::uint32_t t = r.below(std::uint32_t(m.triangle_count()));
    const vec3f a = m.position(t, 0), b = m.position(t, 1), c = m.position(t, 2);
    const vec3f to = g % 3 == 0   ? a
                     : g % 3 == 1 ? a + (b - a) * r.uniform()
                                  : (a + b + c) * (1.0f / 3);
    const vec3f from = r.in_cube() * (g % 4 == 0 ? 1.0f : 3.0f);
    const float spread = g % 5 == 0 ? 0.0f : g % 5 == 1 ? 1e-5f : g % 5 == 2 ? 1e-3f : 3e-2f;
    for (std::size_t k = 0; k < packet; ++k) {
      const vec3f o = g % 2 == 0 ? from : from + r.in_cube() * 0.02f;
      const vec3f d = to + r.in_cube() * spread - o;
      rays.push_back({{o.x, o.y, o.z}, 0, {d.x, d.y, d.z}, k % 8 == 3 ? 1.0f : INFINITY});
    }
  }
  return rays;
}

}  // namespace

TEST_CASE("packets: rays that stay close give the reference's bits, and do go together") {
  const mesh meshes[] = {test::random_soup(500, 1),
                         generate("torus_knot", {{"segments", 64}, {"sides", 8}})};
  for (const mesh& m : meshes) {
    const scene s = test::one_mesh(m);
    const auto rays = close_rays(m, 300, 7);
    CHECK(differing_from_reference(s, rays, in_packets()) == 0);
    options portable = in_packets();
    portable.compiler_flags = " -DFACET_PORTABLE";
    CHECK(differing_from_reference(s, rays, portable) == 0);
    // Were no packet ever searched, nothing above would have shown anything.
    options lost = in_packets();
    lost.edits = {
        {"trace_packet.h", "search_packet(s, positions, &world, together, mode, part);", ""}};
    const std::size_t met = hits_of(s, rays, in_packets());
    CHECK(met > rays.size() / 2);
    CHECK(hits_of(s, rays, lost) < met / 2);
    // Nor if no ray of one ever went on alone, or all did.
    options alone = in_packets();
    alone.edits = {{"search_packet.h", "search_from(s, positions, node,",
                    "if (false) search_from(s, positions, node,"}};
    CHECK(hits_of(s, rays, alone) < met);
    CHECK(hits_of(s, rays, alone) > met / 4);
    // Hits are lost by a beam that holds one lane's rays alone.
    options narrow_beam = in_packets();
    narrow_beam.edits = {
        {"beam.h", "largest ? larger_each(even, odd) : smaller_each(even, odd)", "even"}};
    CHECK(differing_from_reference(s, rays, narrow_beam) > 0);
  }
}

TEST_CASE("packets: through instances, too, turned, stretched, mirrored, tiny and huge") {
  const scene s = test::many_instances();
  // Its triangles in the world, to aim at.
  mesh all;
  for (const instance& i : s.instances) {
    const mesh& m = s.meshes[i.mesh];
    for (std::uint32_t t = 0; t < m.triangle_count(); t += 20)
      for (int k = 0; k < 3; ++k) {
        all.positions.push_back(vec3f(i.world_from_object.point(vec3d(m.position(t, k)))));
        all.indices.push_back(std::uint32_t(all.indices.size()));
      }
  }
  const auto rays = close_rays(all, 600, 3);
  CHECK(differing_from_reference(s, rays, in_packets()) == 0);
  // Packets do enter instances, not only rays by themselves: hits are lost where none of them does.
  const std::size_t met = hits_of(s, rays, in_packets());
  CHECK(met > rays.size() / 2);
  options outside = in_packets();
  outside.edits = {{"packet.h",
                    "inner->outer[k] = box_intervals(&world->rays[k], vec_global(i->lo), "
                    "vec_global(i->hi));",
                    "inner->outer[k].near = in_all(1.0f), inner->outer[k].far = in_all(0.0f);"}};
  CHECK(hits_of(s, rays, outside) < met / 2);
  // An instance's beam is not the world's.
  options one_beam = in_packets();
  one_beam.edits = {
      {"search_packet.h", "space = &inner;", "inner.beam = world->beam, space = &inner;"}};
  CHECK(differing_from_reference(s, rays, one_beam) > 0);
}

TEST_CASE("packets: rays among which one is odd give the reference's bits") {
  const mesh m = test::random_soup(200, 3);
  const scene s = test::one_mesh(m);
  std::vector<ray> rays = close_rays(m, 100, 9);
  const ray odd[] = {{{0, 0, 3}, 0, {0, 0, -1}, INFINITY},
                     {{0, 3, 0}, 0, {0, -1, 1e-9f}, INFINITY},
                     {{0, 0, 0}, 0, {1, -0.0f, 0}, INFINITY},
                     {{0, 0, 0}, 0, {1, 1, 1}, INFINITY},
                     {{0, 0, 0}, 5, {0, 0, 1}, 4},
                     {{1e5f, 0, 0}, 0, {-1, 0, 0}, INFINITY},
                     {{0, 0, 0}, -1, {1e-18f, 0, 0}, INFINITY},
                     {{0, 0, 0}, 0, {1e18f, 1, 1}, INFINITY}};
  for (std::size_t g = 0; g < 100; ++g) rays[packet * g + g % packet] = odd[g % std::size(odd)];
  CHECK(differing_from_reference(s, rays, in_packets()) == 0);
}

TEST_CASE("packets: a ray that cannot be used is counted, and meets nothing; the others hit") {
  const scene s = test::one_mesh(generate("box", {{"size", 2}}));
  const ray bad[] = {
      {{0, 0, 3}, 0, {NAN, 0, -1}, INFINITY},    {{0, 0, 3}, 0, {0, 0, -INFINITY}, INFINITY},
      {{0, NAN, 3}, 0, {0, 0, -1}, INFINITY},    {{INFINITY, 0, 3}, 0, {0, 0, -1}, INFINITY},
      {{0, 0, 3}, NAN, {0, 0, -1}, INFINITY},    {{0, 0, 3}, 0, {0, 0, -1}, NAN},
      {{0, 0, 3}, 0, {0, 0, -1e-30f}, INFINITY}, {{0, 0, 3}, 0, {0, 0, -1e30f}, INFINITY}};
  for (const ray& b : bad)
    for (const std::size_t at : {std::size_t(0), std::size_t(13), packet - 1}) {
      CAPTURE(at);
      CAPTURE(&b - bad);
      std::vector<ray> rays(packet, ray{{0.1f, 0.2f, 3}, 0, {0, 0, -1}, INFINITY});
      rays[at] = b;
      device_scene on(test::queue(), s, in_packets());
      tracer::statistics stats;
      const auto hits = on.trace(rays, false, 1, &stats);
      CHECK(stats.refused == 1);
      for (std::size_t i = 0; i < packet; ++i)
        CHECK((hits[i].triangle == tracer::miss) == (i == at));
    }
}

TEST_CASE("packets: any number of rays, whole packets or not") {
  const mesh m = generate("icosphere", {{"subdivisions", 2}});
  const scene s = test::one_mesh(m);
  const auto rays = close_rays(m, 5, 2);
  for (const std::size_t n : {std::size_t(1), packet - 1, packet, packet + 1, 4 * packet + 7}) {
    CAPTURE(n);
    CHECK(differing_from_reference(s, {rays.begin(), rays.begin() + std::ptrdiff_t(n)},
                                   in_packets()) == 0);
  }
}

TEST_CASE("packets: of coincident triangles the lowest is hit, in whatever lane it lies") {
  mesh m = test::random_soup(1, 5);
  m.positions = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  m.indices.clear();
  for (int k = 0; k < 300; ++k) m.indices.insert(m.indices.end(), {0u, 1u, 2u});
  test::random r(4);
  std::vector<ray> rays;
  for (std::size_t i = 0; i < 4 * packet; ++i)
    rays.push_back({{0.1f, 0.1f, 2}, 0, {0.02f * r.uniform(), 0.02f * r.uniform(), -1}, INFINITY});
  for (const hit& h : device_scene(test::queue(), test::one_mesh(m), in_packets()).trace(rays))
    CHECK(h.triangle == 0);
}

TEST_CASE("packets: asked for where they cannot be, they are refused; statistics say what runs") {
  const scene box = test::one_mesh(generate("box", {{"size", 2}}));
  options narrow = in_packets();
  narrow.layout = tracer::layout_kind::narrow;
  CHECK_THROWS_AS(device_scene(test::queue(), box, narrow), runtime::exception);
  options without_tree = in_packets();
  without_tree.tree = tracer::tree_kind::none;
  CHECK_THROWS_AS(device_scene(test::queue(), box, without_tree), runtime::exception);
  CHECK(device_scene(test::queue(), box, in_packets()).prepared().rays_a_work_item == packet);
  options off = in_packets();
  off.packets = packet_kind::off;
  CHECK(device_scene(test::queue(), box, off).prepared().rays_a_work_item == 1);
}
