// Binary trees to fold, and a fold of them that is written by recursion: what the device must give.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "tracer/layout.hpp"
#include "tracer/random_helper.hpp"

namespace facet::test {

using tracer::Box;
using tracer::Node;
using tracer::WideNode;

/// tracer::node_tree in the host's memory; leaves hold places 0 to count - 1, from the left.
struct host_node_tree {
  std::vector<Node> nodes;
  std::uint32_t root = FACET_NONE, count = 0;
};

/// A shape: how many of `count` leaves, at least 2, go to the left.
using split = std::function<std::uint32_t(std::uint32_t count)>;

/// Boxes of leaves from `box`, those of nodes as small as may be. Leaves hold 1 to `most`
/// primitives, and nodes stand in any order, both at random.
host_node_tree made_tree(std::uint32_t leaves, std::uint32_t most, const split& s,
                         const std::function<Box()>& box, std::uint64_t seed);

struct host_fold {
  std::vector<WideNode> nodes;
  std::vector<std::uint32_t> leaves;  ///< as in the binary tree
  std::uint32_t root = FACET_NONE, depth = 0;
};

/// Nodes and leaves in depth-first order, named as if the first stood at first_node and first_leaf.
host_fold folded(const host_node_tree& from, std::uint32_t first_node, std::uint32_t first_leaf);

/// Half the area of the box of child `side` of `n`.
float half_area(const Node& n, std::size_t side);
/// Half the area of the box of both.
float half_area(const Node& n);

}  // namespace facet::test
