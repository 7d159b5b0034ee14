#include "tracer/top_tree.hpp"

#include <algorithm>
#include <bit>

#include "tracer/kernels.hpp"
#include "tracer/launch.hpp"

namespace facet::tracer {
namespace {

// As in cl/top.cl, cl/bins.h and cl/sweep.h.
constexpr std::uint32_t group = 256, tile_items = 1024, totals = 1024, level_words = 4;
constexpr std::uint32_t bin_words = 3 * 16 * 8, split_words = bin_words + 48 + 32 + 4;
constexpr std::uint32_t swept = 32, sweep_words = 820;

/// Ranges that are split at one level, and tiles of theirs, at most.
std::uint32_t most_ranges(std::uint32_t count) { return count / (swept + 1) + 1; }
std::uint32_t most_tiles(std::uint32_t count, std::uint32_t ranges) {
  return count / tile_items + ranges;
}

template <class T>
void hold_both(std::array<runtime::buffer<T>, 2>& both, std::size_t count) {
  for (auto& one : both) hold(one, count);
}

template <class T>
std::array<runtime::buffer<T>, 2> two() {
  return {runtime::buffer<T>(1), runtime::buffer<T>(1)};
}

}  // namespace

top_tree::top_tree(const runtime::queue& q, const runtime::source_tree& kernels, const tuning& t)
    : queue_(q),
      is_serial_(t.serial_trees),
      program_(compiled(q, kernels, t.serial_trees ? "serial_tree.cl" : "top.cl", t.flags())),
      serial_(program_.get_kernel(t.serial_trees ? "build_top" : "start_top")),
      start_(serial_),
      bin_(program_.get_kernel(t.serial_trees ? "build_top" : "bin_items")),
      split_(program_.get_kernel(t.serial_trees ? "build_top" : "split_ranges")),
      list_(program_.get_kernel(t.serial_trees ? "build_top" : "list_ranges")),
      finish_(program_.get_kernel(t.serial_trees ? "build_top" : "finish_ranges")),
      ranges_(two<TopRange>()),
      sides_(two<TopSides>()),
      tiles_(two<std::uint32_t>()),
      bins_(two<std::uint32_t>()) {}

std::uint64_t top_tree::scratch_bytes(std::uint64_t count) {
  const auto n = std::uint32_t(count);
  const std::uint64_t ranges = most_ranges(n);
  return count * sizeof(Item) + (n / 2 + 1) * sizeof(TopRange) +
         2 * (ranges * (sizeof(TopRange) + sizeof(TopSides)) + most_tiles(n, most_ranges(n)) * 8 +
              (n / tile_items + 1) * bin_words * 4);
}

std::uint32_t top_tree::build(runtime::buffer<Curve>& curve, tree_parts& parts, std::uint32_t count,
                              std::vector<sort_step>& steps) {
  if (is_serial_) return build_serial(curve, parts, count, steps);
  hold_room(count);
  start(curve, count, steps);
  // So many levels there are if all splits are even, and some more; then one asks.
  std::uint32_t level = 0, levels = count <= swept ? 0 : std::bit_width(count / swept) + 2;
  for (;;) {
    for (; level < levels; ++level) split_level(parts, count, level, steps);
    if (level == 0 || told(level_words * level) == 0) break;
    levels += 4;
  }
  finish(parts, told(totals), steps);
  return told(totals + 1);
}

std::uint32_t top_tree::told(std::uint32_t counter) {
  const runtime::host_accessor all{counters_, runtime::read_only};
  return all[counter];
}

std::uint32_t top_tree::build_serial(runtime::buffer<Curve>& curve, tree_parts& parts,
                                     std::uint32_t count, std::vector<sort_step>& steps) {
  hold(counters_, 2);
  steps.push_back({"build_top", queue_.submit([&](runtime::handler& h) {
                     const runtime::accessor items{parts.items, h, runtime::read_write};
                     const runtime::accessor along{curve, h, runtime::read_only};
                     const runtime::accessor nodes{parts.nodes, h, runtime::read_write};
                     const runtime::accessor refs{parts.refs, h, runtime::read_only};
                     const runtime::accessor counter{counters_, h, runtime::write_only};
                     h.set_args(items, along, nodes, refs, counter, count);
                     h.parallel_for(in_groups(1, 1), serial_);
                   })});
  return told(1);
}

void top_tree::hold_room(std::uint32_t count) {
  const std::uint32_t ranges = most_ranges(count);
  hold(counters_, totals + 2);
  hold_both(ranges_, ranges);
  hold_both(sides_, ranges);
  hold_both(tiles_, 2 * std::size_t(most_tiles(count, ranges)));
  hold_both(bins_, std::size_t(count / tile_items + 1) * bin_words);
  hold(small_, count / 2 + 1);
  hold(moved_, count);
}

void top_tree::start(runtime::buffer<Curve>& curve, std::uint32_t count,
                     std::vector<sort_step>& steps) {
  queue_.submit([&](runtime::handler& h) {
    h.fill(runtime::accessor{counters_, h, runtime::write_only}, 0u);
  });
  steps.push_back({"start_top", queue_.submit([&](runtime::handler& h) {
                     const runtime::accessor along{curve, h, runtime::read_only};
                     const runtime::accessor ranges{ranges_[0], h, runtime::write_only};
                     const runtime::accessor before{sides_[1], h, runtime::write_only};
                     const runtime::accessor sides{sides_[0], h, runtime::write_only};
                     const runtime::accessor tiles{tiles_[0], h, runtime::write_only};
                     const runtime::accessor bins{bins_[0], h, runtime::write_only};
                     const runtime::accessor small{small_, h, runtime::write_only};
                     const runtime::accessor counters{counters_, h, runtime::read_write};
                     h.set_args(along, ranges, before, sides, tiles, bins, small, counters, count);
                     h.parallel_for(in_groups(1, group), start_);
                   })});
}

void top_tree::split_level(tree_parts& parts, std::uint32_t count, std::uint32_t level,
                           std::vector<sort_step>& steps) {
  const std::uint32_t most =
      level < 31 ? std::min(1u << level, most_ranges(count)) : most_ranges(count);
  const std::uint32_t now = level % 2, next = 1 - now;
  auto& from = now == 0 ? parts.items : moved_;
  auto& to = now == 0 ? moved_ : parts.items;
  steps.push_back({"bin_items", queue_.submit([&](runtime::handler& h) {
                     const runtime::accessor items{from, h, runtime::read_only};
                     const runtime::accessor ranges{ranges_[now], h, runtime::read_only};
                     const runtime::accessor before{sides_[next], h, runtime::read_only};
                     const runtime::accessor tiles{tiles_[now], h, runtime::read_only};
                     const runtime::accessor bins{bins_[now], h, runtime::read_write};
                     const runtime::accessor counters{counters_, h, runtime::read_only};
                     const runtime::local_accessor<std::uint32_t> own(bin_words, h);
                     h.set_args(items, ranges, before, tiles, bins, counters, level, own);
                     h.parallel_for(in_groups(most_tiles(count, most), group), bin_);
                   })});
  steps.push_back({"split_ranges", queue_.submit([&](runtime::handler& h) {
                     const runtime::accessor items{from, h, runtime::read_only};
                     const runtime::accessor moved{to, h, runtime::write_only};
                     const runtime::accessor ranges{ranges_[now], h, runtime::read_only};
                     const runtime::accessor before{sides_[next], h, runtime::read_only};
                     const runtime::accessor sides{sides_[now], h, runtime::read_write};
                     const runtime::accessor tiles{tiles_[now], h, runtime::read_only};
                     const runtime::accessor bins{bins_[now], h, runtime::read_only};
                     const runtime::accessor counters{counters_, h, runtime::read_only};
                     const runtime::local_accessor<std::uint32_t> pool(split_words, h);
                     h.set_args(items, moved, ranges, before, sides, tiles, bins, counters, level,
                                pool);
                     h.parallel_for(in_groups(most_tiles(count, most), group), split_);
                   })});
  steps.push_back({"list_ranges", queue_.submit([&](runtime::handler& h) {
                     const runtime::accessor moved{to, h, runtime::read_only};
                     const runtime::accessor ranges{ranges_[now], h, runtime::read_only};
                     const runtime::accessor sides{sides_[now], h, runtime::read_only};
                     const runtime::accessor next_ranges{ranges_[next], h, runtime::write_only};
                     const runtime::accessor next_sides{sides_[next], h, runtime::write_only};
                     const runtime::accessor next_tiles{tiles_[next], h, runtime::write_only};
                     const runtime::accessor next_bins{bins_[next], h, runtime::write_only};
                     const runtime::accessor small{small_, h, runtime::write_only};
                     const runtime::accessor nodes{parts.nodes, h, runtime::read_write};
                     const runtime::accessor refs{parts.refs, h, runtime::read_only};
                     const runtime::accessor counters{counters_, h, runtime::read_write};
                     h.set_args(moved, ranges, sides, next_ranges, next_sides, next_tiles,
                                next_bins, small, nodes, refs, counters, level);
                     h.parallel_for(padded(most, 64), list_);
                   })});
}

void top_tree::finish(tree_parts& parts, std::uint32_t ranges, std::vector<sort_step>& steps) {
  if (ranges == 0) return;
  steps.push_back({"finish_ranges", queue_.submit([&](runtime::handler& h) {
                     const runtime::accessor even{parts.items, h, runtime::read_only};
                     const runtime::accessor odd{moved_, h, runtime::read_only};
                     const runtime::accessor small{small_, h, runtime::read_only};
                     const runtime::accessor nodes{parts.nodes, h, runtime::read_write};
                     const runtime::accessor refs{parts.refs, h, runtime::read_only};
                     const runtime::accessor counters{counters_, h, runtime::read_write};
                     const runtime::local_accessor<std::uint32_t> pool(sweep_words, h);
                     h.set_args(even, odd, small, nodes, refs, counters, pool);
                     h.parallel_for(in_groups(ranges, swept), finish_);
                   })});
}

}  // namespace facet::tracer
