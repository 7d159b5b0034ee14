#include "tracer/node_trees.hpp"

#include "tracer/given_tree.hpp"

namespace facet::tracer {
node_trees::node_trees(const runtime::queue& q, const runtime::source_tree& kernels,
                       const tuning& t, tree_kind kind, leaf_rule leaves)
    : leaves_(leaves), cut_(q, kernels, t) {
  if (kind == tree_kind::binned)
    binned_.emplace(q, kernels, t, leaves);
  else
    levels_.emplace(q, kernels, t);
}

node_tree node_trees::over_triangles(runtime::buffer<texel>& corners, std::uint32_t count) {
  if (binned_) {
    node_tree tree;
    binned_->build(corners, count, tree);
    return tree;
  }
  runtime::buffer<Box> boxes = levels_->boxes_of(corners, count);
  const binary_tree tree = levels_->build(boxes, count);
  boxes = runtime::buffer<Box>(1);  // the tree has them in its leaves
  return cut_.cut(tree, leaves_);
}

node_tree node_trees::from(const given_tree& given, std::span<const texel> corners) {
  const host_binary_tree t = binary_of(given, corners);
  return cut_.cut({runtime::buffer<TreeNode>(t.nodes.data(), t.nodes.size()),
                   runtime::buffer<std::uint32_t>(t.order.data(), t.order.size()),
                   std::uint32_t(t.order.size()), t.root, t.depth},
                  leaves_);
}

std::uint64_t node_trees::scratch_bytes(std::uint64_t triangles, tree_kind kind) {
  if (kind == tree_kind::binned) return tree_builder<texel>::scratch_bytes(triangles);
  return levels_builder::scratch_bytes(triangles) + tree_cutter::scratch_bytes(triangles);
}

double node_trees::compile_ms() const {
  return cut_.compile_ms() + (levels_ ? levels_->compile_ms() : 0) +
         (binned_ ? binned_->compile_ms() : 0);
}

}  // namespace facet::tracer
