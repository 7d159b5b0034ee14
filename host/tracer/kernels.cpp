#include "tracer/kernels.hpp"

#include <algorithm>
#include <map>
#include <mutex>
#include <tuple>

namespace facet::tracer {
namespace {

/// Stacks grow in steps, so that scenes of like depth share a compiled kernel.
std::uint32_t step_up(std::uint32_t entries, std::uint32_t step) {
  return std::max(step, (entries + step - 1) / step * step);
}

/// Never destroyed: a driver may be gone before the last static object is.
struct program_cache {
  std::mutex mutex;
  std::map<std::tuple<runtime::native::context, std::string, std::string>, runtime::program>
      programs;

  static program_cache& get() {
    static auto* cache = new program_cache;
    return *cache;
  }
};

}  // namespace

runtime::program compiled(const runtime::queue& q, const runtime::source_tree& kernels,
                          const std::string& main_file, const std::string& options) {
  program_cache& cache = program_cache::get();
  const std::lock_guard lock(cache.mutex);
  const std::tuple key{q.get_context().get(), runtime::expand(kernels, main_file), options};
  if (const auto found = cache.programs.find(key); found != cache.programs.end())
    return found->second;
  return cache.programs.emplace(key, runtime::program(q.get_context(), kernels, main_file, options))
      .first->second;
}

std::string traversal_options(const features& f, std::uint32_t nesting, tree_kind tree,
                              bool in_images, bool is_wide, std::uint32_t traversal_stack,
                              std::uint32_t ray_stack, const tuning& t) {
  std::string o = f.flags() + t.flags();
  if (in_images) o += " -DFACET_GEOMETRY_IMAGE";
  if (is_wide) o += " -DFACET_WIDE";
  if (t.warps) o += " -DFACET_PTX";
  if (tree == tree_kind::none) o += " -DFACET_TREE_NONE";
  o += " -DFACET_STACK=" + std::to_string(step_up(traversal_stack, 32));
  o += " -DFACET_NESTING=" + std::to_string(nesting);
  o += " -DFACET_RAY_STACK=" + std::to_string(step_up(ray_stack, 8));
  return o;
}

}  // namespace facet::tracer
