#include "tracer/tree_builder.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

#include "tracer/device_helper.hpp"
#include "tracer/kernels.hpp"
#include "tracer/random_helper.hpp"
#include "tracer/tree_walk_helper.hpp"

using namespace facet;
using namespace facet::tracer;
using test::content;

namespace {

std::vector<tuning> faces() {
  tuning serial = tuning_for(test::device()), groups = serial;
  serial.serial_trees = true;
  groups.serial_trees = false;
  return {serial, groups};
}

template <class Primitive>
tree_builder<Primitive>& builder_of(std::size_t face, leaf_rule leaves) {
  static std::vector<
      std::pair<std::vector<std::uint32_t>, std::unique_ptr<tree_builder<Primitive>>>>
      all;
  const std::vector<std::uint32_t> key{std::uint32_t(face), leaves.sure, leaves.most};
  for (auto& [k, b] : all)
    if (k == key) return *b;
  all.emplace_back(key, std::make_unique<tree_builder<Primitive>>(test::queue(), kernel_sources(),
                                                                  faces()[face], leaves));
  return *all.back().second;
}

/// A tree without its indices: nodes from the root down, the left side first.
struct plain_tree {
  std::vector<float> boxes;
  std::vector<std::uint32_t> leaves;  ///< of each its size and primitives; 0 for a node
  friend bool operator==(const plain_tree&, const plain_tree&) = default;
};

template <class Primitive>
plain_tree checked(std::size_t face, const std::vector<Primitive>& primitives, std::uint32_t n,
                   leaf_rule rule, const std::function<Box(std::uint32_t)>& box_of) {
  runtime::buffer<Primitive> in(primitives.data(), primitives.size());
  node_tree t;
  builder_of<Primitive>(face, rule).build(in, n, t);
  const auto nodes = content(t.nodes);
  const auto order = content(t.order);
  REQUIRE(t.node_count <= nodes.size());
  REQUIRE(order.size() >= n);
  plain_tree plain;
  std::vector<int> met(n, 0);
  std::uint32_t escaped = 0, too_large = 0, backwards = 0, deepest = 0, walked = 0;
  const std::function<Box(std::uint32_t, std::uint32_t)> down = [&](std::uint32_t child,
                                                                    std::uint32_t depth) -> Box {
    Box all{{INFINITY, INFINITY, INFINITY}, 0, {-INFINITY, -INFINITY, -INFINITY}, 0};
    const auto join = [&](const Box& b) {
      for (int c = 0; c < 3; ++c) {
        all.lo[c] = std::min(all.lo[c], b.lo[c]);
        all.hi[c] = std::max(all.hi[c], b.hi[c]);
      }
    };
    deepest = std::max(deepest, depth);
    if (child & FACET_LEAF_BIT) {
      const std::uint32_t first = FACET_LEAF_FIRST(child), count = FACET_LEAF_COUNT(child);
      too_large += count > rule.most;
      plain.leaves.push_back(count);
      for (std::uint32_t k = first; k < first + count; ++k) {
        REQUIRE(k < n);
        ++met[order[k]];
        plain.leaves.push_back(order[k]);
        join(box_of(order[k]));
      }
      return all;
    }
    REQUIRE(child < t.node_count);
    REQUIRE(++walked <= t.node_count);
    plain.leaves.push_back(0);
    for (std::size_t side = 0; side < 2; ++side) {
      const Node& node = nodes[child];
      for (const auto* axis : {&node.x, &node.y, &node.z})
        for (std::size_t end = 0; end < 2; ++end) plain.boxes.push_back((*axis)[end][side] + 0.0f);
      backwards += !(node.child[side] & FACET_LEAF_BIT) && node.child[side] <= child;
      const Box below = down(node.child[side], depth + 1);
      escaped += node.x[0][side] != below.lo[0] || node.y[0][side] != below.lo[1] ||
                 node.z[0][side] != below.lo[2] || node.x[1][side] != below.hi[0] ||
                 node.y[1][side] != below.hi[1] || node.z[1][side] != below.hi[2];
      join(below);
    }
    return all;
  };
  down(t.root, 0);
  CHECK(escaped == 0);
  CHECK(too_large == 0);
  CHECK(backwards == 0);
  CHECK(walked == t.node_count);
  CHECK(deepest == t.depth);
  CHECK(std::count(met.begin(), met.end(), 1) == n);
  return plain;
}

Box box_of(const std::vector<texel>& corners, std::uint32_t i) {
  Box b{};
  for (std::size_t c = 0; c < 3; ++c) {
    const texel* p = &corners[3 * std::size_t(i)];
    b.lo[c] = std::min({p[0][c], p[1][c], p[2][c]});
    b.hi[c] = std::max({p[0][c], p[1][c], p[2][c]});
  }
  return b;
}

/// Both faces' trees are sound and the same.
void check(const std::vector<texel>& corners, leaf_rule rule) {
  const auto n = std::uint32_t(corners.size() / 3);
  CAPTURE(n);
  CAPTURE(rule.most);
  const auto at = [&](std::uint32_t i) { return box_of(corners, i); };
  const plain_tree serial = checked<texel>(0, corners, n, rule, at);
  CHECK((checked<texel>(1, corners, n, rule, at) == serial));
}

std::vector<texel> soup(std::uint32_t n, float size) {
  test::random r(n);
  std::vector<texel> corners;
  for (std::uint32_t i = 0; i < n; ++i) {
    const texel p{r.uniform(), 3 * r.uniform(), r.uniform(), 0};
    for (int k = 0; k < 3; ++k)
      corners.push_back(
          {p[0] + size * r.uniform(), p[1] + size * r.uniform(), p[2] + size * r.uniform(), 0});
  }
  return corners;
}

}  // namespace

