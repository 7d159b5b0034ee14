// The wide layout (cl/layout.h: WideNode, TriangleBlock) of a binary tree, made on the host.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tracer/layout.hpp"
#include "tracer/pack.hpp"

namespace facet::tracer {

/// Eight children to a node. Leaf k holds the primitives order[k * lanes .. (k + 1) * lanes), those
/// that are there first, then FACET_NONE.
struct wide_tree {
  std::vector<WideNode> nodes;
  std::vector<std::uint32_t> order;
  std::uint32_t root = FACET_NONE;  ///< as a child
  std::uint32_t depth = 0;          ///< nodes on the longest way down
};

/// Folds the binary tree below `root` over `count` > 0 primitives (binary_tree.hpp: nodes 0 to
/// count - 1 are leaves): a subtree of at most `lanes` primitives becomes a leaf; what becomes a
/// node is chosen so that the nodes' areas sum up to the least. Children are named as if the
/// first node stood at `first_node` and the first leaf at `first_leaf`. `lanes` is FACET_BLOCK
/// for triangles and 1 for instances.
wide_tree widened(std::span<const TreeNode> binary, std::uint32_t root, std::uint32_t count,
                  std::uint32_t lanes, std::uint32_t first_node, std::uint32_t first_leaf);

/// The corners of the triangles in `order`, whole blocks; triangle i has corners[3 * i ..].
///
/// A lane without a triangle repeats a corner of the block's first one: a, a, b. No ray meets it,
/// by cl/triangle.h. With the sheared corners p, p, q the rough edge functions are P - Q, Q - P and
/// 0 with the same rounded P and Q: of opposite signs, unless P = Q. Then the exact ones, which are
/// the difference of the two products' rounding errors, are opposite, too, or 0, and so is their
/// sum.
void append_blocks(std::span<const std::uint32_t> order, std::span<const texel> corners,
                   std::vector<TriangleBlock>& blocks);

}  // namespace facet::tracer
