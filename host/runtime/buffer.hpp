// An array that host and devices share (SYCL 2020, section 4.7.2), of one dimension.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include "runtime/memory.hpp"

namespace facet::runtime {

/// A cheap handle: copies own the same array. Device memory is allocated when a command first
/// needs it, in that command's context, and the array stays in that context. 0 elements are fine.
///
/// Where write-back is on, the last owner's death waits for the commands that write the array and
/// copies it back; a failure of that goes to the queue that wrote it (queue::throw_asynchronous).
template <class T>
class buffer {
  static_assert(std::is_trivially_copyable_v<T> && !std::is_const_v<T>,
                "a buffer's elements are copied as bytes");

 public:
  using value_type = T;

  /// Undefined contents.
  explicit buffer(std::size_t count) : memory_(detail::make_buffer(count, sizeof(T))) {}

  /// Copies `count` elements from `data` now; nothing is written back.
  buffer(const T* data, std::size_t count) : buffer(count) { detail::copy_in(*memory_, data); }
  explicit buffer(std::span<const T> data) : buffer(data.data(), data.size()) {}

  /// Takes its contents from `data` and writes them back there. The memory must live, and be left
  /// alone but through host_accessor, until the last owner is dead.
  explicit buffer(std::span<T> data) : buffer(data.size()) { detail::bind(*memory_, data.data()); }
  explicit buffer(std::vector<T>& data) : buffer(std::span<T>(data)) {}

  /// Writes back to `data` (size() elements) instead; null: nowhere.
  void set_final_data(T* data) { detail::set_final_data(*memory_, data); }
  void set_write_back(bool on = true) { detail::set_write_back(*memory_, on); }

  std::size_t size() const noexcept { return byte_size() / sizeof(T); }
  std::size_t byte_size() const noexcept { return detail::byte_size(*memory_); }

  native::memory get() const { return detail::native_handle(*memory_); }
  const std::shared_ptr<detail::memory>& memory() const noexcept { return memory_; }
  friend bool operator==(const buffer&, const buffer&) = default;

 private:
  std::shared_ptr<detail::memory> memory_;
};

template <class T>
buffer(std::vector<T>&) -> buffer<T>;
template <class T>
buffer(std::span<T>) -> buffer<std::remove_const_t<T>>;

}  // namespace facet::runtime
