// The text of cl/, embedded in the library, and the programs made of it.
#pragma once

#include <string>

#include "runtime/runtime.hpp"
#include "tracer/features.hpp"
#include "tracer/tracer.hpp"
#include "tracer/tree.hpp"
#include "tracer/tuning.hpp"

namespace facet::tracer {

/// All files of cl/, by name.
const runtime::source_tree& kernel_sources();

/// The program made of `main_file`, compiled once in a process for each context, text and options:
/// programs with the same are one. Throws runtime::exception (build).
runtime::program compiled(const runtime::queue& q, const runtime::source_tree& kernels,
                          const std::string& main_file, const std::string& options);

/// What single work-items build trees and the wide layout by, and what they put many primitives in
/// order by before.
inline constexpr const char* serial_file = "serial.cl";
inline constexpr const char* order_file = "serial_order.cl";

/// The options that trace.cl and render.cl are compiled with for this geometry.
/// ray_stack: entries of the stack of pending rays, at least the depth of what is rendered.
std::string traversal_options(const features& f, std::uint32_t nesting, tree_kind tree,
                              bool in_images, bool is_wide, std::uint32_t traversal_stack,
                              std::uint32_t ray_stack, const tuning& t);

}  // namespace facet::tracer
