#include "runtime/huge_pages.hpp"

#include <memory>

#include "runtime/block_store.hpp"

#ifdef __linux__
#include <unistd.h>
#endif

namespace facet::runtime::detail {
namespace {

std::size_t machine_bytes() {
#ifdef __linux__
  const long pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGESIZE);
  if (pages > 0 && size > 0) return std::size_t(pages) * std::size_t(size);
#endif
  return 0;
}

/// Never destroyed: a driver may let go of a buffer after the last static object is gone.
block_store& store() {
  static auto* one = new block_store(machine_bytes() / 32);
  return *one;
}

void CL_CALLBACK let_go(cl_mem, void* of) {
  const std::unique_ptr<block_store::block> b(static_cast<block_store::block*>(of));
  store().give_back(*b);
}

}  // namespace

std::optional<cl::Buffer> buffer_in_huge_pages(const cl::Context& c, std::size_t bytes) {
  if (bytes < block_store::page) return std::nullopt;
  auto block = std::make_unique<block_store::block>(store().take(bytes));
  if (!block->memory) return std::nullopt;
  const cl_mem b =
      clCreateBuffer(c(), CL_MEM_READ_WRITE | CL_MEM_USE_HOST_PTR, bytes, block->memory, nullptr);
  // The last command that uses the buffer may end after its last owner.
  if (b && clSetMemObjectDestructorCallback(b, let_go, block.get()) == CL_SUCCESS) {
    block.release();
    return cl::Buffer(b);
  }
  if (b) clReleaseMemObject(b);
  store().give_back(*block);
  return std::nullopt;
}

}  // namespace facet::runtime::detail
