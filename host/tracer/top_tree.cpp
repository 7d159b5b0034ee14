#include "tracer/top_tree.hpp"

#include <algorithm>
#include <bit>

#include "tracer/kernels.hpp"
#include "tracer/launch.hpp"
#include "tracer/morton.hpp"

namespace facet::tracer {
namespace {

constexpr std::uint32_t large = 4096;  ///< items that one group does not split alone

/// Levels at which ranges may be large, if splits are not too uneven; it costs time alone if some
/// are large at others.
std::uint32_t tiled_levels(std::uint32_t count) {
  return count <= large ? 0 : std::uint32_t(std::bit_width((count - 1) / large)) + 1;
}
/// Ranges that are split at a level, at most.
std::uint32_t most_ranges(std::uint32_t count, std::uint32_t level) {
  const std::uint32_t all = count / (FACET_SWEEP_MOST + 1) + 1;
  return level < 31 ? std::min(1u << level, all) : all;
}
std::uint32_t most_tiles(std::uint32_t count, std::uint32_t level) {
  return count / FACET_TILE_ITEMS + most_ranges(count, level);
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
      split_group_(t.split_group),
      open_(4 * std::uint32_t(q.get_device().max_compute_units())),
      program_(is_serial_
                   ? compiled(q, kernels, serial_file, t.flags())
                   : compiled(q, kernels, "top.cl",
                              t.flags() + " -DSPLIT_GROUP=" + std::to_string(t.split_group) + "u")),
      ranges_(two<TopRange>()),
      sides_(two<TopSides>()),
      tiles_(two<std::uint32_t>()),
      bins_(two<std::uint32_t>()) {
  if (is_serial_) {
    serial_ = program_.get_kernel("build_top");
    return;
  }
  start_ = program_.get_kernel("start_top");
  bin_ = program_.get_kernel("bin_tiles");
  move_ = program_.get_kernel("move_tiles");
  list_ = program_.get_kernel("list_ranges");
  split_ = program_.get_kernel("split_ranges");
  finish_ = program_.get_kernel("finish_ranges");
}

std::uint64_t top_tree::scratch_bytes(std::uint64_t items) {
  const auto count = std::uint32_t(items);
  const std::uint32_t tiled = tiled_levels(count);
  const std::uint64_t ranges = most_ranges(count, 31), tiled_ranges = most_ranges(count, tiled);
  return items * sizeof(Item) + (count / 2 + 1) * sizeof(TopRange) + 2 * ranges * sizeof(TopRange) +
         2 * tiled_ranges * (sizeof(TopSides) + 4 * FACET_ALL_BIN_WORDS) +
         16 * most_tiles(count, tiled);
}

std::uint32_t top_tree::build(runtime::buffer<Curve>& curve, tree_parts& parts, std::uint32_t count,
                              std::vector<step>& steps) {
  if (is_serial_) return build_serial(curve, parts, count, steps);
  hold_room(count);
  const std::uint32_t tiled = tiled_levels(count);
  start(curve, count, tiled > 0, steps);
  // So many levels there are if all splits are even, and some more; then one asks.
  std::uint32_t level = 0;
  std::uint32_t levels =
      count <= FACET_SWEEP_MOST ? 0 : std::uint32_t(std::bit_width(count / FACET_SWEEP_MOST)) + 3;
  for (;;) {
    for (; level < levels; ++level)
      if (level < tiled)
        split_tiles(parts, count, level, level + 1 < tiled, steps);
      else
        split_level(parts, count, level, steps);
    if (level == 0 || told(FACET_LEVEL_WORDS * level) == 0) break;
    levels += 4;
  }
  finish(parts, told(FACET_TOTALS), steps);
  return told(FACET_TOTALS + 1);
}

std::uint32_t top_tree::told(std::uint32_t counter) {
  const runtime::host_accessor all{counters_, runtime::read_only};
  return all[counter];
}

std::uint32_t top_tree::build_serial(runtime::buffer<Curve>& curve, tree_parts& parts,
                                     std::uint32_t count, std::vector<step>& steps) {
  hold(counters_, 2);
  hold(ranges_[0], open_);
  for (std::uint32_t step = 0; step < 2; ++step)
    steps.push_back({"build_top", queue_.submit([&](runtime::handler& h) {
                       const runtime::accessor items{parts.items, h, runtime::read_write};
                       const runtime::accessor along{curve, h, runtime::read_only};
                       const runtime::accessor nodes{parts.nodes, h, runtime::read_write};
                       const runtime::accessor refs{parts.refs, h, runtime::read_only};
                       const runtime::accessor ranges{ranges_[0], h, runtime::read_write};
                       const runtime::accessor counter{counters_, h, runtime::read_write};
                       h.set_args(items, along, nodes, refs, ranges, counter, count, open_, step);
                       h.parallel_for(in_groups(step == 0 ? 1 : open_, 1), *serial_);
                     })});
  return told(1);
}

void top_tree::hold_room(std::uint32_t count) {
  const std::uint32_t tiled = tiled_levels(count), tiled_ranges = most_ranges(count, tiled);
  hold(counters_, FACET_TOTALS + 2);
  hold_both(ranges_, most_ranges(count, 31));
  hold_both(sides_, tiled_ranges);
  hold_both(tiles_, 2 * std::size_t(most_tiles(count, tiled)));
  hold_both(bins_, std::size_t(tiled_ranges) * FACET_ALL_BIN_WORDS);
  hold(small_, count / 2 + 1);
  hold(moved_, count);
}

void top_tree::start(runtime::buffer<Curve>& curve, std::uint32_t count, std::uint32_t is_tiled,
                     std::vector<step>& steps) {
  steps.push_back({"start_top", queue_.submit([&](runtime::handler& h) {
                     const runtime::accessor along{curve, h, runtime::read_only};
                     const runtime::accessor ranges{ranges_[0], h, runtime::write_only};
                     const runtime::accessor tiles{tiles_[0], h, runtime::write_only};
                     const runtime::accessor sides{sides_[0], h, runtime::write_only};
                     const runtime::accessor bins{bins_[0], h, runtime::write_only};
                     const runtime::accessor small{small_, h, runtime::write_only};
                     const runtime::accessor counters{counters_, h, runtime::read_write};
                     h.set_args(along, ranges, tiles, sides, bins, small, counters, count,
                                is_tiled);
                     h.parallel_for(in_groups(1, FACET_TOP_GROUP), *start_);
                   })});
}

void top_tree::split_tiles(tree_parts& parts, std::uint32_t count, std::uint32_t level,
                           std::uint32_t is_tiled, std::vector<step>& steps) {
  const std::uint32_t now = level % 2, next = 1 - now;
  auto& from = now == 0 ? parts.items : moved_;
  auto& to = now == 0 ? moved_ : parts.items;
  const auto groups = in_groups(most_tiles(count, level), FACET_TOP_GROUP);
  steps.push_back({"bin_tiles", queue_.submit([&](runtime::handler& h) {
                     const runtime::accessor items{from, h, runtime::read_only};
                     const runtime::accessor ranges{ranges_[now], h, runtime::read_only};
                     const runtime::accessor tiles{tiles_[now], h, runtime::read_only};
                     const runtime::accessor bins{bins_[now], h, runtime::read_write};
                     const runtime::accessor counters{counters_, h, runtime::read_only};
                     const runtime::local_accessor<std::uint32_t> own(FACET_ALL_BIN_WORDS, h);
                     h.set_args(items, ranges, tiles, bins, counters, level, own);
                     h.parallel_for(groups, *bin_);
                   })});
  steps.push_back({"move_tiles", queue_.submit([&](runtime::handler& h) {
                     const runtime::accessor items{from, h, runtime::read_only};
                     const runtime::accessor moved{to, h, runtime::write_only};
                     const runtime::accessor ranges{ranges_[now], h, runtime::read_only};
                     const runtime::accessor tiles{tiles_[now], h, runtime::read_only};
                     const runtime::accessor bins{bins_[now], h, runtime::read_only};
                     const runtime::accessor sides{sides_[now], h, runtime::read_write};
                     const runtime::accessor counters{counters_, h, runtime::read_only};
                     const runtime::local_accessor<std::uint32_t> pool(FACET_SPLIT_WORDS, h);
                     h.set_args(items, moved, ranges, tiles, bins, sides, counters, level, pool);
                     h.parallel_for(groups, *move_);
                   })});
  steps.push_back({"list_ranges", queue_.submit([&](runtime::handler& h) {
                     const runtime::accessor moved{to, h, runtime::read_only};
                     const runtime::accessor ranges{ranges_[now], h, runtime::read_only};
                     const runtime::accessor sides{sides_[now], h, runtime::read_only};
                     const runtime::accessor next_ranges{ranges_[next], h, runtime::write_only};
                     const runtime::accessor next_tiles{tiles_[next], h, runtime::write_only};
                     const runtime::accessor next_sides{sides_[next], h, runtime::write_only};
                     const runtime::accessor next_bins{bins_[next], h, runtime::write_only};
                     const runtime::accessor small{small_, h, runtime::write_only};
                     const runtime::accessor nodes{parts.nodes, h, runtime::read_write};
                     const runtime::accessor refs{parts.refs, h, runtime::read_only};
                     const runtime::accessor counters{counters_, h, runtime::read_write};
                     h.set_args(moved, ranges, sides, next_ranges, next_tiles, next_sides,
                                next_bins, small, nodes, refs, counters, level, is_tiled);
                     h.parallel_for(padded(most_ranges(count, level), 64), *list_);
                   })});
}

void top_tree::split_level(tree_parts& parts, std::uint32_t count, std::uint32_t level,
                           std::vector<step>& steps) {
  const std::uint32_t now = level % 2, next = 1 - now;
  auto& from = now == 0 ? parts.items : moved_;
  auto& to = now == 0 ? moved_ : parts.items;
  steps.push_back({"split_ranges", queue_.submit([&](runtime::handler& h) {
                     const runtime::accessor items{from, h, runtime::read_only};
                     const runtime::accessor moved{to, h, runtime::read_write};
                     const runtime::accessor ranges{ranges_[now], h, runtime::read_only};
                     const runtime::accessor next_ranges{ranges_[next], h, runtime::write_only};
                     const runtime::accessor small{small_, h, runtime::write_only};
                     const runtime::accessor nodes{parts.nodes, h, runtime::read_write};
                     const runtime::accessor refs{parts.refs, h, runtime::read_only};
                     const runtime::accessor counters{counters_, h, runtime::read_write};
                     const runtime::local_accessor<std::uint32_t> pool(FACET_SPLIT_WORDS, h);
                     h.set_args(items, moved, ranges, next_ranges, small, nodes, refs, counters,
                                level, pool);
                     h.parallel_for(in_groups(most_ranges(count, level), split_group_), *split_);
                   })});
}

void top_tree::finish(tree_parts& parts, std::uint32_t ranges, std::vector<step>& steps) {
  if (ranges == 0) return;
  steps.push_back({"finish_ranges", queue_.submit([&](runtime::handler& h) {
                     const runtime::accessor even{parts.items, h, runtime::read_only};
                     const runtime::accessor odd{moved_, h, runtime::read_only};
                     const runtime::accessor small{small_, h, runtime::read_only};
                     const runtime::accessor nodes{parts.nodes, h, runtime::read_write};
                     const runtime::accessor refs{parts.refs, h, runtime::read_only};
                     const runtime::accessor counters{counters_, h, runtime::read_write};
                     const runtime::local_accessor<std::uint32_t> pool(FACET_SWEEP_WORDS, h);
                     h.set_args(even, odd, small, nodes, refs, counters, pool);
                     h.parallel_for(in_groups(ranges, FACET_SWEEP_MOST), *finish_);
                   })});
}

}  // namespace facet::tracer
