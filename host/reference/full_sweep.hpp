// The full-sweep SAH builder: the yardstick for the quality of other builders' trees.
#pragma once

#include <span>

#include "reference/sah.hpp"
#include "scene/vec.hpp"

namespace facet::reference {

/// A tree over finite boxes, top-down: of all places to split a node, along all three axes in the
/// order of centres (ties by number), the one with the least sum of half area times count over both
/// sides (MacDonald and Booth 1990); of equal ones the first axis and the smallest left side. Then,
/// bottom-up, a subtree of at most `most_in_leaf` boxes becomes a leaf where that does not cost
/// more, a node and a box costing 1 each. Depth is bounded as build_sah's (sah_max_depth).
/// Sorts once and then takes time linear in the boxes for each level of the tree.
sah_tree sweep_sah(std::span<const box3f> boxes, unsigned most_in_leaf = 4);

}  // namespace facet::reference
