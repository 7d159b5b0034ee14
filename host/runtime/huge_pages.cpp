#include "runtime/huge_pages.hpp"

#ifdef __linux__
#include <sys/mman.h>

#include <cstdlib>
#endif

namespace facet::runtime::detail {

#ifdef __linux__

std::optional<cl::Buffer> buffer_in_huge_pages(const cl::Context& c, std::size_t bytes) {
  constexpr std::size_t page = std::size_t(2) << 20;
  if (bytes < page) return std::nullopt;
  const std::size_t whole = (bytes + page - 1) / page * page;
  void* const memory = std::aligned_alloc(page, whole);
  if (!memory) return std::nullopt;
  // A system that has none gives the pages that it has.
  madvise(memory, whole, MADV_HUGEPAGE);
  const cl_mem b =
      clCreateBuffer(c(), CL_MEM_READ_WRITE | CL_MEM_USE_HOST_PTR, bytes, memory, nullptr);
  // The last command that uses the buffer may end after its last owner.
  const auto let_go = [](cl_mem, void* p) { std::free(p); };
  if (b && clSetMemObjectDestructorCallback(b, let_go, memory) == CL_SUCCESS) return cl::Buffer(b);
  if (b) clReleaseMemObject(b);
  std::free(memory);
  return std::nullopt;
}

#else

std::optional<cl::Buffer> buffer_in_huge_pages(const cl::Context&, std::size_t) {
  return std::nullopt;
}

#endif

}  // namespace facet::runtime::detail
