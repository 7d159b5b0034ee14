// Internal: memory of large buffers on a device that is the host's own CPU.
#pragma once

#include <cstddef>
#include <optional>

#include "runtime/opencl.hpp"

namespace facet::runtime::detail {

/// A buffer in memory of a store that all share (block_store.hpp), which keeps a thirty-second of
/// the machine's memory at most. None for less than a huge page or where there is no memory: the
/// driver's own is for those.
std::optional<cl::Buffer> buffer_in_huge_pages(const cl::Context& c, std::size_t bytes);

}  // namespace facet::runtime::detail
