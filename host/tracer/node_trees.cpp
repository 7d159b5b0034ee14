#include "tracer/node_trees.hpp"

#include <algorithm>

#include "tracer/given_tree.hpp"

namespace facet::tracer {
namespace {

Box box_of(const Instance& i) {
  Box b{};
  std::copy(std::begin(i.lo), std::end(i.lo), b.lo);
  std::copy(std::begin(i.hi), std::end(i.hi), b.hi);
  return b;
}

}  // namespace

node_trees::node_trees(const runtime::queue& q, const runtime::source_tree& kernels,
                       const tuning& t, tree_kind kind, leaf_rule leaves)
    : queue_(q), kernels_(kernels), tuning_(t), leaves_(leaves) {
  if (kind == tree_kind::binned) {
    binned_.emplace(q, kernels, t, leaves);
    return;
  }
  levels_.emplace(q, kernels, t);
  cutter();  // its time to compile is none of a build's
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
  return cutter().cut(tree, leaves_);
}

node_tree node_trees::over_instances(const std::vector<Instance>& placed) {
  std::vector<Box> boxes;
  boxes.reserve(placed.size());
  for (const Instance& i : placed) boxes.push_back(box_of(i));
  runtime::buffer<Box> on_device(boxes.data(), boxes.size());
  const auto count = std::uint32_t(boxes.size());
  if (levels_) return cutter().cut(levels_->build(on_device, count), one_each);
  if (!binned_boxes_) binned_boxes_.emplace(queue_, kernels_, tuning_, one_each);
  node_tree tree;
  binned_boxes_->build(on_device, count, tree);
  return tree;
}

node_tree node_trees::from(const given_tree& given, std::span<const texel> corners) {
  const host_binary_tree t = binary_of(given, corners);
  return cutter().cut({runtime::buffer<TreeNode>(t.nodes.data(), t.nodes.size()),
                       runtime::buffer<std::uint32_t>(t.order.data(), t.order.size()),
                       std::uint32_t(t.order.size()), t.root, t.depth},
                      leaves_);
}

tree_cutter& node_trees::cutter() {
  if (!cut_) cut_.emplace(queue_, kernels_, tuning_);
  return *cut_;
}

std::uint64_t node_trees::scratch_bytes(std::uint64_t triangles, tree_kind kind) {
  if (kind == tree_kind::binned) return tree_builder<texel>::scratch_bytes(triangles);
  return levels_builder::scratch_bytes(triangles) + tree_cutter::scratch_bytes(triangles);
}

double node_trees::compile_ms() const {
  return (cut_ ? cut_->compile_ms() : 0) + (levels_ ? levels_->compile_ms() : 0) +
         (binned_ ? binned_->compile_ms() : 0) + (binned_boxes_ ? binned_boxes_->compile_ms() : 0);
}

}  // namespace facet::tracer
