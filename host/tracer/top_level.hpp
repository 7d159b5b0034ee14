// The tree over a scene's instances, in either layout: built with the scene, and again when they
// move.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "runtime/runtime.hpp"
#include "tracer/fold.hpp"
#include "tracer/node_tree.hpp"
#include "tracer/tracer.hpp"
#include "tracer/tree_builder.hpp"
#include "tracer/tuning.hpp"

namespace facet::tracer {

struct device_geometry;

/// A top tree that is built, but not yet in the scene's array of nodes.
struct top_plan {
  node_tree tree;
  fold_plan fold{0, 0, 0, runtime::buffer<FoldPlan>(1)};  ///< in the wide layout
  std::uint32_t nodes = 0;                                ///< of the layout
  std::uint32_t levels = 0;                               ///< of these, on the longest way down
};

class top_level {
 public:
  /// kind: not tree_kind::none. instances: to be expected. `kernels` outlive this.
  top_level(const runtime::queue& q, const runtime::source_tree& kernels, const tuning& t,
            tree_kind kind, bool is_wide, std::size_t instances);

  /// Over the bounds of placed meshes, at least one; an instance is a leaf. The plan before is used
  /// up, too. Waits for the device.
  top_plan plan(const std::vector<Instance>& placed);

  /// Nodes that a layout's top tree has at most.
  static std::uint64_t most_nodes(std::size_t instances) {
    return instances == 0 ? 0 : instances - 1;
  }

  /// Writes the nodes into those of g from first_node on, for which there must be room; puts
  /// `placed` into the order of the leaves. Gives the root as a child. Uses the plan up.
  std::uint32_t write(top_plan& p, device_geometry& g, std::uint32_t first_node,
                      std::vector<Instance>& placed);

  void add_programs(program_set& to) const;

 private:
  std::uint32_t write_narrow(top_plan& p, device_geometry& g, std::uint32_t first_node);

  runtime::queue queue_;
  std::uint32_t group_;
  tree_builder<Box> builder_;
  std::optional<folder> fold_;
  node_tree tree_;  ///< of the last plan: its memory is used again
  std::optional<runtime::program> narrow_;
  std::optional<runtime::kernel> append_nodes_;
};

}  // namespace facet::tracer
