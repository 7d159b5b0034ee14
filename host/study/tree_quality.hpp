// How good a tree is, before any ray is traced. Costs are expected work for a random ray: of a
// visit to a node and of a test of a triangle, 1 each.
#pragma once

#include <cstdint>
#include <span>

#include "tracer/plain_tree.hpp"

namespace facet::study {

struct tree_quality {
  /// Of the nodes as they are, however many children one has: sum over inner nodes of A(node), and
  /// over leaves of A(leaf) times its primitives, by A(root), where A is a box's surface
  /// (Goldsmith and Salmon 1987; MacDonald and Booth 1990). Trees of equally many children a node
  /// can be compared by it. 0 if the root has no area.
  double sah_cost = 0;
  /// Sum over all nodes of A(node), by A(root), leaves like others: the visits of a random ray, and
  /// its cost where all of a leaf is tested at once, as the wide layout does.
  double visits = 0;
  std::uint64_t primitives = 0;
  std::uint64_t inner_nodes = 0, leaves = 0;
  std::uint32_t depth = 0;         ///< edges on the longest way down
  std::uint32_t most_in_leaf = 0;  ///< primitives
  double bytes_a_primitive = 0;    ///< plain_tree::bytes over primitives

  double primitives_a_leaf() const { return double(primitives) / double(leaves); }
};

tree_quality quality_of(const tracer::plain_tree& t);

/// The least SAH cost over all ways to make leaves of whole subtrees with at most `most_in_leaf`
/// primitives: what a binary tree of single triangles is worth, whatever a layout makes its leaves.
double cost_with_best_leaves(const tracer::plain_tree& t, std::uint32_t most_in_leaf);

}  // namespace facet::study
