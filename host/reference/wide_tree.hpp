// Four children to a node: the SAH tree with every other level folded away, laid out so that one
// plain vector operation tests the four boxes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "reference/sah.hpp"
#include "scene/vec.hpp"

namespace facet::reference {

inline constexpr std::size_t tree_width = 4;

/// A child is the index of a node, or a leaf with the top bit set, or nothing.
inline constexpr std::uint32_t leaf_bit = 0x80000000u, no_child = 0xffffffffu;

struct alignas(64) wide_node {
  /// plane[2 * axis] the lower, plane[2 * axis + 1] the upper bound of each child.
  std::array<std::array<float, tree_width>, 6> plane;
  std::array<std::uint32_t, tree_width> child;
};

struct wide_tree {
  /// Each level leaves at most width - 1 children behind and follows one more.
  static constexpr std::size_t stack_size = (tree_width - 1) * sah_max_depth + tree_width;

  std::uint32_t root = no_child;
  std::vector<wide_node> nodes;
  std::vector<std::uint32_t> order;       ///< boxes by leaf
  std::vector<std::uint32_t> leaf_first;  ///< leaf i holds order[leaf_first[i] .. leaf_first[i+1])

  wide_tree() = default;
  wide_tree(std::span<const box3f> boxes, unsigned leaf_size);

  std::span<const std::uint32_t> leaf(std::size_t i) const {
    return std::span(order).subspan(leaf_first[i], leaf_first[i + 1] - leaf_first[i]);
  }
  std::size_t leaf_count() const { return leaf_first.empty() ? 0 : leaf_first.size() - 1; }
};

}  // namespace facet::reference
