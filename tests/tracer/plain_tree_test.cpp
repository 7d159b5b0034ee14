// What is read back of trees is what was built, in every layout.
#include "tracer/plain_tree.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "tracer/device_helper.hpp"
#include "tracer/scenes_helper.hpp"

using namespace facet;
using namespace facet::tracer;

namespace {

constexpr layout_kind layouts[] = {layout_kind::narrow, layout_kind::wide};

traced_trees read(const scene& s, layout_kind layout, std::span<const given_tree> given = {}) {
  options o;
  o.layout = layout;
  return device_scene(test::queue(), s, o, given).read_trees();
}

bool holds(const box3f& outer, const box3f& inner) {
  return min(outer.lo, inner.lo) == outer.lo && max(outer.hi, inner.hi) == outer.hi;
}

/// Each of `count` primitives, whose boxes are given, is in one leaf; each node is met once, behind
/// its parent, and holds what is below it.
void check_tree(const plain_tree& t, const std::vector<box3f>& boxes) {
  std::vector<int> leaves(boxes.size(), 0), parents(t.nodes.size(), 0);
  std::size_t held = 0, loose = 0;
  REQUIRE(!t.nodes.empty());
  for (std::size_t i = 0; i < t.nodes.size(); ++i) {
    const auto& n = t.nodes[i];
    REQUIRE(n.count > 0);
    REQUIRE(n.first + n.count <= (n.is_leaf ? t.primitives.size() : t.nodes.size()));
    for (std::uint32_t k = n.first; k < n.first + n.count; ++k) {
      if (!n.is_leaf) {
        REQUIRE(k > i);
        ++parents[k];
      } else {
        REQUIRE(t.primitives[k] < boxes.size());
        ++leaves[t.primitives[k]];
        ++held;
      }
      const box3f& inner = n.is_leaf ? boxes[t.primitives[k]] : t.nodes[k].box;
      if (i > 0 || !n.is_leaf) loose += !holds(n.box, inner);
    }
  }
  CHECK(held == boxes.size());
  CHECK(std::count(leaves.begin(), leaves.end(), 1) == std::ptrdiff_t(boxes.size()));
  CHECK(std::count(parents.begin() + 1, parents.end(), 1) == std::ptrdiff_t(t.nodes.size()) - 1);
  CHECK(parents[0] == 0);
  CHECK(loose == 0);
}

std::vector<box3f> boxes_of(const std::vector<texel>& corners) {
  std::vector<box3f> boxes(corners.size() / 3);
  for (std::size_t i = 0; i < corners.size(); ++i)
    boxes[i / 3].add(vec3f{corners[i][0], corners[i][1], corners[i][2]});
  return boxes;
}

}  // namespace

TEST_CASE("as traced: each triangle is in one leaf, and every node holds what is below it") {
  for (const layout_kind layout : layouts)
    for (const std::uint32_t n : {1u, 2u, 8u, 9u, 17u, 1000u}) {
      CAPTURE(n);
      const scene s = test::one_mesh(test::random_soup(n, n));
      const traced_trees t = read(s, layout);
      REQUIRE(t.meshes.size() == 1);
      CHECK(t.top.nodes.empty());
      check_tree(t.meshes[0], boxes_of(test::corners_of(s.meshes[0])));
    }
}

TEST_CASE("as traced: bytes are those of the nodes and slots that can be reached") {
  const scene s = test::one_mesh(test::random_soup(1000, 4));
  for (const layout_kind layout : layouts) {
    const plain_tree t = read(s, layout).meshes[0];
    const auto leaves =
        std::count_if(t.nodes.begin(), t.nodes.end(), [](const auto& n) { return n.is_leaf; });
    const auto inner = std::ptrdiff_t(t.nodes.size()) - leaves;
    // 64 bytes a node, and 48 of corners and 8 of info a triangle; or 256 a node and 8 * (48 +
    // 8) a block; the soup has no normals.
    const std::ptrdiff_t bytes =
        layout == layout_kind::narrow ? 64 * inner + 56 * 1000 : 256 * inner + 8 * 56 * leaves;
    CHECK(std::ptrdiff_t(t.bytes) == bytes);
  }
}

TEST_CASE("as traced: several meshes in the scene's order, and the tree over instances") {
  scene s = test::many_instances();
  s.meshes.insert(s.meshes.begin(), test::random_soup(5, 1));  // shown by none
  for (instance& i : s.instances) ++i.mesh;
  for (const layout_kind layout : layouts) {
    const traced_trees t = read(s, layout);
    REQUIRE(t.meshes.size() == 2);
    for (std::size_t k = 0; k < 2; ++k)
      check_tree(t.meshes[k], boxes_of(test::corners_of(s.meshes[k + 1])));
    const packed_scene packed = pack(s, false);
    std::vector<box3f> boxes(s.instances.size());
    for (const Instance& i : packed.instances)
      boxes[i.id] = {{i.lo[0], i.lo[1], i.lo[2]}, {i.hi[0], i.hi[1], i.hi[2]}};
    check_tree(t.top, boxes);
  }
}

TEST_CASE("as built: a binary tree with one triangle a leaf, the device's and a caller's") {
  const mesh m = test::random_soup(300, 2);
  const auto corners = test::corners_of(m);
  const given_tree given{{{1, 0}, {0, 100}, {3, 0}, {100, 150}, {250, 50}}, [] {
                           std::vector<std::uint32_t> order(300);
                           for (std::uint32_t i = 0; i < 300; ++i) order[i] = 299 - i;
                           return order;
                         }()};
  for (const plain_tree& t :
       {built_tree(test::queue(), tree_kind::levels, corners), built_tree(given, corners)}) {
    CHECK(t.nodes.size() == 599);
    for (const auto& n : t.nodes) CHECK(n.count == (n.is_leaf ? 1 : 2));
    check_tree(t, boxes_of(corners));
  }
  CHECK(built_tree(given, corners).primitives == given.order);
}

TEST_CASE("as traced: a given tree's shape is found again") {
  // Two far halves of four triangles: the narrow layout keeps each as a leaf.
  mesh m = test::random_soup(8, 3);
  for (std::size_t i = 12; i < 24; ++i) m.positions[i] = m.positions[i] + vec3f{100, 0, 0};
  const std::vector<given_tree> given{{{{1, 0}, {0, 4}, {4, 4}}, {4, 5, 6, 7, 0, 1, 2, 3}}};
  const plain_tree t = read(test::one_mesh(m), layout_kind::narrow, given).meshes[0];
  for (const auto& n : t.nodes)
    if (n.is_leaf)
      for (std::uint32_t k = 1; k < n.count; ++k)
        CHECK(t.primitives[n.first + k] / 4 == t.primitives[n.first] / 4);
  box3f left;
  for (std::uint32_t i = 0; i < 12; ++i) left.add(m.positions[i]);
  CHECK(holds(t.nodes[0].box, left));
}

TEST_CASE("without trees there is nothing to be read") {
  options o;
  o.tree = tree_kind::none;
  const device_scene d(test::queue(), test::one_mesh(test::random_soup(5, 3)), o);
  CHECK_THROWS_AS(d.read_trees(), runtime::exception);
  CHECK_THROWS_AS(built_tree(test::queue(), tree_kind::none, {}), runtime::exception);
}
