#include "tracer/levels.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <vector>

#include "tracer/device_helper.hpp"
#include "tracer/kernels.hpp"
#include "tracer/random_helper.hpp"

using namespace facet;
using namespace facet::tracer;

namespace {

levels_builder& builder() {
  static levels_builder b(test::queue(), kernel_sources(), tuning_for(test::device()));
  return b;
}

Box box_at(vec3f lo, vec3f size) {
  return {{lo.x, lo.y, lo.z}, 0, {lo.x + size.x, lo.y + size.y, lo.z + size.z}, 0};
}

std::vector<Box> random_boxes(std::uint32_t n) {
  test::random r(n);
  std::vector<Box> boxes;
  for (std::uint32_t i = 0; i < n; ++i) {
    const vec3f lo = r.in_cube();
    boxes.push_back(box_at(lo, {r.uniform() * 0.01f, r.uniform() * 0.01f, r.uniform() * 0.01f}));
  }
  return boxes;
}

struct host_tree {
  std::vector<TreeNode> nodes;
  std::vector<std::uint32_t> order;
  std::uint32_t root, depth;
};

host_tree build(const std::vector<Box>& boxes) {
  runtime::buffer<Box> b(boxes.data(), boxes.size());
  binary_tree t = builder().build(b, std::uint32_t(boxes.size()));
  const runtime::host_accessor nodes{t.nodes, runtime::read_only};
  const runtime::host_accessor order{t.order, runtime::read_only};
  host_tree h{{}, {}, t.root, t.depth};
  for (std::size_t i = 0; i < t.nodes.size(); ++i) h.nodes.push_back(nodes[i]);
  for (std::size_t i = 0; i < t.order.size(); ++i) h.order.push_back(order[i]);
  return h;
}

/// Walks down from the root and counts what breaks the promises of a tree.
void check_tree(const std::vector<Box>& boxes, const host_tree& t) {
  const auto n = std::uint32_t(boxes.size());
  CHECK(t.nodes.size() == 2 * std::size_t(n) - 1);
  std::vector<std::uint32_t> leaves(n, 0);
  std::size_t visited = 0, loose = 0, torn = 0, wrong_leaf = 0;
  struct entry {
    std::uint32_t node, depth;
  };
  std::vector<entry> stack{{t.root, 0}};
  std::uint32_t deepest = 0;
  while (!stack.empty()) {
    const auto [k, depth] = stack.back();
    stack.pop_back();
    ++visited;
    REQUIRE(visited <= t.nodes.size());
    deepest = std::max(deepest, depth);
    const TreeNode& node = t.nodes[k];
    if (node.right == FACET_NONE) {
      ++leaves[node.left];
      const Box& b = boxes[node.left];
      wrong_leaf += node.left != t.order[node.first] || node.first != node.last;
      loose += !std::equal(b.lo, b.lo + 3, node.lo) || !std::equal(b.hi, b.hi + 3, node.hi);
      continue;
    }
    const TreeNode &l = t.nodes[node.left], &r = t.nodes[node.right];
    torn += l.first != node.first || l.last + 1 != r.first || r.last != node.last;
    for (int c = 0; c < 3; ++c)
      loose += node.lo[c] != std::min(l.lo[c], r.lo[c]) || node.hi[c] != std::max(l.hi[c], r.hi[c]);
    stack.push_back({node.left, depth + 1});
    stack.push_back({node.right, depth + 1});
  }
  CHECK(visited == t.nodes.size());
  CHECK(std::count(leaves.begin(), leaves.end(), 1u) == std::ptrdiff_t(n));
  CHECK(loose == 0);
  CHECK(torn == 0);
  CHECK(wrong_leaf == 0);
  CHECK(deepest == t.depth);
  CHECK(t.depth <= 63 + std::uint32_t(std::bit_width(n - 1)));
}

}  // namespace

TEST_CASE("2n-1 nodes, each primitive in one leaf, every box exactly its children's") {
  for (std::uint32_t n : {1u, 2u, 3u, 4u, 5u, 64u, 65u, 1000u}) {
    CAPTURE(n);
    const auto boxes = random_boxes(n);
    check_tree(boxes, build(boxes));
  }
}

TEST_CASE("a million and three primitives") {
  const auto boxes = random_boxes(1'000'003);
  check_tree(boxes, build(boxes));
}

TEST_CASE("equal codes are split by position: depth ceil(log2 n)") {
  for (std::uint32_t n : {2u, 3u, 5u, 4096u, 100'000u}) {
    CAPTURE(n);
    const std::vector<Box> boxes(n, box_at({1, 2, 3}, {0, 0, 0}));
    const host_tree t = build(boxes);
    check_tree(boxes, t);
    CHECK(t.depth == std::uint32_t(std::bit_width(n - 1)));
  }
}

TEST_CASE("centres in a geometric series stay within the bound on depth") {
  std::vector<Box> boxes;
  for (int i = 0; i < 60; ++i) boxes.push_back(box_at({std::ldexp(1.0f, -i), 0, 0}, {0, 0, 0}));
  check_tree(boxes, build(boxes));
}

TEST_CASE("the same boxes give the same tree") {
  const auto boxes = random_boxes(20'000);
  const host_tree a = build(boxes), b = build(boxes);
  CHECK(a.order == b.order);
  CHECK(a.root == b.root);
  const auto same = [](const TreeNode& x, const TreeNode& y) {
    return x.left == y.left && x.right == y.right && x.first == y.first && x.last == y.last;
  };
  CHECK(std::equal(a.nodes.begin(), a.nodes.end(), b.nodes.begin(), same));
}
