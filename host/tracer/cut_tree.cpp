#include "tracer/cut_tree.hpp"

#include "tracer/kernels.hpp"
#include "tracer/launch.hpp"

namespace facet::tracer {
namespace {

constexpr std::uint32_t run = 1024;  ///< positions that a work-item numbers

}  // namespace

tree_cutter::tree_cutter(runtime::queue q, const runtime::source_tree& kernels, const tuning& t)
    : queue_(q),
      tuning_(t),
      program_(compiled(q, kernels, "cut_tree.cl", t.flags())),
      number_nodes_(program_.get_kernel("number_nodes")),
      cut_nodes_(program_.get_kernel("cut_nodes")) {}

node_tree tree_cutter::cut(const binary_tree& tree, leaf_rule leaves) {
  const std::uint32_t count = tree.count;
  if (count <= leaves.sure)
    return {runtime::buffer<Node>(1), tree.order, 0, FACET_LEAF(0u, count), 0};
  runtime::buffer<std::uint32_t> numbers(count - 1);
  const std::uint32_t none = 0;
  runtime::buffer<std::uint32_t> total(&none, 1);
  queue_.submit([&](runtime::handler& h) {
    const runtime::accessor in{tree.nodes, h, runtime::read_only};
    const runtime::accessor out{numbers, h, runtime::write_only};
    const runtime::accessor sum{total, h, runtime::read_write};
    h.set_args(in, out, sum, count, leaves.sure, leaves.most, run);
    h.parallel_for(padded((count + run - 1) / run, 1), number_nodes_);
  });
  node_tree to{runtime::buffer<Node>(1), tree.order, 0, FACET_LEAF(0u, count), tree.depth};
  const std::uint32_t root = runtime::host_accessor{numbers, runtime::read_only}[tree.root - count];
  if (root == FACET_NONE) return to;
  to.root = root;
  to.node_count = runtime::host_accessor{total, runtime::read_only}[0];
  to.nodes = runtime::buffer<Node>(to.node_count);
  queue_.submit([&](runtime::handler& h) {
    const runtime::accessor in{tree.nodes, h, runtime::read_only};
    const runtime::accessor number{numbers, h, runtime::read_only};
    const runtime::accessor out{to.nodes, h, runtime::write_only};
    h.set_args(in, number, out, count);
    h.parallel_for(padded(count, tuning_.group), cut_nodes_);
  });
  return to;
}

}  // namespace facet::tracer
