#include "tracer/subtrees.hpp"

#include "tracer/kernels.hpp"
#include "tracer/launch.hpp"

namespace facet::tracer {
namespace {

constexpr std::uint32_t each_alone = 1024;  // cl/subtrees.cl: EACH, where nothing is said

}  // namespace

subtrees::subtrees(const runtime::queue& q, const runtime::source_tree& kernels, const tuning& t)
    : queue_(q),
      group_(t.list_group),
      each_(t.orders_alone() ? each_alone : t.list_each),
      scan_group_(t.scan_group),
      program_(t.orders_alone()
                   ? compiled(q, kernels, order_file, t.flags())
                   : compiled(q, kernels, "subtrees.cl",
                              t.flags() + " -DEACH=" + std::to_string(t.list_each) + "u")),
      mark_(program_.get_kernel(t.list_group > 1 ? "mark_subtrees" : "mark_subtrees_alone")),
      scan_(program_.get_kernel("scan_tiles")),
      list_(program_.get_kernel("list_subtrees")) {}

std::uint32_t subtrees::list(runtime::buffer<std::uint32_t>& codes, std::uint32_t count,
                             std::vector<step>& steps) {
  const std::uint32_t tile = each_ * group_, words = tile / 32;
  const std::uint32_t tiles = (count + tile - 1) / tile;
  hold(counts_, tiles);
  hold(marks_, std::size_t(tiles) * words);
  steps.push_back(
      {"mark_subtrees", queue_.submit([&](runtime::handler& h) {
         const runtime::accessor in{codes, h, runtime::read_only};
         const runtime::accessor marks{marks_, h, runtime::write_only};
         const runtime::accessor out{counts_, h, runtime::write_only};
         h.set_args(in, marks, out, count);
         if (group_ > 1) {
           h.set_arg(4, runtime::local_accessor<std::uint8_t>(tile + 2 * FACET_SWEEP_MOST, h));
           h.set_arg(5, runtime::local_accessor<std::uint32_t>(words, h));
         }
         h.parallel_for(in_groups(tiles, group_), mark_);
       })});
  steps.push_back({"scan_tiles", queue_.submit([&](runtime::handler& h) {
                     const runtime::accessor counts{counts_, h, runtime::read_write};
                     const runtime::accessor total{total_, h, runtime::write_only};
                     const runtime::local_accessor<std::uint32_t> sums(scan_group_, h);
                     h.set_args(counts, total, tiles, sums);
                     h.parallel_for(in_groups(1, scan_group_), scan_);
                   })});
  std::uint32_t found = 0;
  {
    const runtime::host_accessor total{total_, runtime::read_only};
    found = total[0];
  }
  hold(starts_, std::size_t(found) + 1);
  steps.push_back({"list_subtrees", queue_.submit([&](runtime::handler& h) {
                     const runtime::accessor marks{marks_, h, runtime::read_only};
                     const runtime::accessor counts{counts_, h, runtime::read_only};
                     const runtime::accessor total{total_, h, runtime::read_only};
                     const runtime::accessor out{starts_, h, runtime::write_only};
                     const runtime::local_accessor<std::uint32_t> sums(words, h);
                     h.set_args(marks, counts, total, out, count, sums);
                     h.parallel_for(in_groups(tiles, words), list_);
                   })});
  return found;
}

}  // namespace facet::tracer
