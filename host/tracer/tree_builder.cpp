#include "tracer/tree_builder.hpp"

#include <algorithm>
#include <optional>

#include "tracer/curve_order.hpp"
#include "tracer/levels.hpp"
#include "tracer/top_tree.hpp"

namespace facet::tracer {
namespace {

/// Nodes that trees are expected to have at most: 0.62 a primitive was never reached where leaves
/// hold two or more (bunny 0.55, terrain 0.53, soup 0.60). A tree that has more is built again.
std::uint32_t usual_nodes(std::uint32_t count, leaf_rule leaves) {
  const auto usual = std::uint32_t(0.62 * count);
  return leaves.sure < 2 || count < 4096 ? count : usual;
}

/// What `binned` is made by.
template <class Primitive>
struct binned {
  binned(const runtime::queue& q, const runtime::source_tree& kernels, const tuning& t,
         leaf_rule leaves, bool in_order)
      : bottom(q, kernels, t, leaves, in_order), top(q, kernels, t) {}

  built_root build(runtime::buffer<Primitive>& primitives, runtime::buffer<Curve>& curve,
                   const sorted_places& places, tree_parts& to, const leaf_triangles* sorted,
                   std::vector<step>& steps) {
    const std::uint32_t subtrees = places.subtrees;
    bottom.build(primitives, places.starts, subtrees, places.order, to, subtrees - 1, sorted,
                 steps);
    built_root r{0, 0, 0};
    // Two subtrees side by side have more than FACET_SWEEP_MOST primitives: the top's nodes have
    // room however many there are below.
    if (subtrees > 1) r.depth = top.build(curve, to, subtrees, steps);
    r.nodes = bottom.nodes();
    if (subtrees > 1) return r;
    const runtime::host_accessor refs{to.refs, runtime::read_only};
    const runtime::host_accessor items{to.items, runtime::read_only};
    r.root = refs[0];
    r.depth = items[0].size >> FACET_HEIGHT_BIT;
    return r;
  }

  bottoms<Primitive> bottom;
  top_tree top;
};

}  // namespace

/// What is made of one kind of primitives with one leaf rule.
template <class Primitive>
struct tree_builder<Primitive>::parts {
  parts(const runtime::queue& q, const runtime::source_tree& kernels, const tuning& t,
        tree_kind kind, leaf_rule leaves, bool in_order)
      : in_curve(q, kernels, t) {
    // A group reads a subtree's triangles anyway. What a single work-item does is faster apart.
    const bool at_once = in_order && !t.serial_trees;
    if (kind == tree_kind::levels)
      merge.emplace(q, kernels, t, leaves, at_once);
    else
      split.emplace(q, kernels, t, leaves, at_once);
    if (in_order && !at_once) gather.emplace(q, kernels, t);
  }

  curve_order<Primitive> in_curve;
  std::optional<levels<Primitive>> merge;
  std::optional<binned<Primitive>> split;
  std::optional<leaf_order> gather;
  runtime::buffer<Curve> curve{1};
  runtime::buffer<std::uint32_t> codes{1};
  runtime::buffer<Item> items{1};
  runtime::buffer<std::uint32_t> refs{1};
};

template <class Primitive>
tree_builder<Primitive>::tree_builder(const runtime::queue& q, const runtime::source_tree& kernels,
                                      const tuning& t, tree_kind kind, leaf_rule leaves,
                                      bool in_order)
    : leaves_(leaves), parts_(std::make_unique<parts>(q, kernels, t, kind, leaves, in_order)) {}

template <class Primitive>
tree_builder<Primitive>::tree_builder(tree_builder&&) noexcept = default;
template <class Primitive>
tree_builder<Primitive>::~tree_builder() = default;

template <class Primitive>
void tree_builder<Primitive>::prepare(std::uint32_t count) {
  parts_->in_curve.prepare(count);
}

template <class Primitive>
void tree_builder<Primitive>::add_programs(program_set& to) const {
  const parts& p = *parts_;
  p.in_curve.add_programs(to);
  if (p.gather) p.gather->add_programs(to);
  if (p.merge) p.merge->add_programs(to);
  if (!p.split) return;
  p.split->bottom.add_programs(to);
  p.split->top.add_programs(to);
}

template <class Primitive>
void tree_builder<Primitive>::build(runtime::buffer<Primitive>& primitives, std::uint32_t count,
                                    node_tree& into, const leaf_triangles* sorted) {
  hold(into.nodes, std::max(usual_nodes(count, leaves_), 1u));
  hold(into.order, count);
  try_build(primitives, count, into, sorted);
  if (into.node_count <= into.nodes.size()) return;
  hold(into.nodes, count);
  try_build(primitives, count, into, sorted);
}

template <class Primitive>
void tree_builder<Primitive>::try_build(runtime::buffer<Primitive>& primitives, std::uint32_t count,
                                        node_tree& t, const leaf_triangles* sorted) {
  parts& p = *parts_;
  steps_.clear();
  hold(p.codes, count);
  const std::uint32_t found = p.in_curve.make(primitives, count, p.curve, p.codes, t.order, steps_);
  hold(p.items, found);
  hold(p.refs, found);
  tree_parts to{t.nodes, p.items, p.refs};
  const sorted_places places{p.codes, t.order, p.in_curve.starts(), count, found};
  const leaf_triangles* at_once = p.gather ? nullptr : sorted;
  const built_root r = p.merge ? p.merge->build(primitives, places, to, at_once, steps_)
                               : p.split->build(primitives, p.curve, places, to, at_once, steps_);
  if constexpr (std::is_same_v<Primitive, texel>)
    if (p.gather)
      steps_.push_back(
          {"gather_triangles", p.gather->triangles(t.order, primitives, count, *sorted)});
  t.node_count = r.nodes, t.root = r.root, t.depth = r.depth;
}

template <class Primitive>
std::uint64_t tree_builder<Primitive>::scratch_bytes(std::uint64_t count) {
  // Nodes and order; codes and their and the order's copies for the sort; what the top has.
  const std::uint64_t items = count / 8 + 1;  // subtrees of meshes have about 20 primitives
  return count * (sizeof(Node) * 62 / 100 + 4 + 12) + items * (sizeof(Item) + 8) +
         top_tree::scratch_bytes(items);
}

template class tree_builder<texel>;
template class tree_builder<Box>;

}  // namespace facet::tracer
