#include "tracer/levels.hpp"

#include "tracer/kernels.hpp"
#include "tracer/launch.hpp"
#include "tracer/morton.hpp"

namespace facet::tracer {
namespace {

/// The first arguments of what joins items; how many they are.
std::uint32_t set_items(runtime::handler& h, const sorted_places& places, tree_parts& parts) {
  std::uint32_t k = 0;
  h.set_arg(k++, runtime::accessor{places.codes, h, runtime::read_only});
  h.set_arg(k++, runtime::accessor{places.starts, h, runtime::read_only});
  h.set_arg(k++, runtime::accessor{parts.items, h, runtime::read_write});
  h.set_arg(k++, runtime::accessor{parts.refs, h, runtime::read_write});
  h.set_arg(k++, runtime::accessor{parts.nodes, h, runtime::read_write});
  return k;
}

}  // namespace

template <class Primitive>
levels<Primitive>::levels(const runtime::queue& q, const runtime::source_tree& kernels,
                          const tuning& t, leaf_rule leaves, bool in_order)
    : queue_(q),
      is_serial_(t.serial_trees),
      group_(t.group),
      pieces_(t.sort.tiles),
      program_(compiled(q, kernels, t.serial_trees ? "serial_levels.cl" : "levels.cl",
                        t.flags() + primitive_options<Primitive>() +
                            leaf_options(leaves, in_order) + (t.warps ? " -DFACET_PTX" : ""))),
      subtrees_(program_.get_kernel("merge_subtrees")),
      items_(program_.get_kernel(t.serial_trees ? "merge_runs" : "merge_items")),
      loose_(program_.get_kernel(t.serial_trees ? "merge_loose" : "merge_items")) {}

template <class Primitive>
built_root levels<Primitive>::build(runtime::buffer<Primitive>& primitives,
                                    const sorted_places& places, tree_parts& parts,
                                    const leaf_triangles* sorted, std::vector<step>& steps) {
  queue_.submit([&](runtime::handler& h) {
    h.fill(runtime::accessor{told_, h, runtime::write_only}, places.subtrees - 1);
  });
  merge_subtrees(primitives, places, parts, sorted, steps);
  if (places.subtrees > 1 && is_serial_) merge_serially(places, parts, steps);
  if (places.subtrees > 1 && !is_serial_) merge_items(places, parts, steps);
  const runtime::host_accessor told{told_, runtime::read_only};
  if (places.subtrees > 1) return {told[0], told[1], told[2]};
  const runtime::host_accessor refs{parts.refs, runtime::read_only};
  const runtime::host_accessor items{parts.items, runtime::read_only};
  return {told[0], refs[0], items[0].size >> FACET_HEIGHT_BIT};
}

template <class Primitive>
void levels<Primitive>::merge_subtrees(runtime::buffer<Primitive>& primitives,
                                       const sorted_places& places, tree_parts& parts,
                                       const leaf_triangles* sorted, std::vector<step>& steps) {
  steps.push_back({"merge_subtrees", queue_.submit([&](runtime::handler& h) {
                     const runtime::accessor from{primitives, h, runtime::read_only};
                     const runtime::accessor codes{places.codes, h, runtime::read_only};
                     const runtime::accessor starts{places.starts, h, runtime::read_only};
                     const runtime::accessor order{places.order, h, runtime::read_only};
                     const runtime::accessor nodes{parts.nodes, h, runtime::write_only};
                     const runtime::accessor items{parts.items, h, runtime::write_only};
                     const runtime::accessor refs{parts.refs, h, runtime::write_only};
                     const runtime::accessor told{told_, h, runtime::read_write};
                     const auto room = std::uint32_t(parts.nodes.size());
                     if (is_serial_) {
                       const std::uint32_t run = each(places.subtrees);
                       h.set_args(from, codes, starts, order, nodes, items, refs, told,
                                  places.count, room, places.subtrees, run);
                       h.parallel_for(in_groups((places.subtrees + run - 1) / run, 1), subtrees_);
                     } else {
                       const runtime::local_accessor<std::uint32_t> pool(FACET_MERGE_WORDS, h);
                       h.set_args(from, codes, starts, order, nodes, items, refs, told,
                                  places.count, room);
                       if (sorted) set_leaf_triangles(h, 10, *sorted);
                       h.set_arg(sorted ? 14 : 10, pool);
                       h.parallel_for(in_groups(places.subtrees, FACET_SWEEP_MOST), subtrees_);
                     }
                   })});
}

template <class Primitive>
void levels<Primitive>::merge_items(const sorted_places& places, tree_parts& parts,
                                    std::vector<step>& steps) {
  hold(ends_, places.subtrees - 1);
  queue_.submit([&](runtime::handler& h) {
    h.fill(runtime::accessor{ends_, h, runtime::write_only}, FACET_NONE);
  });
  steps.push_back({"merge_items", queue_.submit([&](runtime::handler& h) {
                     std::uint32_t k = set_items(h, places, parts);
                     const runtime::accessor ends{ends_, h, runtime::read_write};
                     const runtime::accessor told{told_, h, runtime::read_write};
                     h.set_arg(k++, ends);
                     h.set_arg(k++, told);
                     h.set_arg(k++, places.count);
                     h.set_arg(k++, places.subtrees);
                     h.parallel_for(padded(places.subtrees, group_), items_);
                   })});
}

template <class Primitive>
void levels<Primitive>::merge_serially(const sorted_places& places, tree_parts& parts,
                                       std::vector<step>& steps) {
  const std::uint32_t run = each(places.subtrees), runs = (places.subtrees + run - 1) / run;
  hold(ends_, runs);
  steps.push_back({"merge_runs", queue_.submit([&](runtime::handler& h) {
                     std::uint32_t k = set_items(h, places, parts);
                     const runtime::accessor loose{ends_, h, runtime::write_only};
                     h.set_arg(k++, loose);
                     h.set_arg(k++, places.count);
                     h.set_arg(k++, places.subtrees);
                     h.set_arg(k++, run);
                     h.parallel_for(in_groups(runs, 1), items_);
                   })});
  steps.push_back({"merge_loose", queue_.submit([&](runtime::handler& h) {
                     std::uint32_t k = set_items(h, places, parts);
                     const runtime::accessor loose{ends_, h, runtime::read_only};
                     const runtime::accessor told{told_, h, runtime::read_write};
                     h.set_arg(k++, loose);
                     h.set_arg(k++, told);
                     h.set_arg(k++, places.count);
                     h.set_arg(k++, places.subtrees);
                     h.set_arg(k++, run);
                     h.parallel_for(in_groups(1, 1), loose_);
                   })});
}

template class levels<texel>;
template class levels<Box>;

}  // namespace facet::tracer
