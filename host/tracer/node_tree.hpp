// A binary tree as traversal's nodes, from which any layout can be made.
#pragma once

#include <cstdint>

#include "runtime/runtime.hpp"
#include "tracer/layout.hpp"

namespace facet::tracer {

/// Over n > 0 primitives. A leaf (FACET_LEAF) is a run of places of `order`; the leaves hold each
/// place once. Nodes stand in any order.
struct node_tree {
  runtime::buffer<Node> nodes;           ///< node_count, or room for more
  runtime::buffer<std::uint32_t> order;  ///< n: the primitive at each place
  std::uint32_t node_count = 0;          ///< leaves, less 1
  std::uint32_t root = FACET_NONE;       ///< as a child
};

}  // namespace facet::tracer
