// The tree over finished subtrees, from the root down (cl/top.cl, cl/serial_tree.cl).
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "runtime/runtime.hpp"
#include "tracer/bottoms.hpp"
#include "tracer/program_set.hpp"

namespace facet::tracer {

class top_tree {
 public:
  top_tree(const runtime::queue& q, const runtime::source_tree& kernels, const tuning& t);

  /// Writes parts.nodes[0 .. count - 2], the root first; count > 1 items, whose order is lost.
  /// Returns the nodes on the longest way down, those of the items included. Waits for the device.
  std::uint32_t build(runtime::buffer<Curve>& curve, tree_parts& parts, std::uint32_t count,
                      std::vector<step>& steps);

  static std::uint64_t scratch_bytes(std::uint64_t count);
  void add_programs(program_set& to) const { to.add(program_); }

 private:
  std::uint32_t build_serial(runtime::buffer<Curve>& curve, tree_parts& parts, std::uint32_t count,
                             std::vector<step>& steps);
  std::uint32_t told(std::uint32_t counter);
  void hold_room(std::uint32_t count);
  void start(runtime::buffer<Curve>& curve, std::uint32_t count, std::uint32_t is_tiled,
             std::vector<step>& steps);
  void split_tiles(tree_parts& parts, std::uint32_t count, std::uint32_t level,
                   std::uint32_t is_tiled, std::vector<step>& steps);
  void split_level(tree_parts& parts, std::uint32_t count, std::uint32_t level,
                   std::vector<step>& steps);
  void finish(tree_parts& parts, std::uint32_t ranges, std::vector<step>& steps);

  runtime::queue queue_;
  bool is_serial_;
  std::uint32_t split_group_;
  std::uint32_t open_;  ///< ranges that a CPU's cores are to share
  runtime::program program_;
  std::optional<runtime::kernel> serial_, start_, bin_, move_, list_, split_, finish_;
  runtime::buffer<std::uint32_t> counters_{1};
  // Of a level and of the next, in turns.
  std::array<runtime::buffer<TopRange>, 2> ranges_;
  std::array<runtime::buffer<TopSides>, 2> sides_;
  std::array<runtime::buffer<std::uint32_t>, 2> tiles_, bins_;
  runtime::buffer<TopRange> small_{1};
  runtime::buffer<Item> moved_{1};
};

}  // namespace facet::tracer