TEST_CASE("binned trees are sound, and the same from work-items and from groups, in any size") {
  for (const leaf_rule rule : {leaf_rule{2, 4}, block_leaves, leaf_rule{1, 1}}) {
    for (std::uint32_t n = 1; n <= 70; ++n) check(soup(n, 0.1f), rule);
    for (const std::uint32_t n : {255u, 256u, 1000u, 5000u, 33000u}) check(soup(n, 0.02f), rule);
  }
}

TEST_CASE("a level's ranges of several tiles have the same splits") {
  check(soup(150'000, 0.01f), {2, 4});
}

TEST_CASE(
    "degenerate primitives have sound trees: equal, flat, in a row, huge, spaced ever wider") {
  const leaf_rule rule{2, 4};
  for (const std::uint32_t n : {2u, 33u, 1500u}) {
    check(std::vector<texel>(3 * std::size_t(n), texel{1, 2, 3, 0}), rule);
    std::vector<texel> flat = soup(n, 0.1f), row = flat, huge = flat, wider = flat;
    for (std::size_t i = 0; i < flat.size(); ++i) {
      flat[i][1] = 7;
      row[i][1] = row[i][2] = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        huge[i][c] = (huge[i][c] - 0.5f) * 3e38f;
        wider[i][c] = std::ldexp(wider[i][c], int(i / 3) % 120);
      }
    }
    check(flat, rule), check(row, rule), check(huge, rule), check(wider, rule);
  }
}

TEST_CASE("trees over boxes have a box to a leaf") {
  test::random r(5);
  for (const std::uint32_t n : {1u, 2u, 31u, 32u, 33u, 2000u}) {
    std::vector<Box> boxes;
    for (std::uint32_t i = 0; i < n; ++i) {
      const float x = r.uniform(), y = r.uniform(), z = r.uniform();
      boxes.push_back({{x, y, z}, 0, {x + 0.1f, y + 0.2f, z}, 0});
    }
    const auto at = [&](std::uint32_t i) { return boxes[i]; };
    const plain_tree serial = checked<Box>(0, boxes, n, {1, 1}, at);
    CHECK((checked<Box>(1, boxes, n, {1, 1}, at) == serial));
  }
}
