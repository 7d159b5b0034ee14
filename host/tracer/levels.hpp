// The builder `levels`: centres -> Morton codes -> radix sort -> merge bottom-up, level by level.
#pragma once

#include "runtime/runtime.hpp"
#include "tracer/binary_tree.hpp"
#include "tracer/morton.hpp"
#include "tracer/radix_sort.hpp"
#include "tracer/tuning.hpp"

namespace facet::tracer {

class levels_builder {
 public:
  levels_builder(runtime::queue q, const runtime::source_tree& kernels, const tuning& t);

  /// The tree over the first `count` > 0 boxes; finite ones. The same tree on every run and device.
  /// Its depth is at most 32 + ceil(log2 count) (cl/levels.cl).
  binary_tree build(runtime::buffer<Box>& boxes, std::uint32_t count);

  /// The boxes of the triangles at corners[3i .. 3i+2], i < count.
  runtime::buffer<Box> boxes_of(runtime::buffer<texel>& corners, std::uint32_t count);

  /// Device memory that boxes_of and build take at their peak: boxes, codes and order with their
  /// sorting copies, tree nodes, subtree ends, level lists.
  static std::uint64_t scratch_bytes(std::uint64_t primitives) {
    return primitives * (sizeof(Box) + 2 * sizeof(TreeNode) + 40);
  }

  double compile_ms() const;

 private:
  runtime::queue queue_;
  tuning tuning_;
  morton<Box> morton_;
  radix_sort<std::uint32_t> sort_codes_;
  radix_sort<std::uint32_t> sort_levels_;
  runtime::program program_;
  runtime::kernel triangle_boxes_, boundary_levels_, level_starts_, make_leaves_, merge_level_,
      tree_root_;
};

}  // namespace facet::tracer
