// Internal: blocks of host memory in huge pages, kept for the next that is asked for.
#pragma once

#include <cstddef>
#include <map>
#include <mutex>

namespace facet::runtime::detail {

/// What one caller gives back the next takes: to have the system clear fresh pages takes as long as
/// to build a tree in them. Safe from several threads.
class block_store {
 public:
  /// What the system may give in one piece where it is asked: rays read here and there in more
  /// memory than a CPU keeps addresses of in pages of 4 KiB.
  static constexpr std::size_t page = std::size_t(2) << 20;

  struct block {
    void* memory = nullptr;  ///< begins at a page; contents are anything
    std::size_t bytes = 0;
  };

  /// most_kept: bytes of blocks that nobody has.
  explicit block_store(std::size_t most_kept) : most_kept_(most_kept) {}
  block_store(const block_store&) = delete;
  block_store& operator=(const block_store&) = delete;
  ~block_store();

  /// Of at least so many bytes; memory is null where the system has none, or is not asked.
  block take(std::size_t bytes);
  void give_back(block b);

  std::size_t kept_bytes() const;

 private:
  block kept_for(std::size_t bytes);
  void free_all();

  const std::size_t most_kept_;
  mutable std::mutex mutex_;
  std::multimap<std::size_t, void*> kept_;  // by size
  std::size_t kept_bytes_ = 0;
};

}  // namespace facet::runtime::detail
