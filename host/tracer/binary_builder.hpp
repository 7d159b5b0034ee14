// Binary trees, built on the device: what every layout is made from.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/runtime.hpp"
#include "tracer/binary_tree.hpp"
#include "tracer/levels.hpp"
#include "tracer/morton.hpp"
#include "tracer/pack.hpp"
#include "tracer/tuning.hpp"

namespace facet::tracer {

class binary_builder {
 public:
  binary_builder(runtime::queue& q, const runtime::source_tree& kernels, const tuning& t);

  /// Over the triangles at corners[3i..3i+2], i < count; count > 0.
  binary_tree over_triangles(runtime::buffer<texel>& corners, std::uint32_t count);
  /// Over the bounds of placed meshes, at least one.
  binary_tree over_instances(const std::vector<Instance>& placed);

  /// Device memory that over_triangles takes at its peak, the corners apart: boxes, codes and order
  /// with their sorting copies, tree nodes, subtree ends, level lists.
  static std::uint64_t scratch_bytes(std::uint64_t triangles) {
    return triangles * (sizeof(Box) + 2 * sizeof(TreeNode) + 48);
  }

  double compile_ms() const { return levels_.compile_ms(); }

 private:
  levels_builder levels_;
};

}  // namespace facet::tracer
