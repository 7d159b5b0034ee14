#include "tracer/top_level.hpp"

#include <algorithm>
#include <utility>

#include "tracer/kernels.hpp"
#include "tracer/launch.hpp"
#include "tracer/tree.hpp"

namespace facet::tracer {
namespace {

Box box_of(const Instance& i) {
  Box b{};
  std::copy(std::begin(i.lo), std::end(i.lo), b.lo);
  std::copy(std::begin(i.hi), std::end(i.hi), b.hi);
  return b;
}

}  // namespace

top_level::top_level(const runtime::queue& q, const runtime::source_tree& kernels, const tuning& t,
                     tree_kind kind, bool is_wide, std::size_t instances)
    : queue_(q), group_(t.group), builder_(q, kernels, t, kind, one_each) {
  builder_.prepare(std::uint32_t(instances));
  if (is_wide) {
    fold_.emplace(q, kernels, t);
  } else {
    narrow_ = compiled(q, kernels, "tree.cl", t.flags());
    append_nodes_ = narrow_->get_kernel("append_nodes");
  }
}

top_plan top_level::plan(const std::vector<Instance>& placed) {
  std::vector<Box> boxes;
  boxes.reserve(placed.size());
  for (const Instance& i : placed) boxes.push_back(box_of(i));
  runtime::buffer<Box> on_device(boxes.data(), boxes.size());
  builder_.build(on_device, std::uint32_t(boxes.size()), tree_);
  top_plan p;
  p.tree = tree_;
  if (fold_) p.fold = fold_->plan(p.tree);
  p.nodes = fold_ ? p.fold.nodes : p.tree.node_count;
  p.levels = fold_ ? p.fold.depth : p.tree.depth;
  return p;
}

std::uint32_t top_level::write(top_plan& p, device_geometry& g, std::uint32_t first_node,
                               std::vector<Instance>& placed) {
  runtime::buffer<std::uint32_t> leaves(placed.size());
  const std::uint32_t root = fold_
                                 ? fold_->emit(p.tree, p.fold, g.wide_nodes, first_node, leaves, 0)
                                 : write_narrow(p, g, first_node);
  const runtime::host_accessor order{p.tree.order, runtime::read_only};
  std::vector<Instance> sorted;
  sorted.reserve(placed.size());
  if (fold_) {
    const runtime::host_accessor leaf{leaves, runtime::read_only};
    for (const std::uint32_t place : leaf) sorted.push_back(placed[order[FACET_LEAF_FIRST(place)]]);
  } else {
    for (std::size_t i = 0; i < placed.size(); ++i) sorted.push_back(placed[order[i]]);
  }
  placed = std::move(sorted);
  return root;
}

std::uint32_t top_level::write_narrow(top_plan& p, device_geometry& g, std::uint32_t first_node) {
  if (p.tree.root & FACET_LEAF_BIT) return p.tree.root;
  queue_.submit([&](runtime::handler& h) {
    const runtime::accessor from{p.tree.nodes, h, runtime::read_only};
    const runtime::accessor to{g.nodes, h, runtime::read_write};
    h.set_args(from, to, p.tree.node_count, first_node, 0u);
    h.parallel_for(padded(p.tree.node_count, group_), *append_nodes_);
  });
  return first_node + p.tree.root;
}

void top_level::add_programs(program_set& to) const {
  if (narrow_) to.add(*narrow_);
  builder_.add_programs(to);
  if (fold_) fold_->add_programs(to);
}

}  // namespace facet::tracer
