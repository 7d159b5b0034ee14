// Whether work-groups of a device can look back at each other while they run (cl/look_back.h).
#pragma once

#include <cstdint>
#include <string>

#include "runtime/runtime.hpp"
#include "tracer/tuning.hpp"

namespace facet::tracer {

/// Lets many more groups look back than run at once, and holds their sums against the host's. A
/// group gives up after `steps` steps, so that this ends on any device. more_options: for the
/// compiler, "-DFACET_LOOK_BACK_REVERSED" for ids in an order that cannot work.
bool prove_look_back(runtime::queue q, const runtime::source_tree& kernels, const tuning& t,
                     std::uint32_t steps, const std::string& more_options = "");

/// The same, asked once in a process for each device.
bool has_look_back(const runtime::queue& q, const runtime::source_tree& kernels, const tuning& t);

/// The compiler's options by which cl/warp.h uses PTX; each with a space before it.
std::string warp_options(const sort_tuning& t);

}  // namespace facet::tracer
