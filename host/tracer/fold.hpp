// The wide layout's nodes from a binary tree, on the device.
#pragma once

#include <cstdint>

#include "runtime/runtime.hpp"
#include "tracer/node_tree.hpp"
#include "tracer/program_set.hpp"
#include "tracer/tuning.hpp"

namespace facet::tracer {

/// How a tree will be folded: what it takes is known, nothing is written yet.
struct fold_plan {
  std::uint32_t nodes = 0;   ///< wide nodes
  std::uint32_t leaves = 0;  ///< as in the binary tree
  std::uint32_t depth = 0;   ///< wide nodes on the longest way down
  runtime::buffer<FoldPlan> by_node;
};

class folder {
 public:
  folder(runtime::queue q, const runtime::source_tree& kernels, const tuning& t);

  /// Of all ways to fold the tree into nodes of up to eight children, the one whose nodes' areas
  /// sum up to the least (cl/fold.h). Waits for the sizes.
  fold_plan plan(const node_tree& tree);

  /// Writes the plan's nodes into `wide` from first_node on, in depth-first order, and what leaf k
  /// of them is (FACET_LEAF: a run of places of tree.order) into leaves[k]. Gives the root as a
  /// child, leaf k being FACET_LEAF(first_leaf + k, 1). Uses the plan up. Nothing is waited for.
  std::uint32_t emit(const node_tree& tree, fold_plan& plan, runtime::buffer<WideNode>& wide,
                     std::uint32_t first_node, runtime::buffer<std::uint32_t>& leaves,
                     std::uint32_t first_leaf);

  /// Device memory that `plan` takes beside a tree of that many nodes, and that it keeps of this.
  static std::uint64_t scratch_bytes(std::uint64_t nodes);
  static std::uint64_t kept_bytes(std::uint64_t nodes) { return nodes * sizeof(FoldPlan); }

  void add_programs(program_set& to) const { to.add(program_); }

 private:
  runtime::queue queue_;
  runtime::program program_;
  runtime::kernel plan_, emit_;
};

}  // namespace facet::tracer
