// The trees themselves after moves, whichever rays look at them.
#include "tracer/refit.hpp"

#include <doctest/doctest.h>

#include <array>
#include <utility>

#include "scene/world_bounds.hpp"
#include "tracer/moving_helper.hpp"
#include "tracer/plain_tree.hpp"

using namespace facet;
using namespace facet::tracer;

namespace {

/// How many boxes are not those of what is below them; `box_of` is that of a primitive.
template <class BoxOf>
std::size_t wrong_boxes(const plain_tree& t, const BoxOf& box_of) {
  std::vector<box3f> below(t.nodes.size());
  std::size_t wrong = 0;
  for (std::size_t k = t.nodes.size(); k-- > 0;) {
    const plain_tree::node& n = t.nodes[k];
    for (std::uint32_t c = n.first; c < n.first + n.count; ++c)
      below[k].add(n.is_leaf ? box_of(t.primitives[c]) : below[c]);
    if (k > 0 || !n.is_leaf) wrong += !(n.box == below[k]);
  }
  return wrong;
}

/// Of all trees of the scene, whose meshes are all shown. A triangle that is shut is one point.
std::size_t wrong_boxes(const device_scene& d, const scene& s) {
  const traced_trees trees = d.read_trees();
  REQUIRE(trees.meshes.size() == s.meshes.size());
  std::size_t wrong = 0;
  const packed_scene packed = pack(s, false);
  // In the wide layout meshes stand in the scene's order, too.
  for (std::size_t k = 0; k < s.meshes.size(); ++k)
    wrong += wrong_boxes(trees.meshes[k], [&](std::uint32_t triangle) {
      box3f b;
      for (std::size_t c = 0; c < 3; ++c) {
        const texel& p = packed.corners[3 * (packed.meshes[k].first_triangle + triangle) + c];
        b.add(vec3f(p[0], p[1], p[2]));
      }
      return b;
    });
  if (!trees.top.nodes.empty())
    wrong += wrong_boxes(trees.top, [&](std::uint32_t i) {
      const instance& placed = s.instances[i];
      return world_box<float>(placed, s.meshes[placed.mesh]);
    });
  return wrong;
}

bool has_tree(const test::way& w) { return w.options.tree != tree_kind::none; }

using shape = std::vector<std::array<std::uint32_t, 3>>;

/// Nodes and primitives without their boxes.
std::pair<shape, std::vector<std::uint32_t>> shape_of(const plain_tree& t) {
  shape s;
  for (const plain_tree::node& n : t.nodes) s.push_back({n.is_leaf, n.first, n.count});
  return {s, t.primitives};
}

}  // namespace

TEST_CASE("after each move each box is that of what lies below it, and the shape is as it was") {
  for (const test::way& w : test::ways_to_move()) {
    if (!has_tree(w)) continue;
    CAPTURE(w.name);
    for (const std::uint32_t triangles : {1u, 3u, 20u, 3000u}) {
      CAPTURE(triangles);
      scene s = test::one_mesh(test::random_soup(triangles, 4));
      device_scene moved(test::queue(), s, w.options);
      const auto built = shape_of(moved.read_trees().meshes[0]);
      const std::vector<vec3f> first = s.meshes[0].positions;
      for (const test::deformation& d : test::deformations()) {
        CAPTURE(d.name);
        s.meshes[0].positions = d.apply(first);
        moved.move_vertices(0, s.meshes[0].positions);
        CHECK(wrong_boxes(moved, s) == 0);
        CHECK(shape_of(moved.read_trees().meshes[0]) == built);
      }
    }
  }
}

