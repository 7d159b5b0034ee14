// What a builder makes of boxes: a binary tree and the order of its leaves.
#pragma once

#include <cstdint>

#include "runtime/runtime.hpp"
#include "tracer/layout.hpp"

namespace facet::tracer {

/// Over n > 0 primitives: nodes 0 to n-1 are the leaves in order, n + i joins positions i and i
/// + 1.
struct binary_tree {
  runtime::buffer<TreeNode> nodes;       ///< 2n - 1
  runtime::buffer<std::uint32_t> order;  ///< n: the primitive at each position
  std::uint32_t count = 0;               ///< n
  std::uint32_t root = 0;                ///< index of the root in `nodes`
  std::uint32_t depth = 0;               ///< edges on the longest way down
};

}  // namespace facet::tracer
