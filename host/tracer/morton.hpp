// Boxes of triangles, and Morton codes of the boxes' centres.
#pragma once

#include <cstdint>

#include "runtime/runtime.hpp"
#include "tracer/layout.hpp"
#include "tracer/pack.hpp"
#include "tracer/tuning.hpp"

namespace facet::tracer {

class morton {
 public:
  morton(runtime::queue q, const runtime::source_tree& kernels, const tuning& t);

  /// boxes[i] for the triangle at corners[3i..3i+2], i < count.
  void triangle_boxes(runtime::buffer<texel>& corners, runtime::buffer<Box>& boxes,
                      std::uint32_t count);

  /// 63-bit codes of the centres, on the smallest cube that holds them, and order[i] = i.
  void codes(runtime::buffer<Box>& boxes, runtime::buffer<std::uint64_t>& codes,
             runtime::buffer<std::uint32_t>& order, std::uint32_t count);

  double compile_ms() const { return program_.build_ms(); }

 private:
  runtime::queue queue_;
  tuning tuning_;
  runtime::program program_;
  runtime::kernel triangle_boxes_, partial_bounds_, total_bounds_, codes_;
};

}  // namespace facet::tracer
