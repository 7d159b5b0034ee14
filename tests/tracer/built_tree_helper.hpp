// Trees as the builders make them, checked.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "tracer/device_helper.hpp"
#include "tracer/kernels.hpp"
#include "tracer/random_helper.hpp"
#include "tracer/tree_builder.hpp"

namespace facet::test {

using namespace tracer;

/// By single work-items, and by groups.
inline std::vector<tuning> faces() {
  tuning serial = tuning_for(device()), groups = serial;
  serial.build_alone();
  groups.build_in_groups();
  return {serial, groups};
}

template <class Primitive>
tree_builder<Primitive>& builder_of(std::size_t face, tree_kind kind, leaf_rule leaves) {
  static std::vector<
      std::pair<std::vector<std::uint32_t>, std::unique_ptr<tree_builder<Primitive>>>>
      all;
  const std::vector<std::uint32_t> key{std::uint32_t(face), std::uint32_t(kind), leaves.sure,
                                       leaves.most};
  for (auto& [k, b] : all)
    if (k == key) return *b;
  all.emplace_back(key, std::make_unique<tree_builder<Primitive>>(queue(), kernel_sources(),
                                                                  faces()[face], kind, leaves));
  return *all.back().second;
}

/// A tree without its nodes' indices: nodes from the root down, the left side first.
struct shape {
  std::vector<float> boxes;
  std::vector<std::uint32_t> leaves;  ///< of each its size and primitives; 0 for a node
  friend bool operator==(const shape&, const shape&) = default;
};

/// Builds a tree by faces()[face], and checks that it is sound: each primitive in one leaf, every
/// box exactly that of what is below it, its depth and count of nodes as told.
template <class Primitive>
shape checked(std::size_t face, tree_kind kind, const std::vector<Primitive>& primitives,
              std::uint32_t n, leaf_rule rule, const std::function<Box(std::uint32_t)>& box_of) {
  runtime::buffer<Primitive> in(primitives.data(), primitives.size());
  node_tree t;
  builder_of<Primitive>(face, kind, rule).build(in, n, t);
  const auto nodes = content(t.nodes);
  const auto order = content(t.order);
  REQUIRE(t.node_count <= nodes.size());
  REQUIRE(order.size() >= n);
  shape found;
  std::vector<int> met(n, 0);
  std::uint32_t escaped = 0, too_large = 0, deepest = 0, walked = 0;
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
      found.leaves.push_back(count);
      for (std::uint32_t k = first; k < first + count; ++k) {
        REQUIRE(k < n);
        ++met[order[k]];
        found.leaves.push_back(order[k]);
        join(box_of(order[k]));
      }
      return all;
    }
    REQUIRE(child < t.node_count);
    REQUIRE(++walked <= t.node_count);
    found.leaves.push_back(0);
    for (std::size_t side = 0; side < 2; ++side) {
      const Node& node = nodes[child];
      for (const auto* axis : {&node.x, &node.y, &node.z})
        for (std::size_t end = 0; end < 2; ++end) found.boxes.push_back((*axis)[end][side] + 0.0f);
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
  CHECK(walked == t.node_count);
  CHECK(deepest == t.depth);
  CHECK(std::count(met.begin(), met.end(), 1) == n);
  return found;
}

inline Box box_of(const std::vector<texel>& corners, std::uint32_t i) {
  Box b{};
  for (std::size_t c = 0; c < 3; ++c) {
    const texel* p = &corners[3 * std::size_t(i)];
    b.lo[c] = std::min({p[0][c], p[1][c], p[2][c]});
    b.hi[c] = std::max({p[0][c], p[1][c], p[2][c]});
  }
  return b;
}

inline std::vector<texel> soup(std::uint32_t n, float size) {
  random r(n);
  std::vector<texel> corners;
  for (std::uint32_t i = 0; i < n; ++i) {
    const texel p{r.uniform(), 3 * r.uniform(), r.uniform(), 0};
    for (int k = 0; k < 3; ++k)
      corners.push_back(
          {p[0] + size * r.uniform(), p[1] + size * r.uniform(), p[2] + size * r.uniform(), 0});
  }
  return corners;
}

}  // namespace facet::test
