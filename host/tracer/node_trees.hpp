// Meshes' binary trees by any builder, with the leaves that a layout wants.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "runtime/runtime.hpp"
#include "tracer/cut_tree.hpp"
#include "tracer/levels.hpp"
#include "tracer/node_tree.hpp"
#include "tracer/pack.hpp"
#include "tracer/tracer.hpp"
#include "tracer/tree_builder.hpp"
#include "tracer/tuning.hpp"

namespace facet::tracer {

class node_trees {
 public:
  /// kind: not tree_kind::none.
  node_trees(const runtime::queue& q, const runtime::source_tree& kernels, const tuning& t,
             tree_kind kind, leaf_rule leaves);

  /// Over the triangles at corners[3i..3i+2], i < count; count > 0.
  node_tree over_triangles(runtime::buffer<texel>& corners, std::uint32_t count);
  /// A caller's tree over those triangles. Throws runtime::exception (invalid) if it is none.
  node_tree from(const given_tree& given, std::span<const texel> corners);

  /// Device memory that over_triangles takes at its peak, the corners apart; what it gives
  /// included.
  static std::uint64_t scratch_bytes(std::uint64_t triangles, tree_kind kind);

  double compile_ms() const;

 private:
  leaf_rule leaves_;
  std::optional<levels_builder> levels_;
  std::optional<tree_builder<texel>> binned_;
  tree_cutter cut_;
};

}  // namespace facet::tracer
