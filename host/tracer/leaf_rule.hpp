// When a subtree becomes a leaf.
#pragma once

#include <cstdint>

#include "tracer/layout.hpp"

namespace facet::tracer {

struct leaf_rule {
  std::uint32_t sure = 2;  ///< primitives: a subtree of at most so many always, at least 1
  /// One of at most so many, up to 16, where testing all of them costs no more than visiting the
  /// children, by the surface area heuristic (MacDonald and Booth 1990).
  std::uint32_t most = 4;
  std::uint32_t block = 1;  ///< primitives of a leaf that are tested at once, a power of 2
};

/// Of trees over instances.
inline constexpr leaf_rule one_each{1, 1};
/// Of the wide layout: a leaf is a block.
inline constexpr leaf_rule block_leaves{FACET_BLOCK, FACET_BLOCK, FACET_BLOCK};

}  // namespace facet::tracer
