// A way down to every leaf of the nodes of either layout.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <iterator>
#include <utility>
#include <vector>

#include "scene/vec.hpp"
#include "tracer/layout.hpp"

namespace facet::test {

/// The nodes and children that led somewhere.
using tree_way = std::vector<std::pair<std::uint32_t, std::size_t>>;

template <class Node>
struct tree_walk {
  const std::vector<Node>& nodes;
  std::function<void(std::uint32_t leaf, const tree_way& way)> at_leaf;
  std::uint32_t deepest = 0, visited = 0;

  void down(std::uint32_t child, const tree_way& way = {}) {
    REQUIRE(++visited < 1'000'000);
    deepest = std::max(deepest, std::uint32_t(way.size()));
    if (child & FACET_LEAF_BIT) return at_leaf(child, way);
    for (std::size_t c = 0; c < std::size(Node{}.child); ++c) {
      if (nodes[child].child[c] == FACET_NONE) {
        CHECK(nodes[child].x[0][c] > nodes[child].x[1][c]);
        continue;
      }
      tree_way further = way;
      further.emplace_back(child, c);
      down(nodes[child].child[c], further);
    }
  }

  /// How many boxes on the way do not hold p.
  std::uint32_t escaped(vec3f p, const tree_way& way) const {
    return std::uint32_t(std::count_if(way.begin(), way.end(), [&](const auto& at) {
      const auto& [node, c] = at;
      const Node& n = nodes[node];
      return !(n.x[0][c] <= p.x && p.x <= n.x[1][c] && n.y[0][c] <= p.y && p.y <= n.y[1][c] &&
               n.z[0][c] <= p.z && p.z <= n.z[1][c]);
    }));
  }
};

}  // namespace facet::test
