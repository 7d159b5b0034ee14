// A binary tree over boxes by recursive subdivision under the surface area heuristic
// (Goldsmith and Salmon 1987; binned as in Wald 2007, a full sweep where few boxes are left).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "scene/vec.hpp"

namespace facet::reference {

/// An inner node has its children at `first` and `first + 1`; a leaf holds `count` > 0 boxes from
/// `first` on in sah_tree::order.
struct sah_node {
  box3f box;
  std::uint32_t first = 0, count = 0;

  bool is_leaf() const { return count > 0; }
};

struct sah_tree {
  std::vector<sah_node> nodes;       ///< the root first; empty if there are no boxes
  std::vector<std::uint32_t> order;  ///< boxes by leaf
};

/// No leaf lies deeper, whatever the boxes: below sah_free_depth boxes are halved by number.
inline constexpr unsigned sah_free_depth = 48;
inline constexpr unsigned sah_max_depth = sah_free_depth + 32;

/// A leaf holds at most `leaf_size` boxes and costs as much as a node.
sah_tree build_sah(std::span<const box3f> boxes, unsigned leaf_size);

}  // namespace facet::reference
