#include "tracer/refit.hpp"

#include <iterator>

#include "tracer/launch.hpp"
#include "tracer/refit_order.hpp"

namespace facet::tracer {
namespace {

runtime::buffer<std::uint32_t> uploaded(const std::vector<std::uint32_t>& from) {
  return {from.data(), from.size()};
}

template <runtime::access_mode M>
void set_nodes(runtime::handler& h, const device_geometry& g, runtime::mode_tag<M> mode) {
  if (g.is_wide)
    h.set_arg(0, runtime::accessor{g.wide_nodes, h, mode});
  else
    h.set_arg(0, runtime::accessor{g.nodes, h, mode});
}

}  // namespace

refitter::refitter(const runtime::queue& q, const runtime::source_tree& kernels, const tuning& t,
                   bool is_wide)
    : queue_(q),
      is_wide_(is_wide),
      group_(t.refit_group),
      most_(t.refit_nodes),
      program_(compiled(q, kernels, "refit.cl", t.flags() + (is_wide ? " -DFACET_WIDE" : ""))),
      list_children_(program_.get_kernel("list_children")),
      refit_treelets_(program_.get_kernel("refit_treelets")) {}

refit_plan refitter::plan(const device_geometry& g, const mesh_place& at) {
  if (at.nodes == 0) return {};
  const std::uint32_t width =
      std::uint32_t(is_wide_ ? std::size(WideNode{}.child) : std::size(Node{}.child));
  runtime::buffer<std::uint32_t> children(std::size_t(width) * at.nodes);
  queue_.submit([&](runtime::handler& h) {
    set_nodes(h, g, runtime::read_only);
    h.set_arg(1, runtime::accessor{children, h, runtime::write_only});
    h.set_arg(2, at.first_node);
    h.set_arg(3, at.nodes);
    h.parallel_for(padded(at.nodes, group_), list_children_);
  });
  const runtime::host_accessor read{children, runtime::read_only};
  refit_order order =
      order_for_refit({read.data(), read.size()}, width, at.root, at.first_node, most_);
  if (order.nodes.empty()) return {};
  return {uploaded(order.nodes), uploaded(order.starts), std::move(order.phases)};
}

void refitter::refit(const refit_plan& p, device_geometry& g, const mesh_place& at,
                     const runtime::buffer<texel>& corners) {
  for (std::size_t k = 0; k + 1 < p.phases.size(); ++k) {
    const std::uint32_t count = p.phases[k + 1] - p.phases[k];
    queue_.submit([&](runtime::handler& h) {
      set_nodes(h, g, runtime::read_write);
      h.set_arg(1, runtime::accessor{p.nodes, h, runtime::read_only});
      h.set_arg(2, runtime::accessor{p.starts, h, runtime::read_only});
      h.set_arg(3, runtime::accessor{corners, h, runtime::read_only});
      h.set_arg(4, at.first_node);
      h.set_arg(5, p.phases[k]);
      h.set_arg(6, count);
      h.parallel_for(padded(count, group_), refit_treelets_);
    });
  }
}

}  // namespace facet::tracer
