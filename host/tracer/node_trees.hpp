// Meshes' binary trees by any builder, with the leaves that a layout wants.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "runtime/runtime.hpp"
#include "tracer/cut_tree.hpp"
#include "tracer/node_tree.hpp"
#include "tracer/pack.hpp"
#include "tracer/tracer.hpp"
#include "tracer/tree_builder.hpp"
#include "tracer/tuning.hpp"

namespace facet::tracer {

class node_trees {
 public:
  /// kind: not tree_kind::none. in_order: triangles are put into leaf order, too. `kernels` outlive
  /// this.
  node_trees(const runtime::queue& q, const runtime::source_tree& kernels, const tuning& t,
             tree_kind kind, leaf_rule leaves, bool in_order = false);

  /// Compiles what trees over so many triangles take (tree_builder.hpp).
  void prepare(std::uint32_t triangles) { over_triangles_.prepare(triangles); }

  /// Over the triangles at corners[3i..3i+2], i < count; count > 0.
  /// sorted: given if they are put into order.
  node_tree over_triangles(runtime::buffer<texel>& corners, std::uint32_t count,
                           const leaf_triangles* sorted = nullptr);
  /// A caller's tree over those triangles. Throws runtime::exception (invalid) if it is none.
  node_tree from(const given_tree& given, std::span<const texel> corners);

  /// Device memory that over_triangles takes at its peak, the corners apart; what it gives
  /// included.
  static std::uint64_t scratch_bytes(std::uint64_t triangles) {
    return tree_builder<texel>::scratch_bytes(triangles);
  }

  void add_programs(program_set& to) const;

 private:
  runtime::queue queue_;
  const runtime::source_tree& kernels_;
  tuning tuning_;
  leaf_rule leaves_;
  tree_builder<texel> over_triangles_;
  std::optional<tree_cutter> cut_;  ///< once a tree is given
};

}  // namespace facet::tracer
