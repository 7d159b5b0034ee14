#include "tracer/node_trees.hpp"

#include "tracer/given_tree.hpp"

namespace facet::tracer {
node_trees::node_trees(const runtime::queue& q, const runtime::source_tree& kernels,
                       const tuning& t, tree_kind kind, leaf_rule leaves, bool in_order)
    : queue_(q),
      kernels_(kernels),
      tuning_(t),
      leaves_(leaves),
      over_triangles_(q, kernels, t, kind, leaves, in_order) {}

node_tree node_trees::over_triangles(runtime::buffer<texel>& corners, std::uint32_t count,
                                     const leaf_triangles* sorted) {
  node_tree tree;
  over_triangles_.build(corners, count, tree, sorted);
  return tree;
}

node_tree node_trees::from(const given_tree& given, std::span<const texel> corners) {
  const host_binary_tree t = binary_of(given, corners);
  if (!cut_) cut_.emplace(queue_, kernels_, tuning_);
  return cut_->cut({runtime::buffer<TreeNode>(t.nodes.data(), t.nodes.size()),
                    runtime::buffer<std::uint32_t>(t.order.data(), t.order.size()),
                    std::uint32_t(t.order.size()), t.root, t.depth},
                   leaves_);
}

void node_trees::add_programs(program_set& to) const {
  if (cut_) cut_->add_programs(to);
  over_triangles_.add_programs(to);
}

}  // namespace facet::tracer
