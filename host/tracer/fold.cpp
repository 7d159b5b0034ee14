#include "tracer/fold.hpp"

#include "tracer/kernels.hpp"
#include "tracer/launch.hpp"

namespace facet::tracer {
namespace {

// cl/fold.cl: nodes that are opened at most, and subtrees that may then be left. Each opened node
// puts at most 1, or 7, in place of itself.
constexpr std::uint32_t opened_binary = 128, binary_subtrees = opened_binary + 1;
constexpr std::uint32_t opened_wide = 73, wide_subtrees = 7 * opened_wide + 1;
constexpr std::uint32_t front_size = 2 + opened_wide + wide_subtrees;
static_assert(front_size >= 2 + opened_binary + binary_subtrees);

constexpr std::uint32_t plan_steps = 3, emit_steps = 2;

// cl/fold.cl: RECORDS and NODE_RECORDS.
constexpr std::uint32_t stack_records = 64 * binary_subtrees;

}  // namespace

std::uint64_t folder::scratch_bytes(std::uint64_t nodes) {
  return (stack_records + nodes) * sizeof(FoldCost) + nodes * sizeof(FoldPlan);
}

folder::folder(runtime::queue q, const runtime::source_tree& kernels, const tuning& t)
    : queue_(q),
      program_(compiled(q, kernels, t.serial_trees ? serial_file : "fold.cl", t.flags())),
      plan_(program_.get_kernel("plan_fold")),
      emit_(program_.get_kernel("emit_fold")) {}

fold_plan folder::plan(const node_tree& tree) {
  fold_plan p{0, 1, 0, runtime::buffer<FoldPlan>(tree.node_count)};
  if (tree.root & FACET_LEAF_BIT) return p;
  runtime::buffer<FoldCost> costs(stack_records + std::size_t(tree.node_count));
  runtime::buffer<std::uint32_t> front(front_size), sizes(3);
  for (std::uint32_t step = 0; step < plan_steps; ++step)
    queue_.submit([&](runtime::handler& h) {
      const runtime::accessor nodes{tree.nodes, h, runtime::read_only};
      const runtime::accessor list{front, h, runtime::read_write};
      const runtime::accessor cost{costs, h, runtime::read_write};
      const runtime::accessor plans{p.by_node, h, runtime::read_write};
      const runtime::accessor out{sizes, h, runtime::write_only};
      h.set_args(nodes, tree.root, list, cost, plans, out, step);
      h.parallel_for(in_groups(step == 1 ? binary_subtrees : 1, 1), plan_);
    });
  const runtime::host_accessor read{sizes, runtime::read_only};
  p.nodes = read[0], p.leaves = read[1], p.depth = read[2];
  return p;
}

std::uint32_t folder::emit(const node_tree& tree, fold_plan& plan, runtime::buffer<WideNode>& wide,
                           std::uint32_t first_node, runtime::buffer<std::uint32_t>& leaves,
                           std::uint32_t first_leaf) {
  if (tree.root & FACET_LEAF_BIT) {
    queue_.submit([&](runtime::handler& h) {
      const runtime::accessor out{leaves, h, runtime::write_only};
      h.fill(out, tree.root);
    });
    return FACET_LEAF(first_leaf, 1u);
  }
  runtime::buffer<std::uint32_t> front(front_size);
  for (std::uint32_t step = 0; step < emit_steps; ++step)
    queue_.submit([&](runtime::handler& h) {
      const runtime::accessor nodes{tree.nodes, h, runtime::read_only};
      const runtime::accessor plans{plan.by_node, h, runtime::read_write};
      const runtime::accessor list{front, h, runtime::read_write};
      const runtime::accessor to{wide, h, runtime::read_write};
      const runtime::accessor leaf{leaves, h, runtime::read_write};
      h.set_args(nodes, tree.root, plans, list, to, leaf, first_node, first_leaf, step);
      h.parallel_for(in_groups(step == 1 ? wide_subtrees : 1, 1), emit_);
    });
  return first_node;
}

}  // namespace facet::tracer
