#include "tracer/given_tree.hpp"

#include <doctest/doctest.h>

#include <cstring>

#include "reference/sah.hpp"
#include "tracer/device_helper.hpp"
#include "tracer/scenes_helper.hpp"

using namespace facet;
using namespace facet::tracer;

namespace {

given_tree sah_tree_of(const mesh& m, unsigned leaf_size) {
  std::vector<box3f> boxes(m.triangle_count());
  for (std::size_t t = 0; t < boxes.size(); ++t)
    for (int k = 0; k < 3; ++k) boxes[t].add(m.position(std::uint32_t(t), k));
  const reference::sah_tree tree = reference::build_sah(boxes, leaf_size);
  given_tree given;
  for (const reference::sah_node& n : tree.nodes) given.nodes.push_back({n.first, n.count});
  given.order = tree.order;
  return given;
}

bool same_bits(const hit& a, const hit& b) { return std::memcmp(&a, &b, sizeof(hit)) == 0; }

}  // namespace

TEST_CASE("hits do not depend on whose tree leads to them, in either layout") {
  const scene s = test::one_mesh(test::random_soup(3000, 5));
  const auto rays = test::random_rays(4000, 6);
  const auto expected = device_scene(test::queue(), s).trace(rays);
  for (const unsigned leaf_size : {1u, 4u, 8u})
    for (const layout_kind layout : {layout_kind::narrow, layout_kind::wide}) {
      options o;
      o.layout = layout;
      const std::vector<given_tree> given{sah_tree_of(s.meshes[0], leaf_size)};
      const auto hits = device_scene(test::queue(), s, o, given).trace(rays);
      std::size_t differing = 0;
      for (std::size_t i = 0; i < rays.size(); ++i) differing += !same_bits(hits[i], expected[i]);
      CHECK(differing == 0);
    }
}

TEST_CASE("a given tree becomes a builder's: nodes by position, exact boxes, heights") {
  const mesh m = test::random_soup(100, 2);
  const auto corners = test::corners_of(m);
  const given_tree given = sah_tree_of(m, 7);
  const host_binary_tree t = binary_of(given, corners);
  CHECK(t.order == given.order);
  REQUIRE(t.nodes.size() == 199);
  CHECK(t.nodes[t.root].first == 0);
  CHECK(t.nodes[t.root].last == 99);
  CHECK(t.nodes[t.root].height == t.depth);
  for (std::uint32_t i = 0; i < 100; ++i) CHECK(t.nodes[i].left == given.order[i]);
  for (std::uint32_t i = 100; i < 199; ++i) {
    const TreeNode &n = t.nodes[i], &l = t.nodes[n.left], &r = t.nodes[n.right];
    CHECK(l.last == i - 100);
    CHECK(r.first == l.last + 1);
    CHECK(n.height == 1 + std::max(l.height, r.height));
    for (int axis = 0; axis < 3; ++axis) {
      CHECK(n.lo[axis] == std::min(l.lo[axis], r.lo[axis]));
      CHECK(n.hi[axis] == std::max(l.hi[axis], r.hi[axis]));
    }
  }
}

TEST_CASE("what is not a tree over the mesh is refused") {
  const mesh m = test::random_soup(4, 2);
  const auto corners = test::corners_of(m);
  const given_tree right{{{1, 0}, {0, 2}, {2, 2}}, {3, 1, 0, 2}};
  CHECK(binary_of(right, corners).depth == 2);
  const auto refused = [&](given_tree t) {
    CHECK_THROWS_AS(binary_of(t, corners), runtime::exception);
  };
  given_tree t = right;
  refused({});
  t.order = {3, 1, 0, 0}, refused(t);
  t.order = {3, 1, 0, 4}, refused(t);
  t.order = {3, 1, 0}, refused(t);
  t = right, t.nodes[0].first = 0, refused(t);  // its own child
  t = right, t.nodes[0].first = 2, refused(t);
  t = right, t.nodes[1].count = 1, refused(t);
  t = right, t.nodes[2].count = 3, refused(t);
  t = right, t.nodes[2].first = 1, refused(t);
}
