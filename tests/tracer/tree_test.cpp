#include "tracer/tree.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "tracer/device_helper.hpp"
#include "tracer/kernels.hpp"
#include "tracer/scenes_helper.hpp"
#include "tracer/tracer.hpp"
#include "tracer/tree_walk_helper.hpp"

using namespace facet;
using namespace facet::tracer;
using test::content;

namespace {

device_geometry geometry_of(const scene& s, tree_kind kind, bool in_images, const tuning& t) {
  const features f = features::of(s);
  return build_geometry(test::queue(), kernel_sources(), pack(s, f.smooth), f, kind, in_images, t);
}

device_geometry geometry_of(const scene& s, tree_kind kind, bool in_images = false) {
  return geometry_of(s, kind, in_images, tuning_for(test::device()));
}

}  // namespace

TEST_CASE("each triangle is in one leaf, every node holds what is below it, the stack suffices") {
  for (std::uint32_t n : {1u, 2u, 4u, 5u, 6u, 17u, 1000u}) {
    CAPTURE(n);
    const scene s = test::one_mesh(test::random_soup(n, n));
    const device_geometry g = geometry_of(s, tree_kind::levels);
    const auto nodes = content(g.nodes);
    const auto corners = content(g.corners);
    std::multiset<std::uint32_t> slots;
    std::uint32_t escaped = 0, leaves = 0;
    test::tree_walk<Node> w{nodes, {}};
    w.at_leaf = [&](std::uint32_t leaf, const test::tree_way& way) {
      ++leaves;
      for (std::uint32_t k = 0; k < FACET_LEAF_COUNT(leaf); ++k) {
        const std::uint32_t slot = FACET_LEAF_FIRST(leaf) + k;
        slots.insert(slot);
        for (std::size_t c = 0; c < 3; ++c) {
          const texel& p = corners[3 * slot + c];
          escaped += w.escaped({p[0], p[1], p[2]}, way);
        }
      }
    };
    w.down(content(g.world)[0].root);
    CHECK(escaped == 0);
    CHECK(slots.size() == n);
    CHECK(std::set<std::uint32_t>(slots.begin(), slots.end()).size() == n);
    CHECK(w.deepest <= g.depth);
    CHECK(g.stack >= w.deepest);
    CHECK(g.nodes_used == w.visited - leaves);
  }
}

TEST_CASE("triangles in leaf order are those of the mesh, each once, with its material") {
  scene s = test::one_mesh(test::random_soup(777, 3));
  s.materials.resize(5);
  for (std::uint32_t t = 0; t < 777; ++t) s.meshes[0].materials.push_back(t % 5);
  for (const tree_kind kind : {tree_kind::levels, tree_kind::binned, tree_kind::none})
    for (const bool is_serial : {false, true}) {
      CAPTURE(word_of(kind));
      CAPTURE(is_serial);
      tuning t = tuning_for(test::device());
      is_serial ? t.build_alone() : t.build_in_groups();
      const device_geometry g = geometry_of(s, kind, false, t);
      const auto corners = content(g.corners);
      const auto infos = content(g.infos);
      std::set<std::uint32_t> seen;
      std::size_t wrong = 0;
      for (std::uint32_t slot = 0; slot < 777; ++slot) {
        const std::uint32_t triangle = infos[slot].triangle;
        seen.insert(triangle);
        wrong += infos[slot].material != triangle % 5;
        for (int k = 0; k < 3; ++k) {
          const vec3f p = s.meshes[0].position(triangle, k);
          wrong += corners[3 * slot + std::uint32_t(k)] != texel{p.x, p.y, p.z, 0};
        }
      }
      CHECK(seen.size() == 777);
      CHECK(wrong == 0);
    }
}

TEST_CASE("without a tree the order is the mesh's own") {
  const device_geometry g = geometry_of(test::one_mesh(test::random_soup(20, 3)), tree_kind::none);
  const auto infos = content(g.infos);
  for (std::uint32_t t = 0; t < 20; ++t) CHECK(infos[t].triangle == t);
  CHECK(g.nodes_used == 0);
}

TEST_CASE("several meshes and instances share the node array, the top's leaves name instances") {
  const scene s = test::many_instances();
  const device_geometry g = geometry_of(s, tree_kind::levels);
  const auto instances = content(g.instances);
  std::set<std::uint32_t> ids, roots;
  for (const Instance& i : instances) ids.insert(i.id), roots.insert(i.root);
  CHECK(ids.size() == s.instances.size());
  CHECK(roots.size() == 2);
  CHECK(g.nodes_used == g.nodes.size());
}

TEST_CASE("images hold the geometry in their own memory") {
  const scene s = test::one_mesh(test::random_soup(5000, 3));
  const device_geometry g = geometry_of(s, tree_kind::levels, true);
  REQUIRE(g.corner_image.has_value());
  CHECK(g.corner_image->width() == 8192);
  CHECK(g.corner_image->height() == 2);
  CHECK(g.corners.size() == 1);
}

TEST_CASE(
    "100 bytes a triangle suffice for the narrow layout, and 200 while its tree is built, as "
    "measured") {
  const scene s = test::one_mesh(generate("terrain", {{"n", 300}}));
  options o;
  o.layout = layout_kind::narrow;
  const statistics made = device_scene(test::queue(), s, o).prepared();
  const double triangles = double(s.triangle_count());
  CAPTURE(double(made.device_bytes) / triangles);
  CAPTURE(double(made.peak_bytes) / triangles);
  CHECK(double(made.device_bytes) < 100 * triangles);
  CHECK(made.peak_bytes >= made.device_bytes);
  CHECK(double(made.peak_bytes) < 200 * triangles);
}