TEST_CASE("trees that take several phases, and a caller's, are refitted as well") {
  // Both layouts have more nodes than a treelet on any device.
  for (const test::way& w : test::ways_to_move()) {
    if (!has_tree(w)) continue;
    CAPTURE(w.name);
    scene s = test::one_mesh(test::random_soup(60'000, 4));
    device_scene moved(test::queue(), s, w.options);
    test::random r(2);
    for (vec3f& p : s.meshes[0].positions) p = p + r.in_cube() * 0.3f;
    moved.move_vertices(0, s.meshes[0].positions);
    CHECK(wrong_boxes(moved, s) == 0);

    // As deep as it can be: each node has one triangle and the rest.
    constexpr std::uint32_t triangles = 60;
    given_tree chain{{{1, 0}}, {}};
    for (std::uint32_t t = 0; t < triangles; ++t) {
      chain.order.push_back((7 * t) % triangles);
      chain.nodes.push_back({t, 1});
      if (t + 2 < triangles) chain.nodes.push_back({std::uint32_t(chain.nodes.size() + 1), 0});
    }
    scene few = test::one_mesh(test::random_soup(triangles, 8));
    device_scene given(test::queue(), few, w.options, {&chain, 1});
    for (vec3f& p : few.meshes[0].positions) p = p * 2.0f - vec3f(1, 0, 0);
    given.move_vertices(0, few.meshes[0].positions);
    CHECK(wrong_boxes(given, few) == 0);
    CHECK(test::differing_hits(given, few, w.options, 3) == 0);
  }
}

TEST_CASE("a mesh's move leaves the others' trees, and a move of instances all meshes' trees") {
  for (const test::way& w : test::ways_to_move()) {
    if (!has_tree(w)) continue;
    CAPTURE(w.name);
    scene s = test::many_instances();
    device_scene moved(test::queue(), s, w.options);
    const auto boxes_of = [](const plain_tree& t) {
      std::vector<box3f> all;
      for (const plain_tree::node& n : t.nodes) all.push_back(n.box);
      return all;
    };
    const traced_trees before = moved.read_trees();
    for (vec3f& p : s.meshes[1].positions) p = p * 1.5f + vec3f(0.1f, 0, 0);
    moved.move_vertices(1, s.meshes[1].positions);
    CHECK(wrong_boxes(moved, s) == 0);
    CHECK(boxes_of(moved.read_trees().meshes[0]) == boxes_of(before.meshes[0]));
    CHECK(boxes_of(moved.read_trees().meshes[1]) != boxes_of(before.meshes[1]));

    const traced_trees between = moved.read_trees();
    test::random r(1);
    std::vector<transform> to;
    for (instance& i : s.instances) {
      i.world_from_object = transform::translate(vec3d(r.in_cube() * 5.0f)) * i.world_from_object;
      to.push_back(i.world_from_object);
    }
    moved.place(to);
    CHECK(wrong_boxes(moved, s) == 0);
    for (std::size_t k = 0; k < 2; ++k)
      CHECK(boxes_of(moved.read_trees().meshes[k]) == boxes_of(between.meshes[k]));
    CHECK(boxes_of(moved.read_trees().top) != boxes_of(between.top));
  }
}

TEST_CASE("boxes that are left as they were, or are too large, are counted") {
  scene s = test::one_mesh(test::random_soup(500, 4));
  options o;
  o.movable = true;
  for (const layout_kind layout : {layout_kind::narrow, layout_kind::wide}) {
    o.layout = layout;
    o.edits = {
        {"refit.cl", "k = starts[first_treelet + i];", "k = starts[first_treelet + i] + 1u;"}};
    device_scene skipping(test::queue(), s, o);
    o.edits = {{"refit.cl", "n->y[1][c] = b.hi.y;", "n->y[1][c] = larger(b.hi.y, n->y[1][c]);"}};
    device_scene growing(test::queue(), s, o);
    scene now = s;
    for (vec3f& p : now.meshes[0].positions) p = p * 0.5f;
    skipping.move_vertices(0, now.meshes[0].positions);
    growing.move_vertices(0, now.meshes[0].positions);
    CHECK(wrong_boxes(skipping, now) > 0);
    CHECK(wrong_boxes(growing, now) > 0);
  }
}
