#include "tracer/morton.hpp"

#include <algorithm>

#include "tracer/kernels.hpp"
#include "tracer/launch.hpp"

namespace facet::tracer {
namespace {

/// Partial bounds: enough work-items for any device, few enough for one to total.
constexpr std::uint32_t partial_count = 1024;

}  // namespace

morton::morton(runtime::queue q, const runtime::source_tree& kernels, const tuning& t)
    : queue_(q),
      tuning_(t),
      program_(compiled(q, kernels, "morton.cl", t.flags())),
      triangle_boxes_(program_.get_kernel("triangle_boxes")),
      partial_bounds_(program_.get_kernel("partial_bounds")),
      total_bounds_(program_.get_kernel("total_bounds")),
      codes_(program_.get_kernel("morton_codes")) {}

void morton::triangle_boxes(runtime::buffer<texel>& corners, runtime::buffer<Box>& boxes,
                            std::uint32_t count) {
  queue_.submit([&](runtime::handler& h) {
    const runtime::accessor in{corners, h, runtime::read_only};
    const runtime::accessor out{boxes, h, runtime::write_only};
    h.set_args(in, out, count);
    h.parallel_for(padded(count, tuning_.group), triangle_boxes_);
  });
}

void morton::codes(runtime::buffer<Box>& boxes, runtime::buffer<std::uint64_t>& codes,
                   runtime::buffer<std::uint32_t>& order, std::uint32_t count) {
  const std::uint32_t group = std::min(tuning_.group, partial_count);
  const auto partial_range = padded(std::min(count, partial_count), group);
  runtime::buffer<Box> bounds(partial_range.get_global_range().size());
  queue_.submit([&](runtime::handler& h) {
    const runtime::accessor in{boxes, h, runtime::read_only};
    const runtime::accessor out{bounds, h, runtime::write_only};
    h.set_args(in, out, count);
    h.parallel_for(partial_range, partial_bounds_);
  });
  queue_.submit([&](runtime::handler& h) {
    const runtime::accessor all{bounds, h, runtime::read_write};
    h.set_args(all, std::uint32_t(bounds.size()));
    h.single_task(total_bounds_);
  });
  queue_.submit([&](runtime::handler& h) {
    const runtime::accessor in{boxes, h, runtime::read_only};
    const runtime::accessor total{bounds, h, runtime::read_only};
    const runtime::accessor codes_out{codes, h, runtime::write_only};
    const runtime::accessor order_out{order, h, runtime::write_only};
    h.set_args(in, total, codes_out, order_out, count);
    h.parallel_for(padded(count, tuning_.group), codes_);
  });
}

}  // namespace facet::tracer
