// A tree that a caller has made, as a builder's.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tracer/layout.hpp"
#include "tracer/pack.hpp"
#include "tracer/tracer.hpp"

namespace facet::tracer {

/// binary_tree (binary_tree.hpp) in the host's memory.
struct host_binary_tree {
  std::vector<TreeNode> nodes;
  std::vector<std::uint32_t> order;
  std::uint32_t root = 0, depth = 0;
};

/// The tree of that shape over count triangles, with the boxes of their corners; the runs of its
/// leaves are halved until each triangle is a leaf. Throws runtime::exception (invalid) if it is
/// not a tree that holds each triangle once, or if a way down is longer than 4,096.
host_binary_tree binary_of(const given_tree& given, std::span<const texel> corners);

}  // namespace facet::tracer
