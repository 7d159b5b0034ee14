#include "tracer/bottoms.hpp"

#include <bit>

#include "tracer/kernels.hpp"
#include "tracer/launch.hpp"
#include "tracer/morton.hpp"

namespace facet::tracer {

std::string leaf_options(leaf_rule leaves, bool in_order) {
  return " -DLEAF_SURE=" + std::to_string(leaves.sure) +
         "u -DLEAF_MOST=" + std::to_string(leaves.most) +
         "u -DLEAF_BLOCK=" + std::to_string(leaves.block) + "u" +
         (in_order ? " -DFACET_IN_ORDER" : "");
}

void set_leaf_triangles(runtime::handler& h, std::uint32_t k, const leaf_triangles& sorted) {
  h.set_arg(k++, runtime::accessor{sorted.materials, h, runtime::read_only});
  h.set_arg(k++, runtime::accessor{sorted.corners, h, runtime::read_write});
  h.set_arg(k++, runtime::accessor{sorted.infos, h, runtime::read_write});
  h.set_arg(k++, sorted.slot);
}

template <class Primitive>
bottoms<Primitive>::bottoms(const runtime::queue& q, const runtime::source_tree& kernels,
                            const tuning& t, leaf_rule leaves, bool in_order)
    : queue_(q),
      leaves_(leaves),
      is_serial_(t.serial_trees),
      pieces_(t.sort.tiles),
      program_(t.serial_trees ? compiled(q, kernels, serial_file, t.flags())
                              : compiled(q, kernels, "bottom.cl",
                                         t.flags() + primitive_options<Primitive>() +
                                             leaf_options(leaves, in_order))),
      build_(program_.get_kernel("build_bottoms")) {}

template <class Primitive>
void bottoms<Primitive>::build(runtime::buffer<Primitive>& primitives,
                               runtime::buffer<std::uint32_t>& starts, std::uint32_t subtrees,
                               runtime::buffer<std::uint32_t>& order, tree_parts& parts,
                               std::uint32_t first_node, const leaf_triangles* sorted,
                               std::vector<step>& steps) {
  queue_.submit([&](runtime::handler& h) {
    h.fill(runtime::accessor{counter_, h, runtime::write_only}, first_node);
  });
  steps.push_back({"build_bottoms", queue_.submit([&](runtime::handler& h) {
                     const runtime::accessor from{primitives, h, runtime::read_only};
                     const runtime::accessor at{starts, h, runtime::read_only};
                     const runtime::accessor places{order, h, runtime::read_write};
                     const runtime::accessor nodes{parts.nodes, h, runtime::read_write};
                     const runtime::accessor items{parts.items, h, runtime::write_only};
                     const runtime::accessor refs{parts.refs, h, runtime::write_only};
                     const runtime::accessor counter{counter_, h, runtime::read_write};
                     const auto room = std::uint32_t(parts.nodes.size());
                     if (is_serial_) {
                       const std::uint32_t each = (subtrees + pieces_ - 1) / pieces_;
                       const auto block_bit = std::uint32_t(std::countr_zero(leaves_.block));
                       h.set_args(from, primitive_rows<Primitive>, at, places, nodes, items, refs,
                                  counter, room, subtrees, each, leaves_.sure, leaves_.most,
                                  block_bit);
                       h.parallel_for(in_groups((subtrees + each - 1) / each, 1), build_);
                     } else {
                       const runtime::local_accessor<std::uint32_t> pool(FACET_SWEEP_WORDS, h);
                       h.set_args(from, at, places, nodes, items, refs, counter, room);
                       if (sorted) set_leaf_triangles(h, 8, *sorted);
                       h.set_arg(sorted ? 12 : 8, pool);
                       h.parallel_for(in_groups(subtrees, FACET_SWEEP_MOST), build_);
                     }
                   })});
}

template <class Primitive>
std::uint32_t bottoms<Primitive>::nodes() {
  const runtime::host_accessor made{counter_, runtime::read_only};
  return made[0];
}

template class bottoms<texel>;
template class bottoms<Box>;

}  // namespace facet::tracer
