#include "tracer/kernels.hpp"

#include <algorithm>

namespace facet::tracer {
namespace {

/// Stacks grow in steps, so that scenes of like depth share a compiled kernel.
std::uint32_t step_up(std::uint32_t entries, std::uint32_t step) {
  return std::max(step, (entries + step - 1) / step * step);
}

}  // namespace

std::string traversal_options(const features& f, tree_kind tree, bool in_images,
                              std::uint32_t traversal_stack, std::uint32_t ray_stack,
                              const tuning& t) {
  std::string o = f.flags() + t.flags();
  if (in_images) o += " -DFACET_GEOMETRY_IMAGE";
  if (tree == tree_kind::none) o += " -DFACET_TREE_NONE";
  o += " -DFACET_STACK=" + std::to_string(step_up(traversal_stack, 32));
  o += " -DFACET_RAY_STACK=" + std::to_string(step_up(ray_stack, 8));
  return o;
}

}  // namespace facet::tracer
