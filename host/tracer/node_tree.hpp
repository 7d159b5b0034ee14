// A binary tree as traversal's nodes, from which any layout can be made.
#pragma once

#include <cstdint>

#include "runtime/runtime.hpp"
#include "tracer/layout.hpp"

namespace facet::tracer {

/// Over n > 0 primitives. A leaf (FACET_LEAF) is a run of places of `order`; the leaves hold each
/// place once. Nodes stand in any order.
struct node_tree {
  runtime::buffer<Node> nodes{1};           ///< node_count, or room for more
  runtime::buffer<std::uint32_t> order{1};  ///< n, or more: the primitive at each place
  std::uint32_t node_count = 0;             ///< leaves, less 1
  std::uint32_t root = FACET_NONE;          ///< as a child
  std::uint32_t depth = 0;                  ///< nodes on the longest way down
};

}  // namespace facet::tracer
