#include "runtime/block_store.hpp"

#include <cstdlib>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace facet::runtime::detail {
namespace {

/// Null where there is none.
void* in_huge_pages(std::size_t bytes) {
#ifdef __linux__
  void* const memory = std::aligned_alloc(block_store::page, bytes);
  // A system that has none gives the pages that it has.
  if (memory) madvise(memory, bytes, MADV_HUGEPAGE);
  return memory;
#else
  (void)bytes;
  return nullptr;
#endif
}

}  // namespace

block_store::~block_store() { free_all(); }

block_store::block block_store::take(std::size_t bytes) {
  const std::size_t whole = (bytes + page - 1) / page * page;
  const std::lock_guard lock(mutex_);
  if (const block b = kept_for(whole); b.memory) return b;
  void* memory = in_huge_pages(whole);
  if (!memory) {
    free_all();
    memory = in_huge_pages(whole);
  }
  return {memory, memory ? whole : 0};
}

/// One that is a quarter too large at most.
block_store::block block_store::kept_for(std::size_t bytes) {
  const auto found = kept_.lower_bound(bytes);
  if (found == kept_.end() || found->first > bytes + bytes / 4) return {};
  const block b{found->second, found->first};
  kept_.erase(found);
  kept_bytes_ -= b.bytes;
  return b;
}

void block_store::give_back(block b) {
  const std::lock_guard lock(mutex_);
  if (b.bytes > most_kept_ - kept_bytes_) return std::free(b.memory);
  kept_.emplace(b.bytes, b.memory);
  kept_bytes_ += b.bytes;
}

void block_store::free_all() {
  for (const auto& [bytes, memory] : kept_) std::free(memory);
  kept_.clear();
  kept_bytes_ = 0;
}

std::size_t block_store::kept_bytes() const {
  const std::lock_guard lock(mutex_);
  return kept_bytes_;
}

}  // namespace facet::runtime::detail
