#include "tracer/tree_builder.hpp"

#include <algorithm>

#include "tracer/subtrees.hpp"
#include "tracer/top_tree.hpp"

namespace facet::tracer {
namespace {

/// Nodes that trees are expected to have at most: 0.62 a primitive was never reached where leaves
/// hold two or more (bunny 0.55, terrain 0.53, soup 0.60). A tree that has more is built again.
std::uint32_t usual_nodes(std::uint32_t count, leaf_rule leaves) {
  const auto usual = std::uint32_t(0.62 * count);
  return leaves.sure < 2 || count < 4096 ? count : usual;
}

}  // namespace

/// What is made of one kind of primitives with one leaf rule.
template <class Primitive>
struct tree_builder<Primitive>::parts {
  parts(const runtime::queue& q, const runtime::source_tree& kernels, const tuning& t,
        leaf_rule leaves)
      : morton_codes(q, kernels, t),
        sort(q, kernels, t),
        cut(q, kernels, t),
        bottom(q, kernels, t, leaves),
        top(q, kernels, t) {}

  morton<Primitive> morton_codes;
  radix_sort<std::uint32_t> sort;
  subtrees cut;
  bottoms<Primitive> bottom;
  top_tree top;
  runtime::buffer<Curve> curve{1};
  runtime::buffer<std::uint32_t> codes{1};
  runtime::buffer<Item> items{1};
  runtime::buffer<std::uint32_t> refs{1};
};

template <class Primitive>
tree_builder<Primitive>::tree_builder(const runtime::queue& q, const runtime::source_tree& kernels,
                                      const tuning& t, leaf_rule leaves)
    : leaves_(leaves), parts_(std::make_unique<parts>(q, kernels, t, leaves)) {}

template <class Primitive>
tree_builder<Primitive>::tree_builder(tree_builder&&) noexcept = default;
template <class Primitive>
tree_builder<Primitive>::~tree_builder() = default;

template <class Primitive>
double tree_builder<Primitive>::compile_ms() const {
  const parts& p = *parts_;
  return p.morton_codes.compile_ms() + p.sort.compile_ms() + p.cut.compile_ms() +
         p.bottom.compile_ms() + p.top.compile_ms();
}

template <class Primitive>
void tree_builder<Primitive>::build(runtime::buffer<Primitive>& primitives, std::uint32_t count,
                                    node_tree& into) {
  hold(into.nodes, std::max(usual_nodes(count, leaves_), 1u));
  hold(into.order, count);
  try_build(primitives, count, into);
  if (into.node_count <= into.nodes.size()) return;
  hold(into.nodes, count);
  try_build(primitives, count, into);
}

template <class Primitive>
void tree_builder<Primitive>::try_build(runtime::buffer<Primitive>& primitives, std::uint32_t count,
                                        node_tree& t) {
  parts& p = *parts_;
  steps_.clear();
  hold(p.codes, count);
  p.morton_codes.codes(primitives, p.curve, p.codes, count, steps_);
  for (step& s : p.sort.sort_order(p.codes, t.order, count)) steps_.push_back(std::move(s));
  const std::uint32_t found = p.cut.list(p.codes, count, steps_);
  hold(p.items, found);
  hold(p.refs, found);
  tree_parts to{t.nodes, p.items, p.refs};
  t.node_count = p.bottom.build(primitives, p.cut.starts(), found, t.order, to, found - 1, steps_);
  if (t.node_count > t.nodes.size()) return;
  if (found > 1) {
    t.root = 0;
    t.depth = p.top.build(p.curve, to, found, steps_);
  } else {
    const runtime::host_accessor refs{p.refs, runtime::read_only};
    const runtime::host_accessor items{p.items, runtime::read_only};
    t.root = refs[0];
    t.depth = items[0].size >> FACET_HEIGHT_BIT;
  }
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
