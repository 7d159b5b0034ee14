// Internal: memory of large buffers on a device that is the host's own CPU.
#pragma once

#include <cstddef>
#include <optional>

#include "runtime/opencl.hpp"

namespace facet::runtime::detail {

/// A buffer in huge pages, of memory that the system may give in pages of 2 MiB where it is asked
/// (madvise, MADV_HUGEPAGE): rays read here and there in more memory than a CPU keeps addresses of
/// in pages of 4 KiB, and it is 512 times the page faults. None for less than such a page, where
/// the system cannot be asked, or where there is no memory: the driver's own is for those.
std::optional<cl::Buffer> buffer_in_huge_pages(const cl::Context& c, std::size_t bytes);

}  // namespace facet::runtime::detail
