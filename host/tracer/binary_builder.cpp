#include "tracer/binary_builder.hpp"

#include <algorithm>

namespace facet::tracer {
namespace {

Box box_of(const Instance& i) {
  Box b{};
  std::copy(std::begin(i.lo), std::end(i.lo), b.lo);
  std::copy(std::begin(i.hi), std::end(i.hi), b.hi);
  return b;
}

}  // namespace

binary_builder::binary_builder(runtime::queue& q, const runtime::source_tree& kernels,
                               const tuning& t)
    : levels_(q, kernels, t) {}

binary_tree binary_builder::over_triangles(runtime::buffer<texel>& corners, std::uint32_t count) {
  runtime::buffer<Box> boxes = levels_.boxes_of(corners, count);
  return levels_.build(boxes, count);
}

binary_tree binary_builder::over_instances(const std::vector<Instance>& placed) {
  std::vector<Box> boxes;
  boxes.reserve(placed.size());
  for (const Instance& i : placed) boxes.push_back(box_of(i));
  runtime::buffer<Box> on_device(boxes.data(), boxes.size());
  return levels_.build(on_device, std::uint32_t(boxes.size()));
}

}  // namespace facet::tracer
