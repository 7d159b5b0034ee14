#include "tracer/plain_tree.hpp"

#include <utility>

#include "runtime/runtime.hpp"
#include "tracer/given_tree.hpp"
#include "tracer/kernels.hpp"
#include "tracer/node_trees.hpp"

namespace facet::tracer {
namespace {

plain_tree plain(std::span<const TreeNode> from, std::uint32_t root) {
  plain_tree to;
  to.nodes.reserve(from.size());
  to.nodes.emplace_back();
  std::vector<std::pair<std::uint32_t, std::uint32_t>> waiting{{root, 0}};  // from, to
  while (!waiting.empty()) {
    const auto [i, at] = waiting.back();
    waiting.pop_back();
    const TreeNode& n = from[i];
    plain_tree::node& made = to.nodes[at];
    made.box = {{n.lo[0], n.lo[1], n.lo[2]}, {n.hi[0], n.hi[1], n.hi[2]}};
    made.is_leaf = n.right == FACET_NONE;
    made.first = std::uint32_t(made.is_leaf ? to.primitives.size() : to.nodes.size());
    made.count = made.is_leaf ? 1 : 2;
    if (made.is_leaf) {
      to.primitives.push_back(n.left);
      continue;
    }
    waiting.push_back({n.right, made.first + 1});
    waiting.push_back({n.left, made.first});
    to.nodes.resize(to.nodes.size() + 2);
  }
  return to;
}

/// Its leaves hold one primitive each.
plain_tree plain(const node_tree& t) {
  const runtime::host_accessor nodes{t.nodes, runtime::read_only};
  const runtime::host_accessor order{t.order, runtime::read_only};
  plain_tree to;
  to.nodes.emplace_back();
  std::vector<std::pair<std::uint32_t, std::uint32_t>> waiting{{t.root, 0}};
  while (!waiting.empty()) {
    const auto [child, at] = waiting.back();
    waiting.pop_back();
    const bool is_leaf = child & FACET_LEAF_BIT;
    to.nodes[at].is_leaf = is_leaf;
    to.nodes[at].first = std::uint32_t(is_leaf ? to.primitives.size() : to.nodes.size());
    to.nodes[at].count = is_leaf ? 1 : 2;
    if (is_leaf) {
      to.primitives.push_back(order[FACET_LEAF_FIRST(child)]);
      continue;
    }
    const Node& n = nodes[child];
    for (std::size_t side = 0; side < 2; ++side) {
      const box3f box{{n.x[0][side], n.y[0][side], n.z[0][side]},
                      {n.x[1][side], n.y[1][side], n.z[1][side]}};
      if (at == 0) to.nodes[0].box.add(box);
      waiting.push_back({n.child[side], std::uint32_t(to.nodes.size())});
      to.nodes.push_back({box});
    }
  }
  return to;
}

}  // namespace

plain_tree built_tree(runtime::queue queue, tree_kind kind, std::span<const texel> corners) {
  if (kind == tree_kind::none)
    throw runtime::exception(runtime::errc::invalid,
                             "a scene without trees has none to be read; choose a builder");
  runtime::buffer<texel> on_device(corners.data(), corners.size());
  return plain(node_trees(queue, kernel_sources(), tuning_for(queue.get_device()), kind, {1, 1})
                   .over_triangles(on_device, std::uint32_t(corners.size() / 3)));
}

plain_tree built_tree(const given_tree& given, std::span<const texel> corners) {
  const host_binary_tree tree = binary_of(given, corners);
  return plain(tree.nodes, tree.root);
}

}  // namespace facet::tracer
