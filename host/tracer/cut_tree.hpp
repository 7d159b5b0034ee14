// Leaves of several primitives for a tree over single ones.
#pragma once

#include <cstdint>

#include "runtime/runtime.hpp"
#include "tracer/binary_tree.hpp"
#include "tracer/leaf_rule.hpp"
#include "tracer/node_tree.hpp"
#include "tracer/program_set.hpp"
#include "tracer/tuning.hpp"

namespace facet::tracer {

class tree_cutter {
 public:
  tree_cutter(runtime::queue q, const runtime::source_tree& kernels, const tuning& t);

  /// Subtrees become leaves by the rule; the order is the tree's. Waits for the count of nodes.
  /// Some nodes may be no other's child, below those that became leaves.
  node_tree cut(const binary_tree& tree, leaf_rule leaves);

  /// Device memory that `cut` takes at its peak beside the tree, what it gives included.
  static std::uint64_t scratch_bytes(std::uint64_t primitives) {
    return primitives * (sizeof(Node) + sizeof(std::uint32_t));
  }

  void add_programs(program_set& to) const { to.add(program_); }

 private:
  runtime::queue queue_;
  tuning tuning_;
  runtime::program program_;
  runtime::kernel number_nodes_, cut_nodes_;
};

}  // namespace facet::tracer
