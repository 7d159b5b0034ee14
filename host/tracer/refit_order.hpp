// In which order a tree's boxes are made anew: from the leaves up, shared out so that work-items
// need not wait for one another (cl/refit.cl).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace facet::tracer {

/// Treelets are connected parts of the tree. All that lies below a treelet's nodes is in the
/// treelet, or in one of a phase before.
struct refit_order {
  std::vector<std::uint32_t> nodes;   ///< treelet by treelet, each from below up
  std::vector<std::uint32_t> starts;  ///< of treelets in `nodes`, phase by phase, and the end
  std::vector<std::uint32_t> phases;  ///< each one's first treelet, and the end
};

/// children: `width` a node, as nodes have them, nodes being counted from first_node on (layout.h);
/// a treelet has at most `most` > 0 nodes. Nodes that `root` does not lead to are left out; of a
/// root that is a leaf there are none.
refit_order order_for_refit(std::span<const std::uint32_t> children, std::uint32_t width,
                            std::uint32_t root, std::uint32_t first_node, std::uint32_t most);

}  // namespace facet::tracer
