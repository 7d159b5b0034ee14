#include "tracer/cut_tree.hpp"

#include <doctest/doctest.h>

#include <bit>
#include <functional>

#include "tracer/device_helper.hpp"
#include "tracer/given_tree.hpp"
#include "tracer/kernels.hpp"
#include "tracer/random_helper.hpp"

using namespace facet;
using namespace facet::tracer;
using test::content;

namespace {

std::vector<texel> random_corners(std::uint32_t n) {
  test::random r(n);
  std::vector<texel> corners;
  for (std::uint32_t i = 0; i < n; ++i) {
    const vec3f p = r.in_cube();
    for (int k = 0; k < 3; ++k) {
      const vec3f q = p + vec3f{r.uniform(), r.uniform(), r.uniform()} * 0.1f;
      corners.push_back({q.x, q.y, q.z, 0});
    }
  }
  return corners;
}

/// Ranges are parted at random, down to single triangles.
given_tree random_tree(std::uint32_t n) {
  test::random r(n);
  given_tree t;
  t.nodes.push_back({0, n});
  for (std::uint32_t i = 0; i < n; ++i) t.order.push_back(i);
  for (std::size_t at = 0; at < t.nodes.size(); ++at) {
    const auto [first, count] = t.nodes[at];
    if (count == 1) continue;
    const std::uint32_t left = 1 + r.below(count - 1);
    t.nodes[at] = {std::uint32_t(t.nodes.size()), 0};
    t.nodes.push_back({first, left});
    t.nodes.push_back({first + left, count - left});
  }
  return t;
}

}  // namespace

TEST_CASE("cut: the same tree, but that subtrees that fit a leaf are one") {
  runtime::queue& q = test::queue();
  const tuning t = tuning_for(test::device());
  tree_cutter cutter(q, kernel_sources(), t);
  for (std::uint32_t n : {1u, 2u, 3u, 8u, 9u, 17u, 1000u, 5000u})
    for (std::uint32_t leaf_size : {1u, 8u}) {
      CAPTURE(n);
      CAPTURE(leaf_size);
      const host_binary_tree made = binary_of(random_tree(n), random_corners(n));
      const binary_tree binary{runtime::buffer<TreeNode>(made.nodes.data(), made.nodes.size()),
                               runtime::buffer<std::uint32_t>(made.order.data(), n), n, made.root,
                               made.depth};
      const node_tree cut = cutter.cut(binary, {leaf_size, leaf_size});
      CHECK(content(cut.order) == content(binary.order));
      const auto from = content(binary.nodes);
      const auto nodes = content(cut.nodes);
      std::uint32_t visited = 0, wrong = 0;
      const std::function<void(std::uint32_t, std::uint32_t)> same = [&](std::uint32_t child,
                                                                         std::uint32_t of) {
        const TreeNode& b = from[of];
        const std::uint32_t size = b.last - b.first + 1;
        if (size <= leaf_size) {
          wrong += child != FACET_LEAF(b.first, size);
          return;
        }
        REQUIRE(child < cut.node_count);
        REQUIRE(++visited <= cut.node_count);
        const Node& node = nodes[child];
        for (std::size_t c = 0; c < 2; ++c) {
          const std::uint32_t below = c == 0 ? b.left : b.right;
          const float lo[] = {node.x[0][c], node.y[0][c], node.z[0][c]};
          const float hi[] = {node.x[1][c], node.y[1][c], node.z[1][c]};
          for (std::size_t axis = 0; axis < 3; ++axis)
            wrong += lo[axis] != from[below].lo[axis] || hi[axis] != from[below].hi[axis];
          same(node.child[c], below);
        }
      };
      same(cut.root, binary.root);
      CHECK(visited == cut.node_count);
      CHECK(wrong == 0);
    }
}
