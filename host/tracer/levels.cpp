#include "tracer/levels.hpp"

#include <array>
#include <vector>

#include "tracer/kernels.hpp"
#include "tracer/launch.hpp"

namespace facet::tracer {
namespace {

constexpr std::uint32_t level_count = 65;  ///< levels are 1 to 64 (cl/levels.cl)
constexpr unsigned level_bits = 7;

}  // namespace

levels_builder::levels_builder(runtime::queue q, const runtime::source_tree& kernels,
                               const tuning& t)
    : queue_(q),
      tuning_(t),
      morton_(q, kernels, t),
      sort_codes_(q, kernels, t),
      sort_levels_(q, kernels, t),
      program_(compiled(q, kernels, "levels.cl", t.flags())),
      triangle_boxes_(program_.get_kernel("triangle_boxes")),
      boundary_levels_(program_.get_kernel("boundary_levels")),
      level_starts_(program_.get_kernel("level_starts")),
      make_leaves_(program_.get_kernel("make_leaves")),
      merge_level_(program_.get_kernel("merge_level")),
      tree_root_(program_.get_kernel("tree_root")) {}

double levels_builder::compile_ms() const {
  return morton_.compile_ms() + sort_codes_.compile_ms() + sort_levels_.compile_ms() +
         program_.build_ms();
}

runtime::buffer<Box> levels_builder::boxes_of(runtime::buffer<texel>& corners,
                                              std::uint32_t count) {
  runtime::buffer<Box> boxes(count);
  queue_.submit([&](runtime::handler& h) {
    const runtime::accessor in{corners, h, runtime::read_only};
    const runtime::accessor out{boxes, h, runtime::write_only};
    h.set_args(in, out, count);
    h.parallel_for(padded(count, tuning_.group), triangle_boxes_);
  });
  return boxes;
}

binary_tree levels_builder::build(runtime::buffer<Box>& boxes, std::uint32_t count) {
  binary_tree tree{runtime::buffer<TreeNode>(2 * std::size_t(count) - 1),
                   runtime::buffer<std::uint32_t>(count), count, 0, 0};
  const std::uint32_t boundaries = count - 1;
  const auto range = padded(count, tuning_.group);

  runtime::buffer<std::uint32_t> codes(count);
  runtime::buffer<Curve> curve(1);
  std::vector<step> steps;
  morton_.codes(boxes, curve, codes, count, steps);
  sort_codes_.sort_order(codes, tree.order, count);

  runtime::buffer<std::uint32_t> begins(count), ends(count);
  queue_.submit([&](runtime::handler& h) {
    const runtime::accessor in{boxes, h, runtime::read_only};
    const runtime::accessor order{tree.order, h, runtime::read_only};
    const runtime::accessor nodes{tree.nodes, h, runtime::write_only};
    const runtime::accessor b{begins, h, runtime::write_only};
    const runtime::accessor e{ends, h, runtime::write_only};
    h.set_args(in, order, nodes, b, e, count);
    h.parallel_for(range, make_leaves_);
  });
  if (count == 1) return tree;

  runtime::buffer<std::uint32_t> levels(boundaries), order(boundaries);
  queue_.submit([&](runtime::handler& h) {
    const runtime::accessor in{codes, h, runtime::read_only};
    const runtime::accessor levels_out{levels, h, runtime::write_only};
    const runtime::accessor order_out{order, h, runtime::write_only};
    h.set_args(in, levels_out, order_out, count);
    h.parallel_for(range, boundary_levels_);
  });
  sort_levels_.sort(levels, order, boundaries, level_bits);

  // Where each level starts: the one thing that the host must know before it launches the merges.
  std::vector<std::uint32_t> starts(level_count + 1, boundaries);
  runtime::buffer<std::uint32_t> starts_buffer(starts.data(), starts.size());
  queue_.submit([&](runtime::handler& h) {
    const runtime::accessor in{levels, h, runtime::read_only};
    const runtime::accessor out{starts_buffer, h, runtime::read_write};
    h.set_args(in, out, boundaries);
    h.parallel_for(range, level_starts_);
  });
  {
    const runtime::host_accessor read{starts_buffer, runtime::read_only};
    for (std::size_t i = 0; i < starts.size(); ++i) starts[i] = read[i];
  }
  std::uint32_t end = boundaries;
  std::array<std::uint32_t, level_count> sizes{};
  for (std::uint32_t level = level_count; level-- > 0;) {
    // An empty level keeps the value that it was filled with.
    if (starts[level] == boundaries) continue;
    sizes[level] = end - starts[level];
    end = starts[level];
  }

  for (std::uint32_t level = 0; level < level_count; ++level) {
    if (sizes[level] == 0) continue;
    queue_.submit([&](runtime::handler& h) {
      const runtime::accessor in{order, h, runtime::read_only};
      const runtime::accessor nodes{tree.nodes, h, runtime::read_write};
      const runtime::accessor b{begins, h, runtime::read_write};
      const runtime::accessor e{ends, h, runtime::read_write};
      h.set_args(in, nodes, b, e, count, starts[level], sizes[level]);
      h.parallel_for(padded(sizes[level], tuning_.group), merge_level_);
    });
  }
  runtime::buffer<std::uint32_t> root(2);
  queue_.submit([&](runtime::handler& h) {
    const runtime::accessor b{begins, h, runtime::read_only};
    const runtime::accessor nodes{tree.nodes, h, runtime::read_only};
    const runtime::accessor out{root, h, runtime::write_only};
    h.set_args(b, nodes, out);
    h.single_task(tree_root_);
  });
  const runtime::host_accessor read{root, runtime::read_only};
  tree.root = read[0];
  tree.depth = read[1];
  return tree;
}

}  // namespace facet::tracer
